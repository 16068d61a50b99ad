"""Callbacks: who watches a run without touching it."""

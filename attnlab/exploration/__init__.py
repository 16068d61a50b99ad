"""Exploration: which action, given the values of all."""

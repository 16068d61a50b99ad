"""Fusion: one motor command of those held."""

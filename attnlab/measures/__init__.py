"""Measures: one number a seed from the runs of a condition. Claims name them; plugins add to them."""

"""Learners: how good is each period in each state."""

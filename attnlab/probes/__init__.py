"""Probes: columns of one's own in a table."""

"""Figures of the report, a file each, and what they are drawn with. A plugin adds one in the same way."""

"""A robot at work: one run, from a checked plan to tables in a folder. Never reads a study."""

"""Studies: which runs there are, which are missing, and running them side by side."""

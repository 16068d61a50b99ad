"""Logs of real robots as one typed stream of scans, whatever the format of the file."""

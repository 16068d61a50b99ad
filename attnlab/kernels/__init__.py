"""Compiled numeric cores. Importing a module of this package imports numba, so it is done where a core is needed."""

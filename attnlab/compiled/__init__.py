"""The same classes, compiled: objects are laid out in memory by the types of their fields, and numba compiles their own
methods for that layout. Importing a module of this package imports numba."""

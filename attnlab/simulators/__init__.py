"""Simulators: the same robot in the same world, behind one protocol (:mod:`attnlab.simulators.base`)."""

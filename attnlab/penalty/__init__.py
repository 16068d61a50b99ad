"""Penalty: who pays for the robot's death."""

"""Needs: what the robot must keep within bounds to live."""

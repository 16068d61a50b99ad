"""Behaviours: what is perceived, when it is released, how the robot moves, what is rewarded."""

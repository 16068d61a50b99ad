"""Curiosity: how much the robot wants to explore, how much it likes what it perceives, and how both mix."""

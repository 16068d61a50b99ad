"""How often the rules of a claims file are wrong, and how many seeds they need, by studies that are planted."""

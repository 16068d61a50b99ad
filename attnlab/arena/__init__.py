"""The arena of attention: ways to decide when to look, in worlds and on logs of real robots, compared on one page."""

"""The toys of the papers on when to look, played by the ways as they are here, and judged by the papers' claims."""

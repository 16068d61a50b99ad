"""Results in other formats: a study's tables as CSV, an episode as an MCAP log or a Rerun recording."""

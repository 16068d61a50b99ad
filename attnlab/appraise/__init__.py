"""A recorded run as every model of curiosity sees it."""

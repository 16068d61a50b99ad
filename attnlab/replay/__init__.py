"""A recorded episode to look at: one page that needs no network."""

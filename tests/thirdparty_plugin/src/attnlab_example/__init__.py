"""Parts for attnlab from a package of its own: importing it registers them."""

from attnlab_example import patrol, watching, weekly

__all__ = ["patrol", "watching", "weekly"]

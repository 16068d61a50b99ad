"""Worlds: a description (conf/world/*.yaml) becomes a :class:`~attnlab.worlds.base.Layout`."""

"""attnlab: learn where to look. Adaptive attention and curiosity for behaviour-based robots (Di Nocera et al. 2014)."""

__version__ = "0.1.0"

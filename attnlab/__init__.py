"""attnlab: learn where to look. Adaptive attention and curiosity for behaviour-based robots (Di Nocera et al. 2014)."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from attnlab import plot
    from attnlab.api import compose, load, simulate, sweep, verdicts
    from attnlab.clock import Clock

__version__ = "0.1.0"
__all__ = ["Clock", "__version__", "compose", "load", "plot", "simulate", "sweep", "verdicts"]


def __getattr__(name: str) -> Any:
    """compose, simulate, sweep, load and verdicts, of :mod:`attnlab.api`, :mod:`attnlab.plot`, and the Clock of
    :mod:`attnlab.clock`: imported when asked for."""
    if name == "plot":
        return import_module("attnlab.plot")
    if name == "Clock":
        return import_module("attnlab.clock").Clock
    if name in __all__:
        return getattr(import_module("attnlab.api"), name)
    raise AttributeError(f"attnlab has no {name}; it has {', '.join(__all__)}")

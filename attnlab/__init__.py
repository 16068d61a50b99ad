"""attnlab: learn where to look. Adaptive attention and curiosity for behaviour-based robots (Di Nocera et al. 2014)."""

import sys
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from attnlab import plot
    from attnlab.api import compose, load, simulate, sweep, verdicts
    from attnlab.clock import Clock

__version__ = "0.1.0"
__all__ = ["Clock", "__version__", "compose", "load", "plot", "simulate", "sweep", "verdicts"]

if sys.argv[:1] == ["-m"]:  # python -m attnlab...: the line that most often is missing is the one that activates
    for name in ("numpy", "hydra", "pyarrow", "pandas", "scipy", "seaborn", "rich"):
        if find_spec(name) is None:
            print(f"attnlab: {sys.executable} has no {name}. Type: source .venv/bin/activate; if there is no .venv, "
                  "README.md begins with how to make it", file=sys.stderr)
            sys.exit(2)


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

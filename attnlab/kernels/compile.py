"""numba, with its disk cache where there is one."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pickle import UnpicklingError
from typing import Any, TypeVar, cast

from numba import njit

Function = TypeVar("Function", bound=Callable[..., Any])

# Of functions that compiled ones alone call: what would make them callable from Python and C takes a tenth of the time.
ONLY_COMPILED: dict[str, Any] = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
DAMAGE = (UnpicklingError, EOFError)  # of a file in the cache
_told = False


def inner(function: Function) -> Function:
    """Decorator: a function that compiled ones call, compiled with them."""
    return cast("Function", njit(error_model="numpy", **ONLY_COMPILED)(function))


def is_kept(signature: str, function: Callable[..., Any], **options: Any) -> bool:
    """Is the function, compiled for this signature, in numba's disk cache? It is not where no cache can be kept."""
    try:
        lazy = njit(cache=True, **options)(function)
        return lazy._cache.load_overload(signature, lazy.targetctx) is not None  # kept under what it was asked by
    except (RuntimeError, OSError, *DAMAGE):
        return False


def keeps() -> bool:
    """Is there a folder that compiled code can be kept in?"""
    try:
        njit(cache=True)(keeps)
    except (RuntimeError, OSError):
        return False
    return True


def compiled(signature: str, **options: Any) -> Callable[[Function], Function]:
    """Decorator: compile for this one signature, from the disk cache if it holds the function; ``options`` are numba's.

    One signature means that whole numbers are converted rather than compiled for anew. No fastmath and no threads: the
    machine code, and so every bit of a result, is the same whether it was cached or not. Without any writable cache
    folder (beside the package, the user's, or NUMBA_CACHE_DIR) the function is compiled in each process, and one line
    on standard error says so.
    """
    options = {"error_model": "numpy", **options}

    def wrap(function: Function) -> Function:
        global _told
        try:
            try:
                return cast("Function", njit(signature, cache=True, **options)(function))
            except DAMAGE:  # what was kept of it is no code: away with it
                njit(cache=True, **options)(function)._cache.flush()
                return cast("Function", njit(signature, cache=True, **options)(function))
        except (RuntimeError, OSError) as cause:
            if isinstance(cause, RuntimeError) and "cache" not in str(cause):
                raise
            if not _told:
                print("attnlab: numba's cache folder is not writable, so every process compiles the simulator anew "
                      "(some seconds); set NUMBA_CACHE_DIR to a folder that is", file=sys.stderr)
                _told = True
            return cast("Function", njit(signature, **options)(function))
    return wrap

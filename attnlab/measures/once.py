"""Answers for all runs of a study at once: a study has hundreds of conditions, and each looks up its own runs."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from attnlab.results.conditions import Conditions

Answer = TypeVar("Answer")


def once_a_study(function: Callable[..., Answer]) -> Callable[..., Answer]:
    """Of a pure function of (conditions, *arguments): computed once for each study and arguments. The answers are kept
    on the conditions, so that they go when those go."""
    @wraps(function)
    def kept(conditions: Conditions, *arguments: Any) -> Answer:
        answers = vars(conditions).setdefault("_answers", {})
        key = (function, *arguments)
        if key not in answers:
            answers[key] = function(conditions, *arguments)
        found: Answer = answers[key]
        return found
    return kept

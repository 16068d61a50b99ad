"""What one look tells whoever decides by more than a row of a table: numbers in [0, 1]."""

from __future__ import annotations

OF_A_LOOK = ("percept", "period", "wanting", "liking", "energy")


def observation(sigma: float, low: float, high: float, action: int, actions: int, wanting: float, liking: float,
                energy: float, energy_max: float) -> list[float]:
    """:data:`OF_A_LOOK`: the percept ``sigma`` within its domain [low, high], the period in force as its index
    ``action`` of ``actions``, wanting, liking, and energy (UoE) of ``energy_max``; cut at 0 and 1."""
    seen = ((sigma - low) / (high - low), action / max(1, actions - 1), wanting, liking, energy / energy_max)
    return [min(1.0, max(0.0, value)) for value in seen]

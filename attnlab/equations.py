"""Equations (1)-(13) of Di Nocera, Finzi, Rossi, Staffa 2014 (Front. Psychol. 5:273), one small pure function each.

All arguments and results are plain Python numbers, so that paper and code can be laid side by side and the control
loop pays for nothing else. UoE: units of energy; UoR: units of reward; mc: machine cycles.
"""

from __future__ import annotations

from math import exp


def clock_period(fires: bool, proposed_mc: int, previous_mc: int) -> int:
    """(1) p_t = rho * phi(f) + (1 - rho) * p_{t-1}: the period changes only when the clock fires."""
    return proposed_mc if fires else previous_mc


def q_update(q: float, reward: float, best_next: float, alpha: float, gamma: float) -> float:
    """(2) Q(s,a) <- (1 - alpha) Q(s,a) + alpha (R + gamma max_a' Q(s',a')); ``best_next`` is that maximum."""
    return (1.0 - alpha) * q + alpha * (reward + gamma * best_next)


def softmax(values: list[float], tau: float) -> list[float]:
    """(3) Boltzmann probabilities of the actions. The maximum is subtracted: a penalty drives Q to about -1200."""
    top = max(values)
    weights = [exp((q - top) / tau) for q in values]
    total = 0.0
    for weight in weights:  # left to right: the builtin sum compensates from Python 3.12 on
        total += weight
    return [weight / total for weight in weights]


def mixed_reward(extrinsic: float, liking: float, wanting: float) -> float:
    """(4) R = (1 - w) R_e + w R_l."""
    return (1.0 - wanting) * extrinsic + wanting * liking


def need_after_cycle(need: float, k: float, nb_act: int, consumed: float) -> float:
    """(5), (6) Hunger(t) or Thirst(t): grows by k for every active behaviour, falls by what was consumed (UoE)."""
    return need + k * nb_act - consumed


def period_term(period_mc: float, shortest_mc: float, longest_mc: float) -> float:
    """First half of (7)-(9): 0 at the shortest period, 1 at the longest."""
    return (period_mc - shortest_mc) / (longest_mc - shortest_mc)


def avoid_reward(period: float, sigma_m: float, sigma_min_m: float, sigma_max_m: float) -> float:
    """(7) without its penalty case; ``period`` is the period term in [0, 1], sigma the nearest obstacle.

    Nearer than sigma_min the second term is 0: "we assume the reward always positive except for a strong penalty".
    That it is the term that is cut, and not their sum, is ours.
    """
    return 0.5 * (period + max(0.0, (sigma_m - sigma_min_m) / (sigma_max_m - sigma_min_m)))


def need_reward(period: float, sigma: float, sigma_max: float) -> float:
    """(8) EAT and (9) DRINK without their penalty case: the needier, the smaller the reward. They have no sigma_min."""
    return 0.5 * (period + 1.0 - sigma / sigma_max)


def energy_after_cycle(energy: float, e_u: float, e_nb: float, nb_act: int, consumed: float) -> float:
    """(10) E(t): e_u a cycle, e_nb for every active behaviour, plus the food and water consumed (UoE)."""
    return energy - e_u - e_nb * nb_act + consumed


def wanting(energy: float, e_well: float, e_max: float) -> float:
    """(11) residual energy in [0, 1]; 0 below E_well. Energy above E_max (a meal at the start) counts as 1."""
    if energy < e_well:
        return 0.0
    return min(1.0, (energy - e_well) / (e_max - e_well))


def liking(visits: int, nv_tot: int) -> float:
    """(12) R_l = 1 - NV / NV_tot: novelty of a percept among the last NV_tot observations."""
    return 1.0 - visits / nv_tot


def safety(sigma_m: float, sigma_max_m: float, period_mc: float, shortest_mc: float, longest_mc: float) -> float:
    """(13) sigma / sigma_max * (p_max - p) / (p_max - p_min) of AVOID, in [0, 1]."""
    return sigma_m / sigma_max_m * (longest_mc - period_mc) / (longest_mc - shortest_mc)


def percept_bin(sigma: float, low: float, high: float, bins: int) -> int:
    """Section "State space": the index (0 to bins-1) of the equal interval of [low, high] that holds sigma."""
    index = int((sigma - low) / (high - low) * bins)
    return 0 if index < 0 else bins - 1 if index >= bins else index

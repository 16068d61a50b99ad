"""Readings: every sentence that the paper leaves open is a setting here, and a reading is a named set of them.

The defaults are the reading ``inferred``; conf/reading/ holds the others as differences to it. Where the paper's own
numbers decide (Table 5 needs about 1150 cycles an episode, for instance) the docstring of the field says so.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from attnlab.errors import ConfigError
from attnlab.settings import setting


@dataclass(frozen=True)
class Reading:
    """One way to read the paper. Units are in the names; UoE: units of energy, mc: machine cycles."""

    max_cycles: int = setting(1150, "cycles an episode; Table 4 says 1500, the activations of Table 5 need about 1150",
                              unit="mc", low=1)
    dt_s: float = setting(0.1565, "length of a cycle (180 s an episode)", unit="s", above=0, high=1.0)
    # energy
    energy_start: float = setting(4600.0, "E(0)", unit="UoE", low=0)
    energy_max: float = setting(4600.0, "E_max of eq 11; Table 4 says 4 * max_cycles", unit="UoE", above=0)
    energy_well: float = setting(3067.0, "E_well of eq 11: 2/3 of E_max", unit="UoE", low=0)
    energy_carry_over: bool = setting(False, "start an episode with the energy the last one ended with; a robot that "
                                      "died starts with energy_start")
    energy_death: bool = setting(False, "die when energy falls below energy_min")
    energy_clipped: bool = setting(False, "is energy cut at energy_max: no, as eq 10 is written (ours); true: a full "
                                   "robot gains nothing from a meal")
    energy_min: float = setting(300.0, "E_min of Table 4", unit="UoE", low=0)
    # needs
    need_k: float = setting(1.0, "k of eqs 5, 6: growth of a need for each active behaviour", unit="UoE", low=0)
    need_start: float = setting(300.0, "hunger and thirst at the start of an episode", unit="UoE", low=0)
    need_max: float = setting(1500.0, "largest hunger and thirst, sigma_max of EAT and DRINK", unit="UoE", above=0)
    need_min: float = setting(300.0, "sigma_min of EAT and DRINK in Table 4: eqs 8, 9 have none, and nothing uses it "
                              "but percept_domain=min_to_max, where it is the lowest percept", unit="UoE", low=0)
    need_death: bool = setting(True, "die when hunger or thirst reaches need_max")
    needs_floored: bool = setting(False, "are hunger and thirst cut at 0: no, as eqs 5, 6 are written (ours); true: a "
                                  "meal fills no more than the need there is")
    active: Literal["fired", "released"] = setting(
        "fired", "whom eqs 5, 6, 10 count as active: whose clock fired (ours), or only those whose motor schema was on")
    releaser_threshold: float = setting(300.0, "EAT and DRINK are released at this need (the text says sigma_max)",
                                        unit="UoE", low=0)
    # percepts
    avoid_sigma_max_m: float = setting(1.0, "sigma_max of AVOID, from the robot's centre", unit="m", above=0)
    avoid_sigma_min_m: float = setting(0.4, "sigma_min of AVOID in Table 4: the lowest percept with "
                                       "percept_domain=min_to_max", unit="m", low=0)
    reward_sigma_min_m: float = setting(0.4, "sigma_min of eq 7's reward, Table 4's; nearer, the term is 0 (ours)",
                                        unit="m", low=0)
    percept_domain: Literal["zero_to_max", "min_to_max"] = setting(
        "zero_to_max", "domain cut into percepts: [0, max] as the text says, or [min, max]")
    percept_bins: int = setting(6, "equal intervals of the domain", low=1, high=100)
    # reward and learning
    reward_period: Literal["elapsed", "chosen"] = setting(
        "elapsed", "p of eqs 7-9: the period that elapsed, or the one newly chosen")
    penalty: float = setting(-1500.0, "reward when the robot dies", unit="UoR", high=0)
    penalised: str = setting("responsible", "who gets the penalty (a part of the group penalty): the one in charge "
                             "of what killed the robot (responsible), or all (literal eqs 7-9)")
    penalty_mix: Literal["outside", "inside"] = setting(
        "outside", "is the penalty outside of eq 4, or inside (scaled by 1 - w)")
    q_update: Literal["decision", "smdp"] = setting(
        "decision", "gamma once a decision, or gamma^period (semi-Markov)")
    # curiosity
    novelty_window: int = setting(10, "NV_tot of eq 12, observations", unit="observations", low=1, high=100_000)
    novelty_persists: bool = setting(False, "keep the novelty window from one episode to the next")
    novelty_counts_current: bool = setting(False, "count the current percept among the NV_tot observations")
    novelty_over: Literal["percept", "state"] = setting(
        "percept", "whose visits NV counts in curiosity=litman and none: the percept's, as eq 12 is written, or the "
        "state's, as its text says: percept and whether w > 0 (ours; LH and HH are told apart by the novelty itself)",
        late=True)
    non_curious: Literal["plain", "same_states"] = setting(
        "plain", "curiosity=none: no curiosity in the state (plain), or w = 0 with the states of the curious robot "
        "(same_states, an ablation)")
    # body and world
    crash: Literal["contact", "safety_distance"] = setting(
        "contact", "the footprint touches something, or also the front sonars' minimum (from the centre) falls below "
        "safety_distance_m")
    safety_distance_m: float = setting(0.4, "safety distance from the robot's centre", unit="m", above=0, high=2)
    v_max_m_s: float = setting(0.4, "largest linear speed", unit="m/s", above=0, high=2)
    w_max_rad_s: float = setting(1.5, "largest angular speed", unit="rad/s", above=0, high=10)
    speed_law: Literal["stopping", "proportional"] = setting(
        "stopping", "AVOID's speed: from v_max at sigma_max to 0 at stop_distance_m (ours), or v_max sigma / sigma_max "
        "(the paper's)")
    stop_distance_m: float | None = setting(
        None, "where AVOID stops with speed_law=stopping; left out: danger_m", unit="m", low=0)
    turn_rule: Literal["keeps_side", "sum"] = setting(
        "keeps_side", "AVOID's turn: the sum over active sonars, but once blocked it keeps to the side it chose "
        "(ours), or the sum alone (the paper's)")
    food_reach_m: float = setting(0.75, "a source is consumed when its blob looks nearer than this to the centre; "
                                  "ours, the paper has none: EAT rests at 0.6 m; 1.0 m, where it slows down, is the "
                                  "other end", unit="m", above=0)
    meal_interval_cycles: int = setting(25, "cycles between two meals of the same kind; ours, the paper has none: 1 is "
                                      "a meal at every look",
                                        unit="mc", low=1)
    food_supply: Literal["endless", "depletion", "respawn", "wandering"] = setting(
        "endless", "sources are endless, empty after food_portions meals (depletion), fill again after "
        "food_respawn_cycles (respawn), or appear at the next cube of their kind (wandering)")
    food_portions: int = setting(5, "meals in a source, unless endless", low=1)
    food_respawn_cycles: int = setting(300, "cycles until an empty source is full again", unit="mc", low=1)
    start_pose: Literal["random", "fixed"] = setting(
        "random", "a random free pose each episode (from the seed), or the same one always")
    validation_exploration: Literal["greedy", "softmax"] = setting(
        "greedy", "how actions are chosen in validation episodes")
    tie_break: Literal["first", "last", "random"] = setting(
        "first", "which of equal values greedy validation takes, in a state never seen, say: the shortest period "
        "(first, ours), the longest (last), or one at random (from the behaviour's stream of choices)", late=True)

    def __post_init__(self) -> None:
        if self.energy_well >= self.energy_max:
            raise ConfigError("energy_well", f"is {self.energy_well}, must be below energy_max ({self.energy_max})")
        if self.need_start >= self.need_max and self.need_death:
            raise ConfigError("need_start", f"is {self.need_start}, must be below need_max ({self.need_max})",
                              "The robot would be dead at the start")
        if self.avoid_sigma_min_m >= self.avoid_sigma_max_m:
            raise ConfigError("avoid_sigma_min_m", "must be below avoid_sigma_max_m")
        if self.reward_sigma_min_m >= self.avoid_sigma_max_m:
            raise ConfigError("reward_sigma_min_m", "must be below avoid_sigma_max_m")
        if self.speed_law == "stopping" and self.stop_m >= self.avoid_sigma_max_m:
            raise ConfigError("stop_distance_m", f"is {self.stop_m}, must be below avoid_sigma_max_m "
                              f"({self.avoid_sigma_max_m})")
        if self.need_min >= self.need_max:
            raise ConfigError("need_min", "must be below need_max")

    @property
    def danger_m(self) -> float:
        """How near (m, centre to echo) the robot may come without danger of its life: 0.35, or with
        crash=safety_distance, where a robot that stops at 0.35 dies turning, safety_distance_m + 0.2. Chosen by the
        design test (AVOID at fixed periods, nothing learned) before any comparison of conditions."""
        return 0.35 if self.crash == "contact" else self.safety_distance_m + 0.2

    @property
    def stop_m(self) -> float:
        """Where AVOID stops (m, centre to echo) with speed_law=stopping."""
        return self.danger_m if self.stop_distance_m is None else self.stop_distance_m

"""What kind of statement is made of planted multiverses: no effect, one everywhere, one that hangs on a factor."""

from __future__ import annotations

import numpy as np
import pytest

from attnlab.report.contrasts import Contrast
from attnlab.report.multiverse import Curves, curves_of
from attnlab.report.sentences import apart, how_many, sentences
from attnlab.report.statements import Kind

READINGS, SEEDS = 36, 10
LEVELS = {"crash": ["contact", "distance"] * 18, "need_k": [str(i // 2 % 3) for i in range(36)],
          "start": ["fixed"] * 18 + ["random"] * 18}


def planted(effect, *, sign: float = 1.0, measures: int = 1, seed: int = 0, seeds: int = SEEDS) -> Curves:
    """Readings that share 0.7 of their seeds' luck; ``effect`` (readings,) is put into the first measure."""
    rng = np.random.default_rng(seed)
    luck = rng.standard_normal((1, measures, seeds))
    x = np.sqrt(0.7) * luck + np.sqrt(0.3) * rng.standard_normal((READINGS, measures, seeds))
    x[:, 0] += np.broadcast_to(effect, READINGS)[:, None]
    wanted = [Contrast(f"C{m}", 0, f"measure {m}", "treatment", "control", "CR", "NCR", sign, f"m{m}", False)
              for m in range(measures)]
    found = curves_of(wanted, x, LEVELS)
    assert found is not None
    return found


def test_without_an_effect_all_is_noise():
    """At most one multiverse of four comparisons in twenty says something by chance: of 60, three standard errors."""
    kinds = [{said.kind for said in planted(0.0, measures=4, seed=seed, seeds=8).statements} for seed in range(60)]
    assert np.mean([kind != {Kind.NOISE} for kind in kinds]) < 0.05 + 3 * np.sqrt(0.05 * 0.95 / 60)


@pytest.mark.parametrize(("effect", "side"), [(1.5, 1.0), (-1.5, -1.0)])
def test_an_effect_in_all_readings_is_robust(effect, side):
    said = planted(effect, measures=3).statements
    assert said[0].kind is Kind.ROBUST and said[0].side == side and said[0].on_side == READINGS
    assert {of.kind for of in said[1:]} == {Kind.NOISE}
    (robust, count, texts), (noise, _, others) = sentences(planted(effect, sign=-1.0, measures=3))
    assert (robust, count, noise) == (Kind.ROBUST, 1, Kind.NOISE)
    word = "lower" if side > 0 else "higher"
    claimed = "as claimed" if side > 0 else "the opposite of what is claimed"
    assert texts == [f"measure 0 [C0] is {word} in CR than in NCR in 36 of 36 readings, {claimed}."]
    assert others == ["measure 1 [C1]; measure 2 [C2]."]


@pytest.mark.parametrize("factor", LEVELS)
def test_an_effect_in_the_readings_of_one_level_hangs_on_that_factor(factor):
    level = LEVELS[factor][0]
    there = np.array([of == level for of in LEVELS[factor]])
    found = planted(1.8 * there, measures=2, seed=1)
    said = found.statements[0]
    assert said.kind is Kind.HANGS and said.factors == [factor]
    at = {of.level: of for of in said.levels}
    assert at[level].above == at[level].values == there.sum() and at[level].holds(1.0)
    assert not any(of.holds(1.0) for name, of in at.items() if name != level)
    assert found.mover(0)[0] == factor and found.statements[1].kind is Kind.NOISE
    text = sentences(found)[0][2][0]
    assert text.startswith(f"measure 0 [C0], CR against NCR, hangs on {factor}: higher, as claimed, with {level} ")


def test_opposite_effects_at_two_levels_hang_on_their_factor():
    said = planted(np.where(np.array(LEVELS["start"]) == "fixed", 1.5, -1.5)).statements[0]
    assert said.kind is Kind.HANGS and said.factors == ["start"]
    assert [of.holds(side) for of, side in zip(said.levels, (1.0, -1.0), strict=True)] == [True, True]


def test_an_effect_that_a_factor_only_scales_is_robust():
    """Twice as large with one level, and still there with the other: it hangs on nothing."""
    said = planted(np.where(np.array(LEVELS["start"]) == "fixed", 4.0, 2.0)).statements[0]
    assert said.kind is Kind.ROBUST


def test_an_effect_in_readings_that_no_factor_sorts_is_mixed():
    there = np.array([(i * 7) % 36 < 24 for i in range(36)])
    said = planted(np.where(there, 3.0, -1.0), seed=2).statements[0]
    assert said.kind is Kind.MIXED and said.on_side == 24


def test_readings_without_a_value_are_counted_as_such():
    rng = np.random.default_rng(3)
    x = 1.5 + rng.standard_normal((READINGS, 2, SEEDS))
    x[:6, 0], x[:, 1] = np.nan, np.nan
    wanted = [Contrast(f"C{m}", 0, "m", "treatment", "control", "CR", "NCR", 1.0, f"m{m}", False) for m in (0, 1)]
    found = curves_of(wanted, x, LEVELS)
    assert len(found.contrasts) == 1 and found.statements[0].values == found.joint.values[0] == 30
    assert "in 30 of 30 readings" in sentences(found)[0][2][0]


def test_five_seeds_tell_nothing_from_chance():
    from attnlab.report.sentences import how_many
    found = planted(3.0, seeds=5)
    assert found.statements[0].kind is Kind.NOISE
    assert "With 5 seeds no p is below 0.062" in how_many(36, found)


def test_readings_that_share_no_seed_are_named():
    """Half of the readings have the first five seeds, half the others; and one reading that has none is no matter."""
    of = planted(1.5)
    assert apart(of) == "" and f"{SEEDS} seeds, the same in all" in how_many(READINGS, of)
    of.differences[0] = np.nan
    assert of.shared == SEEDS
    of.differences[1, :, 3:] = np.nan
    assert apart(of) == "" and f"{SEEDS} seeds, of which all readings have 3" in how_many(READINGS, of)
    of.differences[2, :, :3] = np.nan
    assert apart(of).startswith("no seed is in all readings") and "of which all readings have 0" in how_many(2, of)

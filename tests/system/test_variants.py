"""Settings swept together."""

from __future__ import annotations

import pytest

from attnlab.errors import ConfigError
from attnlab.launch.variants import as_override, read_variants
from attnlab.results import load


def test_none_changes_nothing():
    assert read_variants(None) == {None: {}}


@pytest.mark.parametrize(("node", "says"), [([1], "expected"), ({"a": 3}, "variants.a"), ({"a": {"seed": 1}}, "seed"),
                                            ({"design": "grid"}, "'grid' is none"),
                                            ({"design": "multiverse", "size": 0}, "variants.size"),
                                            ({"design": "multiverse", "szie": 9}, "Did you mean 'size'")])
def test_what_is_no_variant(node, says):
    with pytest.raises(ConfigError, match=says):
        read_variants(node)


def test_overrides_are_written_in_hydras_grammar():
    from hydra.core.override_parser.overrides_parser import OverridesParser
    for value in (1, 0.5, True, None, "a word", "it's", ["avoid", "eat"], {"avoid": 4}):
        parsed = OverridesParser.create().parse_override(f"x={as_override(value)}")
        assert parsed.value() == value


def test_variants_are_conditions(here, tmp_path):
    done = here("-m", "simulator=planar", "train_episodes=2", "validation_episodes=1", "max_cycles=60", "seed=0-1",
                   "report=false", "picture=false",
                   "variants={plain:{learner:fixed_4,curiosity:none},new:{learner:q_learning,reading.need_k:2}}")
    assert done.returncode == 0, done.stderr
    study = load(tmp_path / "outputs" / "main")
    assert set(study.episodes["variant"]) == {"plain", "new"}
    by = study.episodes.groupby("variant")
    assert set(by.get_group("plain")["curiosity"]) == {"none"}
    assert set(by.get_group("new")["learner"]) == {"q_learning"}
    assert study.episodes["run"].nunique() == 4

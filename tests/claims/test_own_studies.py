"""The project's own studies: each condition that an experiment asks for plays one role of its claims file."""

from __future__ import annotations

from itertools import product

import pytest

import attnlab
from attnlab.claims.files import load_claims
from attnlab.paths import conf_dir
from attnlab.tables.flat import text
from attnlab.tables.naming import value_of
from attnlab.tables.yamls import read_yaml

STUDIES = {"bigger_table": (5, 40), "matched_budget": (24, 12), "where_curiosity_pays": (225, 8),
           "clamped_levels": (4, 40)}  # conditions, seeds


def asked(study):
    """(overrides of each condition but the seed, the seeds) of an experiment."""
    node = read_yaml((conf_dir() / "experiment" / f"{study}.yaml").read_text())
    params = dict(node["hydra"]["sweeper"]["params"])
    first, _, last = params.pop("seed").partition("-")
    swept = [[f"{name}={value}" for value in values.split(",")] for name, values in params.items()]
    variants = [[f"{name}={value}" for name, value in of.items()] for of in node.get("variants", {"": {}}).values()]
    return [[*variant, *chosen] for variant in variants for chosen in product(*swept)], range(int(first), int(last) + 1)


@pytest.mark.parametrize("study", STUDIES)
def test_every_condition_plays_one_role(study):
    claims = load_claims(study)
    conditions, seeds = asked(study)
    assert (len(conditions), len(seeds)) == STUDIES[study]
    assert claims.rules.least_seeds <= len(seeds) and not set(seeds) & set(range(20))  # none that `controls` used
    played = set()
    for overrides in conditions[::len(conditions) // len(claims.roles)]:  # the first of each variant
        config = attnlab.compose(f"+experiment={study}", *overrides)
        assert config["claims_file"] == study == config["study"]
        assert all(value_of({}, config, name) == (value if isinstance(value, str) else
                                                  "[" + ",".join(value) + "]") for name, value in claims.about.items())
        roles = [name for name, role in claims.roles.items()
                 if all(text(value_of({}, config, told)) == text(value) for told, value in role.where.items())]
        assert len(roles) == 1, overrides
        played.add(roles[0])
    assert played == set(claims.roles)

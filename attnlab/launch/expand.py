"""The jobs of a sweep: every choice of what is swept, under every variant, with every seed."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from hydra.core.override_parser.types import Override

from attnlab.launch.compose import Composer
from attnlab.launch.door import Door
from attnlab.launch.jobs import Job, check_different, condition_of, make_job
from attnlab.launch.variants import Variants, as_override
from attnlab.robot.agents import pinned
from attnlab.robot.plan import RunPlan
from attnlab.robot.recorded import settled


class Expansion:
    """``merged``: overrides by setting, what is typed having replaced what the experiment file sweeps."""

    def __init__(self, composer: Composer, door: Door, merged: Mapping[str, Override]):
        self.composer, self.door, self.merged = composer, door, merged
        self.swept = [name_of(override) for override in merged.values() if override.is_sweep_override()]
        seed = merged.get("seed")
        self.seeds = None if seed is None else [int(o.partition("=")[2]) for o in choices(seed)]

    def jobs(self, variants: Variants, also: Mapping[str, Any] | None = None, seeds: Sequence[int] | None = None
             ) -> list[Job]:
        """All of them, checked. ``also``: settings that all have, whatever is typed for them; ``seeds``: other ones
        than those asked for. Raises ConfigError."""
        also = also or {}
        for together in (*variants.values(), also):
            for key, value in together.items():
                self.door.check_setting(key, value)
        seeds, jobs = self.seeds if seeds is None else seeds, list[Job]()
        for typed in itertools.product(*(choices(o) for key, o in self.merged.items() if key != "seed")):
            for variant, together in variants.items():
                # What is swept or typed for one of a variant's settings gives way: the variant is what is compared.
                overrides = [o for o in typed if _key(o) not in together and _key(o) not in also]
                overrides += [f"{key}={as_override(value)}" for key, value in (*together.items(), *also.items())]
                values = {key: _value(overrides, key) for key in self.swept if key != "seed" and key not in together}
                named = list(values)
                if variant is not None:
                    values.update({"variant": variant, **{key: shown(value) for key, value in together.items()}})
                    named.append("variant")
                jobs += _of_condition(pinned(self.composer.config(overrides)), overrides, values, named, seeds)
        check_different(jobs)
        return jobs

    # for a search, which chooses one value of each sweep

    def sweeps(self) -> dict[str, Override]:
        """What is swept but seeds, by setting."""
        return {name_of(o): o for key, o in self.merged.items() if key != "seed" and o.is_sweep_override()}

    def key(self, setting: str) -> str:
        """A swept setting as it is typed: ``+generation`` of ``generation``."""
        return str(self.sweeps()[setting].get_key_element())

    def base(self) -> dict[str, Any]:
        """The config with everything at its default that is swept."""
        return self.composer.config([choices(o)[0] for key, o in self.merged.items()
                                     if key != "seed" and not o.is_sweep_override()])

    def trial(self, point: Mapping[str, str]) -> list[Job]:
        """The jobs of one choice, checked; ``point``: the text of each swept setting. Raises ConfigError."""
        overrides = [f"{o.get_key_element()}={point[name_of(o)]}" if name_of(o) in point else choices(o)[0]
                     for key, o in self.merged.items() if key != "seed"]
        values = {name: _value(overrides, name) for name in point}
        return list(_of_condition(pinned(self.composer.config(overrides)), overrides, values, list(values), self.seeds))


def _of_condition(config: dict[str, Any], overrides: list[str], values: dict[str, Any], named: list[str],
                  seeds: Sequence[int] | None) -> Iterator[Job]:
    """The jobs of a condition, one a seed; its config is checked once, its world for every seed."""
    config = settled(config)
    condition = condition_of(config, values, overrides)
    plan = None
    for number in [config["seed"]] if seeds is None else seeds:
        plan = RunPlan({**config, "seed": number}) if plan is None else plan.with_seed(number)
        more = [] if seeds is None else [f"seed={number}"]
        yield make_job(plan, [*overrides, *more], values, named, condition)


def choices(override: Override) -> list[str]:
    """An override as a list of plain ones."""
    key = override.get_key_element()
    if override.is_sweep_override():
        return [f"{key}={value}" for value in override.sweep_string_iterator()]
    return [f"{key}={override.get_value_element_as_str()}" if not override.is_delete() else str(override.input_line)]


def name_of(override: Override) -> str:
    """The setting that an override is about."""
    return str(override.get_key_element().lstrip("+~"))


def _key(override: str) -> str:
    return override.partition("=")[0].lstrip("+~")


def _value(overrides: Sequence[str], key: str) -> Any:
    import yaml
    text = next(o.partition("=")[2] for o in overrides if _key(o) == key)
    value = yaml.safe_load(text) if text[:1] not in "[{" else text
    return shown(value) if value is not None else text


def shown(value: Any) -> Any:
    """A setting as a table's column may hold it."""
    return value if isinstance(value, (int, float, bool, str)) else str(value)

"""The one door: built-in parts, files in plugins/ and pip packages register here, in the same way.

    @register("curiosity", "mine")
    class Mine(Curiosity):
        '''What it is, its source, what it draws at random.'''
        @dataclass
        class Params: ...

What a part promises is checked here, once, so that nobody else has to. :mod:`attnlab.loading` imports the modules; one
that fails is kept in :data:`failures`, shown by ``python -m attnlab.parts``, and raised with its cause when somebody
asks for it by name; the others go on.
"""

from __future__ import annotations

import dataclasses
import importlib.util
import inspect
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

from attnlab import settings
from attnlab.errors import ConfigError, describe, nearest
from attnlab.groups import GROUPS

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Part = TypeVar("Part")


@dataclasses.dataclass
class NoParams:
    """A part without settings."""


@dataclasses.dataclass(frozen=True)
class Spec:
    """A registered part: where it comes from and what it takes."""
    group: str
    name: str
    cls: type
    presets: Mapping[str, Mapping[str, Any]]
    origin: str

    @property
    def params(self) -> type[DataclassInstance]:
        found: type[DataclassInstance] = getattr(self.cls, "Params", NoParams)
        return found

    @property
    def options(self) -> tuple[str, ...]:
        """The names under which it can be chosen: its own and its presets'."""
        return self.name, *self.presets

    def nodes(self) -> dict[str, dict[str, Any]]:
        """Config options of this part by option name: the part with its defaults, and its presets."""
        base = settings.defaults_of(self.params)
        nodes = {self.name: {"name": self.name, **base}}
        for preset, values in self.presets.items():
            nodes[preset] = {"name": preset, "part": self.name, **base, **values}
        return nodes


parts: dict[tuple[str, str], Spec] = {}
failures: dict[str, tuple[str, BaseException]] = {}  # module or entry point -> (file, what it raised)


def register(group: str, name: str, *, presets: Mapping[str, Mapping[str, Any]] | None = None
             ) -> Callable[[type[Part]], type[Part]]:
    """Class decorator: ``group=name`` now means this class. ``presets`` are further options: name -> parameters."""
    def door(cls: type[Part]) -> type[Part]:
        origin = inspect.getsourcefile(cls) or cls.__module__
        if group not in GROUPS:
            raise ValueError(f"{origin}: there is no group '{group}'. {nearest(group, GROUPS)}")
        check_class(group, cls, origin)
        check_params(group, cls, origin)
        for option in (name, *(presets or {})):
            old = find(group, option)
            if old is not None and old.cls is not cls:
                raise ValueError(f"{origin}: {group} '{option}' is already registered by {old.origin}")
        parts[group, name] = Spec(group, name, cls, presets or {}, origin)
        return cls
    return door


def check_class(group: str, cls: type, origin: str) -> None:
    """Raise TypeError unless a part derives from its group's base class, has all methods, and calls their arguments by
    the names that the base class gives them."""
    base = GROUPS[group].base_class()
    if not issubclass(cls, base):
        raise TypeError(f"{origin}: {cls.__name__} is no {base.__name__}: write class {cls.__name__}({base.__name__}), "
                        f"from {base.__module__}")
    if inspect.isabstract(cls):
        raise TypeError(f"{origin}: {cls.__name__} lacks {', '.join(sorted(vars(cls)['__abstractmethods__']))}")
    if hasattr(cls, "check_declared"):
        try:
            cls.check_declared()
        except TypeError as cause:
            raise TypeError(f"{origin}: {cause}") from None
    for name, promised in inspect.getmembers(base, inspect.isroutine):
        given = getattr(cls, name)
        if name.startswith("_") or given is promised or not inspect.isroutine(given):
            continue
        wanted, found = (_arguments(function) for function in (promised, given))
        if wanted is not None and found is not None and not _fits(found, wanted):
            raise TypeError(f"{origin}: {cls.__name__}.{name}({', '.join(p.name for p in found)}) must take "
                            f"({', '.join(p.name for p in wanted)})")


def _arguments(function: Callable[..., Any]) -> list[inspect.Parameter] | None:
    """The parameters of a method but self, or None if they cannot be told."""
    try:
        found = list(inspect.signature(function).parameters.values())
    except (TypeError, ValueError):
        return None
    return [p for p in found if p.name not in ("self", "cls")]


def _fits(found: list[inspect.Parameter], wanted: list[inspect.Parameter]) -> bool:
    """May a method with parameters ``found`` be called as one with ``wanted``?"""
    if any(p.kind is p.VAR_POSITIONAL for p in found):
        return True
    plain = [p for p in found if p.kind is not p.VAR_KEYWORD]
    names = [p.name for p in plain]
    return names[:len(wanted)] == [p.name for p in wanted] and all(p.default is not p.empty
                                                                   for p in plain[len(wanted):])


def check_params(group: str, cls: type, origin: str) -> None:
    """Raise TypeError unless the parameters of a part are a dataclass of typed fields whose defaults are valid."""
    params = getattr(cls, "Params", NoParams)
    if not dataclasses.is_dataclass(params):
        raise TypeError(f"{origin}: {cls.__name__}.Params must be a dataclass with typed fields")
    for name, value in vars(params).items():
        if not (name.startswith("_") or callable(value) or name in params.__annotations__
                or isinstance(value, (property, staticmethod, classmethod))):
            raise TypeError(f"{origin}: parameter '{name}' of {cls.__name__} has no type: write {name}: float = ...")
    if GROUPS[group].in_report:
        return
    for field in dataclasses.fields(params):
        if field.default is field.default_factory is dataclasses.MISSING:
            raise TypeError(f"{origin}: parameter '{field.name}' of {cls.__name__} has no default")
    try:
        settings.build(params, settings.defaults_of(params), group)
    except (ConfigError, NameError) as cause:
        raise TypeError(f"{origin}: {cls.__name__}'s parameters do not accept their own defaults: {cause}") from None


def find(group: str, option: str) -> Spec | None:
    """The part behind an option name (its own or a preset's), or None."""
    for spec in parts.values():
        if spec.group == group and (option == spec.name or option in spec.presets):
            return spec
    return None


def get(group: str, node: Mapping[str, Any], where: str) -> Spec:
    """The part that a config node names. Raises ConfigError if there is none, or if a package it ``requires`` is not
    installed (``extra``: of this package, which brings it)."""
    name = node.get("part") or node.get("name")
    spec = parts.get((group, str(name)))
    if spec is None:
        raise unknown(group, str(name), where)
    for package in getattr(spec.cls, "requires", ()):
        if importlib.util.find_spec(package) is None:
            extra = getattr(spec.cls, "extra", "")
            what = f"'attnlab[{extra}]'" if extra else package
            raise ConfigError(f"{where}={name}", f"needs the package {package}, which is not installed here",
                              f"pip install {what}, or choose another {group}")
    return spec


def unknown(group: str, name: str, where: str, known: list[str] | None = None) -> ConfigError:
    """The error for a name nobody registered: the cause, if a plugin of that name failed to load."""
    for module, (file, cause) in failures.items():
        if module.rpartition(".")[2] == name or f"'{name}'" in str(cause):
            return ConfigError(f"{where}={name}", f"{file} did not load: {describe(cause)}", "Mend that file")
    names = known or [option for spec in parts.values() if spec.group == group for option in spec.nodes()]
    return ConfigError(f"{where}={name}", f"no {'behaviour' if group == 'behaviours' else group} is called '{name}'",
                       nearest(name, names))


def build_params(group: str, node: Any, where: str) -> tuple[Spec, Any]:
    """The part a node names, and its checked parameters."""
    if not isinstance(node, Mapping) or not (node.get("part") or node.get("name")):
        known = sorted(s.name for s in parts.values() if s.group == group)
        if isinstance(node, Mapping) and node:
            raise ConfigError(where, f"the {group} file chosen does not say which part it sets",
                              f"Write 'part: {known[0]}' into it (known: {', '.join(known)})")
        raise ConfigError(where, f"expected the name of a {group}, got {node!r}", nearest("", known))
    spec = get(group, node, where)
    values = {key: value for key, value in node.items() if key not in ("name", "part")}
    return spec, settings.build(spec.params, values, where)


def make(group: str, node: Mapping[str, Any], context: Any, where: str = "") -> Any:
    """Construct the part that a config node names; its class is called with (params, context)."""
    where = where or group
    spec, params = build_params(group, node, where)
    try:
        part = spec.cls(params, context)
    except ConfigError as error:
        inner = error.setting if error.setting.startswith(where) else f"{where}.{error.setting}"
        raise ConfigError(inner, error.problem, error.hint) from None
    part.name = node["name"]
    return part



"""What was written of objects, into objects that were made anew."""

from __future__ import annotations

import base64
import operator
import sys
from collections import deque
from collections.abc import Iterable, Mapping
from random import Random
from typing import Any

import numpy as np

from attnlab import registry
from attnlab.robot.state import CODE, UnkeptError, named


def restore(roots: Mapping[str, Any], content: Mapping[str, Any], streams: bool = True) -> dict[str, Any]:
    """Make these objects hold what others held that were written, and return them; one that cannot be changed in place
    (a tuple) comes back as another. A name that ``content`` does not have, and with ``streams=False`` every random
    stream, stays as it is. Raises :class:`UnkeptError`."""
    reader = _Reader(roots, streams)
    return {name: reader.value(root, content[name], name) if name in content else root for name, root in roots.items()}


class _Reader:
    """Writes content into objects. Lists, mappings and objects that are there are kept and changed in place, each for
    one place alone, for others may point to them."""

    def __init__(self, roots: Mapping[str, Any], streams: bool):
        self.roots, self.streams = roots, streams
        self.placed, self.used = dict[str, Any](), set[int]()

    def value(self, there: Any, content: Any, path: str) -> Any:
        """What ``content`` says, in place of what is ``there`` now."""
        if isinstance(content, list):
            return self.items(self._own(there, list, path), content, path)
        if not isinstance(content, dict):
            return content
        if "has" in content:
            return self.object(there, content, path)
        if "dict" in content:
            return self.mapping(self._own(there, dict, path), content["dict"].items(), path)
        if "pairs" in content:
            pairs = [(self.value(None, key, path), value) for key, value in content["pairs"]]
            return self.mapping(self._own(there, dict, path), pairs, path)
        if "same" in content:
            return self.placed[content["same"]] if content["same"] in self.placed else self.at(content["same"], path)
        if "made" in content:
            name = named(there if isinstance(there, CODE) else type(there))
            if content["made"] != name:
                raise UnkeptError(f"{path} was {content['made']}, and is {name}")
            return there
        if "float" in content:
            return float(content["float"])
        if "tuple" in content:
            before = there if type(there) is tuple else ()
            return tuple(self.value(before[i] if i < len(before) else None, item, f"{path}.{i}")
                         for i, item in enumerate(content["tuple"]))
        return self.rest(there, content, path)

    def rest(self, there: Any, content: dict[str, Any], path: str) -> Any:
        """Random streams and what is rare."""
        if "random" in content or "generator" in content:
            place = Random if "random" in content else np.random.Generator
            if type(there) is not place:
                raise UnkeptError(f"{path} is no {place.__name__}")
            self.placed[path] = there
            stream: Any = there
            if self.streams and isinstance(there, Random):
                there.setstate((3, _unpacked(content["random"]), content["gauss"]))
            elif self.streams:
                stream.bit_generator.state = self.value(None, content["generator"], path)
            return there
        new: Any
        if "array" in content:
            values = [float(v["float"]) if isinstance(v, dict) else v for v in content["values"]]
            new = np.array(values, np.dtype(content["array"])).reshape(content["shape"])
            if type(there) is np.ndarray and there.dtype == new.dtype and there.shape == new.shape:
                there[...] = new
                new = there
        elif "number" in content:
            return np.dtype(content["number"]).type(self.value(None, content["value"], path))
        elif "deque" in content:
            new = deque(self.items([], content["deque"], path), content["most"])
        elif "set" in content or "frozenset" in content:
            kind = set if "set" in content else frozenset
            new = kind(self.value(None, item, path) for item in content[kind.__name__])
        else:
            raise UnkeptError(f"{path} is of no kind that is known")
        self.placed[path] = new
        return new

    def items(self, target: list[Any], content: list[Any], path: str) -> list[Any]:
        before = list(target)
        if any(isinstance(item, (list, dict)) for item in content):
            content = [self.value(before[i] if i < len(before) else None, item, f"{path}.{i}")
                       for i, item in enumerate(content)]
        target[:] = content
        return target

    def mapping(self, target: dict[Any, Any], content: Iterable[tuple[Any, Any]], path: str) -> dict[Any, Any]:
        found = {key: self.value(target.get(key), value, f"{path}.{key}") for key, value in content}
        target.clear()
        target.update(found)
        return target

    def object(self, there: Any, content: dict[str, Any], path: str) -> Any:
        if named(type(there)) != content["is"] or id(there) in self.used:
            there = _made(content["is"], path, there)
        self.used.add(id(there))
        self.placed[path] = there
        for name, value in content["has"].items():
            before = getattr(there, name, None)
            after = self.value(before, value, f"{path}.{name}")
            if after is not before:
                object.__setattr__(there, name, after)
        return there

    def at(self, where: str, path: str) -> Any:
        """What is at a place that nothing was written to."""
        root, *steps = where.split(".")
        found = self.roots.get(root)
        try:
            for step in steps:
                found = found[int(step)] if isinstance(found, (list, tuple)) else found[step] \
                    if isinstance(found, dict) else getattr(found, step)
        except (LookupError, ValueError, AttributeError):
            found = None
        if found is None:
            raise UnkeptError(f"{path} is {where}, which is not there")
        return found

    def _own(self, there: Any, kind: type, path: str) -> Any:
        found = there if isinstance(there, kind) and id(there) not in self.used else kind()
        self.used.add(id(found))
        self.placed[path] = found
        return found


def _made(name: str, path: str, there: Any) -> Any:
    """An object of a class of ours, or of a module that brought a part, without calling anything of it."""
    ours = {"attnlab", *(spec.cls.__module__.partition(".")[0] for spec in registry.parts.values())}
    module, _, cls = name.partition(":")
    found = None
    if name.replace(":", ".").partition(".")[0] in ours and module in sys.modules:
        found = operator.attrgetter(cls)(sys.modules[module])
    if not isinstance(found, type):
        raise UnkeptError(f"{path} was a {name}, and is a {named(type(there))}")
    return object.__new__(found)


def _unpacked(text: str) -> tuple[int, ...]:
    return tuple(np.frombuffer(base64.b64decode(text), "<u4").tolist())

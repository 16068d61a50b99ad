"""Senses and draws that are told what to be, for behaviours alone."""

from __future__ import annotations

from types import SimpleNamespace

FAR = 5.0  # m: hears nothing near


class Told:
    """What a behaviour senses: ``heard`` by its frontal sonars, ``seen`` by its camera. ``ate`` is what it did."""

    def __init__(self, heard=None, seen=(), cycle=0, heading=0.0, **needs):
        self.heard, self.seen, self.cycle, self.turned, self.needs = heard or [FAR] * 8, seen, cycle, heading, needs
        self.ate: list[tuple] = []
        self.body = SimpleNamespace(consume=lambda name, amount: self.ate.append((name, amount)),
                                    larder=SimpleNamespace(take=lambda solid, cycle: self.ate.append((solid, cycle))))

    def front_distances(self): return list(self.heard)
    def heading(self): return self.turned
    def need(self, name): return self.needs[name]
    def blobs(self, kind): return list(self.seen)


def echoes(**at):
    """Eight sonars that hear nothing near but for those named: ``echoes(s0=0.6)`` hears something on the left."""
    return [at.get(f"s{i}", FAR) for i in range(8)]


class Draws:
    """A stream that gives these numbers; ``asked`` are the bounds it was asked for."""

    def __init__(self, *numbers):
        self.numbers, self.asked = list(numbers), []

    def uniform(self, low, high):
        self.asked.append((low, high))
        return self.numbers.pop(0)

    def random(self):
        return self.numbers.pop(0)

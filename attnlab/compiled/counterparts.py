"""What stands in compiled code for the few methods whose Python cannot: those that keep records, draw, or ask the
simulator. They do the same, and the tests of both engines say so."""

from __future__ import annotations

import operator
from math import nan, sqrt
from random import Random

from numba import types
from numba.extending import lower_builtin, overload_method

from attnlab.attention import Log
from attnlab.behaviours.base import RobotSenses
from attnlab.compiled.methods import counterpart
from attnlab.compiled.words import as_word, word_code
from attnlab.curiosity.base import Curiosity
from attnlab.cycle import History
from attnlab.kernels import planar as kernels
from attnlab.needs.base import Body, Larder
from attnlab.simulators.base import Blob
from attnlab.simulators.planar import Planar
from attnlab.simulators.robot import CAMERA_HEIGHT_M, RADIUS_M, SONAR_MIN_M


@counterpart(Log)
def append(self, look):
    row = self.table[self.rows]
    row[0], row[1], row[2], row[3], row[4] = look.cycle, look.sigma, look.percept, look.level, look.period
    row[5], row[6], row[7] = look.wanting, look.liking, 1.0 if look.released else 0.0
    row[8] = nan if look.reward is None else look.reward
    row[9] = nan if look.extrinsic is None else look.extrinsic
    self.rows += 1


@counterpart(Log)
def clear(self):
    self.rows = 0


counterpart(History)(clear)


@counterpart(History)
def add(self, cycle, active, body):
    row = self.table[self.rows]
    row[0], row[1], row[2] = cycle, active, body.energy
    for i in range(len(body.values)):
        row[3 + i] = body.values[i]
    self.rows += 1


@counterpart(Curiosity, also_below=True)
def memory(self):
    """What memory() made when the run was laid out; whoever sets it anew copies its content."""
    return self._fresh


@counterpart(Random)
def random(self):
    """MT19937's next 53 bits (Matsumoto & Nishimura 1998), as :meth:`random.Random.random` takes them."""
    high, low = self._word() >> 5, self._word() >> 6
    return (high * 67108864.0 + low) * (1.0 / 9007199254740992.0)


@counterpart(Random)
def _word(self):
    state = self.state
    if self.at >= 624:
        for i in range(624):
            y = (state[i] & 0x80000000) | (state[(i + 1) % 624] & 0x7FFFFFFF)
            state[i] = state[(i + 397) % 624] ^ (y >> 1) ^ (0x9908B0DF if y & 1 else 0)
        self.at = 0
    y = state[self.at]
    self.at += 1
    y ^= y >> 11
    y ^= (y << 7) & 0x9D2C5680
    y ^= (y << 15) & 0xEFC60000
    return y ^ (y >> 18)


@counterpart(Random)
def uniform(self, a, b):
    return a + (b - a) * self.random()


@counterpart(Body)
def place(self, name):
    for i in range(len(self.names)):
        if self.names[i] == word_code(name):
            return i
    raise KeyError("nobody brings this need")


@counterpart(RobotSenses)
def need(self, name):
    return self.body.values[self.body.place(name)]


@counterpart(Larder)
def reserve(self, solids):
    raise IndexError("a source that is no solid of the layout")


@counterpart(RobotSenses)
def front_distances(self):
    if self._front_at != self.cycle:
        self.simulator.hear(self._front)
        self._front_at = self.cycle
    return self._front


@counterpart(RobotSenses)
def ring(self):
    if self._ring_at != self.cycle:
        self.simulator.hear(self._ring)
        self._ring_at = self.cycle
    return self._ring


@counterpart(RobotSenses)
def blobs(self, kind):
    simulator = self.simulator
    if self._blobs_at != self.cycle:
        simulator.look()
        self._blobs_at = self.cycle
    found = []
    for row in simulator._seen[:simulator._found]:
        box = int(row[0])
        solid = simulator._solid[box]
        if simulator._kinds[box] == word_code(kind) and self.body.larder.has(solid, self.cycle):
            bearing = simulator.camera.bearing(row[1])
            found.append(Blob(as_word(simulator._kinds[box]), bearing, int(row[2]), int(row[3]),
                              simulator.camera.distance(row[2], bearing), solid))
    return found


@counterpart(RobotSenses)
def heading(self):
    return self.simulator.trace[self.simulator.cycle, 2]


@counterpart(Planar)
def hear(self, distances):
    kernels.sonar(self.trace, self.cycle, self._boxes, self._beams, self.params.sonar_range_m, SONAR_MIN_M, distances)
    for k in range(len(distances)):
        along = distances[k] + self._along[k]
        distances[k] = sqrt(along * along + self._across2[k])


@counterpart(Planar)
def look(self):
    camera = self.camera
    self._found = kernels.blobs(self.trace, self.cycle, self._boxes, self._cubes, camera.columns, camera.rows,
                                camera.focal_px, CAMERA_HEIGHT_M, self._seen)


@counterpart(Planar)
def advance(self, v, w, cycles):
    if cycles >= len(self.trace) - self.cycle:
        raise IndexError("more cycles than an episode has")
    moved = kernels.advance(self.trace, self.cycle, self._boxes, v, w, self.dt_s, cycles, RADIUS_M, self._safety_m,
                            self._front, self.params.sonar_range_m, SONAR_MIN_M)
    if moved < 0:
        self.cycle -= moved
        return -moved, True
    self.cycle += moved
    return moved, False


@overload_method(types.Array, "index")
def _index(values, value):
    """The first place of a value, as a list has it."""
    def index(values, value):
        for i in range(len(values)):
            if values[i] == value:
                return i
        raise ValueError("this is not in it")
    return index


def _power(context, builder, signature, args):
    """A float to a whole power is C's pow, as Python has it, rounded once; numba multiplies, rounding each time."""
    exponent = context.cast(builder, args[1], signature.args[1], types.float64)
    of = signature.replace(args=(types.float64, types.float64))
    return context.get_function(operator.pow, of)(builder, (args[0], exponent))


for _whole in (types.int64, types.IntegerLiteral):
    lower_builtin(operator.pow, types.float64, _whole)(_power)
    lower_builtin(operator.ipow, types.float64, _whole)(_power)

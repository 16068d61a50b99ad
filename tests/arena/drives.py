"""Drives and logs that tests of the arena make."""

from random import Random

from attnlab.arena.drive import Drive


def pulses(n=2000, seed=0):
    """Something near for 12 cycles after every 40 to 60 far ones; it comes closer over six cycles, so that it can be
    foreseen by who watches."""
    draw, near = Random(seed), []
    while len(near) < n:
        near += [0.95] * draw.randrange(40, 60) + [0.95 - 0.06 * k for k in range(6)] + [0.3] * 12
    return Drive("pulses", tuple(near[:n]), (0,), 0.1, ())


def logged(tmp_path, name="pulses.csv"):
    made = pulses(900)
    (tmp_path / name).write_text("t_s,r10\n" + "\n".join(f"{0.1 * i},{x}" for i, x in enumerate(made.near_m)) + "\n")
    return str(tmp_path / name)

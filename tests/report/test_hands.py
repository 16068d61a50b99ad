"""Work done side by side: the same answers whoever does it, and a process that dies costs its piece alone."""

import os
import signal
import time

import pytest

from attnlab.report.hands import Hands

forks = pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")


def answers(count, work, pieces, heard=None):
    with Hands(work, "{}: {}".format, pieces, count) as hands:
        return hands.answers((heard if heard is not None else []).append)


@forks
@pytest.mark.parametrize("count", [1, 2, 5])
def test_the_order_is_that_of_the_pieces(count):
    heard = []
    assert answers(count, lambda piece: piece * piece, list(range(7)), heard) == [0, 1, 4, 9, 16, 25, 36]
    assert heard[-1] == 7 and heard == sorted(heard)


@forks
@pytest.mark.parametrize("count", [2, 3])
def test_what_kills_its_process_is_named_and_the_rest_is_done(count):
    def work(piece):
        if piece in "bd":
            os.kill(os.getpid(), signal.SIGTERM if piece == "b" else signal.SIGKILL)
        return piece.upper()
    assert answers(count, work, list("abcde")) == [
        "A", "b: the process that did it died of SIGTERM (signal 15)", "C",
        "d: the process that did it died of SIGKILL (signal 9)", "E"]


@forks
def test_nobody_is_left_at_work():
    with Hands(time.sleep, "{}: {}".format, [600, 600], 2) as hands:
        at_work = list(hands._hands.values())
    assert len(at_work) == 2 and not any(hand.is_alive() for hand in at_work)


def test_no_pieces():
    assert answers(4, str, []) == []

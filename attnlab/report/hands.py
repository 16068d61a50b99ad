"""Many hands: pieces of work done side by side by processes forked from this one, which have all that it had loaded."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from multiprocessing.connection import Connection, wait
from typing import TYPE_CHECKING, Generic, Self, TypeVar

from attnlab.tables.processes import cores, signal_name

if TYPE_CHECKING:
    from multiprocessing.context import ForkProcess

Piece = TypeVar("Piece")
Answer = TypeVar("Answer")


def side_by_side() -> int:
    """Processes that may be forked here: one a core, none where a fork is not safe (threads of ours are at work, or the
    system's libraries do not allow it)."""
    alone = sys.platform == "linux" and threading.active_count() == 1 and not multiprocessing.current_process().daemon
    return cores() if alone else 1


class Hands(Generic[Piece, Answer]):
    """``work`` done of each of ``pieces`` by ``count`` processes while this one goes on; entering begins it, leaving
    ends whatever is still at work. With one hand, all is done here, when the answers are asked for.

    An answer depends on its piece alone and they come in the order of the pieces, whoever did them. What a process
    dies of is the answer to the piece that it had: ``lost(piece, why)``. ``work`` should raise nothing.
    """

    def __init__(self, work: Callable[[Piece], Answer], lost: Callable[[Piece, str], Answer], pieces: Sequence[Piece],
                 count: int):
        self._work, self._lost, self._pieces = work, lost, pieces
        self._count = min(count, len(pieces)) if count > 1 else 0
        self._answers: dict[int, Answer] = {}
        self._hands: dict[Connection, ForkProcess] = {}
        self._at: dict[Connection, int] = {}  # the piece that each has

    def __enter__(self) -> Self:
        # Numbers of pieces, two bytes each, in a pipe from which the free one reads the next: no lock that could stay
        # with a process that dies, and an end that all see.
        self._next, end = os.pipe()
        with os.fdopen(end, "wb") as numbers:
            for number in range(len(self._pieces)) if self._count else ():
                numbers.write(number.to_bytes(2))
        for _ in range(self._count):
            self._fork()
        return self

    def __exit__(self, *_: object) -> None:
        for hand in self._hands.values():
            hand.kill()
        for hand in self._hands.values():
            hand.join()
        os.close(self._next)

    def answers(self, tell: Callable[[int], None]) -> list[Answer]:
        """Of every piece; ``tell`` hears how many are done whenever there are more."""
        while self._hands:
            for pipe in wait(list(self._hands)):
                self._hear(pipe)  # type: ignore[arg-type]
            tell(len(self._answers))
        for number, piece in enumerate(self._pieces):
            if number not in self._answers:
                self._answers[number] = self._work(piece)
                tell(len(self._answers))
        return [self._answers[number] for number in range(len(self._pieces))]

    def _fork(self) -> None:
        """One hand more; none where the system has no room for it."""
        context = multiprocessing.get_context("fork")
        mine, theirs = context.Pipe(duplex=False)
        hand = context.Process(target=self._do, args=(theirs,), daemon=True)
        with suppress(OSError):
            hand.start()
            self._hands[mine] = hand
        theirs.close()

    def _do(self, pipe: Connection) -> None:
        """In the process: one piece after the other, until there is none, or nobody who wants it."""
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # a Ctrl-C in the terminal is the parent's to hear
        parent = os.getppid()
        while (read := os.read(self._next, 2)) and os.getppid() == parent:
            number = int.from_bytes(read)
            pipe.send(number)
            pipe.send((number, self._work(self._pieces[number])))

    def _hear(self, pipe: Connection) -> None:
        try:
            said = pipe.recv()
        except (EOFError, OSError):
            self._gone(pipe)
            return
        if isinstance(said, int):
            self._at[pipe] = said
        else:
            number, answer = said
            self._answers[number] = answer
            del self._at[pipe]

    def _gone(self, pipe: Connection) -> None:
        """A process ended; if it died of its piece another one takes its place."""
        hand = self._hands.pop(pipe)
        hand.join()
        pipe.close()
        number = self._at.pop(pipe, None)
        if number is not None:
            code = hand.exitcode or 0
            why = f"died of {signal_name(-code)}" if code < 0 else f"ended with exit code {code}"
            self._answers[number] = self._lost(self._pieces[number], f"the process that did it {why}")
            self._fork()

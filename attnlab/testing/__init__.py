"""What a part must keep, as tests its author can run: three lines in a test file.

    from attnlab.testing import conformance
    test_mine = conformance("curiosity", "mine")

Every built-in part passes the same. ``make`` and ``config`` build a part or a whole run for tests of your own.
"""

from attnlab.testing.build import config, make, run
from attnlab.testing.compiled import compiles
from attnlab.testing.suite import checks, conformance

__all__ = ["checks", "compiles", "config", "conformance", "make", "run"]

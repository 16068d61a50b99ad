"""What every command shares: one line for a user's error, exit codes 0, 1, 2, and a clean stop on Ctrl-C."""

from __future__ import annotations

import errno
import sys
from collections.abc import Callable, Sequence

from attnlab.errors import ConfigError

UNWRITABLE = (errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOSPC)


def guarded(main: Callable[[Sequence[str]], int], argv: Sequence[str] | None = None) -> int:
    """Call ``main(argv)``; a ConfigError becomes one line on standard error and 2, Ctrl-C becomes 130."""
    try:
        return main(sys.argv[1:] if argv is None else argv)
    except ConfigError as error:
        print(f"attnlab: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("attnlab: stopped; what was complete stays, and the same command goes on from there", file=sys.stderr)
        return 130
    except BrokenPipeError:  # | head
        sys.stderr.close()
        return 0
    except OSError as cause:
        if cause.errno not in UNWRITABLE:
            raise
        print(f"attnlab: {cause.filename or 'output'}: {cause.strerror}", file=sys.stderr)
        return 2

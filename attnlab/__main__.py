"""``python -m attnlab``."""

import os
import signal
import sys

if __name__ == "__main__":
    signal.signal(signal.SIGINT, lambda *_: os._exit(130))  # Ctrl-C while modules are imported: nothing was begun
    from attnlab.cli.main import main
    signal.signal(signal.SIGINT, signal.default_int_handler)
    sys.exit(main())

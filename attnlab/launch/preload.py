"""What every run's process needs, imported once by the server they are forked from: all that is ours, and never a
plugin, which must be read as it stands when its run starts."""

from __future__ import annotations

import omegaconf  # noqa: F401
import pandas  # noqa: F401  pyarrow imports it when it is first given a list
import pyarrow.parquet  # noqa: F401

import attnlab.launch.worker  # noqa: F401
from attnlab.loading import load_built_in

load_built_in()

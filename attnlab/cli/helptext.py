"""What ``python -m attnlab --help`` says."""

from __future__ import annotations

import textwrap

from attnlab.cli.listing import options
from attnlab.config import RunSettings
from attnlab.groups import GROUPS

TEXT = """\
attnlab: learn where to look.

  python -m attnlab                                          one run: the curious robot of Di Nocera et al. 2014
  python -m attnlab +experiment=smoke                        does everything work here? (seconds)
  python -m attnlab +experiment=cr_vs_ncr -m seed=0-19       the paper's study: curious against non-curious, 40 runs
  python -m attnlab +experiment=controls -m seed=0-19        CR, and both robots that it may be held against
  python -m attnlab +experiment=baselines seed=0-4           fixed, random and always-on attention
  python -m attnlab curiosity=none reading=table4 seed=0-4,7 any part, any setting, any seeds
  python -m attnlab 'behaviours=[avoid,eat]' +behaviours=rest
  python -m attnlab -m learner.alpha=0.1,0.5,0.8 seed=0-9    a sweep of your own

A study that was interrupted goes on where it stopped: type the same command again.

  python -m attnlab.parts [NAME]                    all parts, or what one does and its settings
  python -m attnlab.report STUDY                    figures, Table 5, a verdict for each claim of the paper: one page
  python -m attnlab.audit [FILE]                    which cells of a summary table cannot be true together
  python -m attnlab.appraise RUN --curiosity all    a recorded run as every model of curiosity sees it
  python -m attnlab.certify                         are the two simulators the same robot in the same world?
  python -m attnlab.new behaviour NAME              start a part of your own: a file that works, and its test
  python -m attnlab --cfg job                       the composed config

Results as pandas frames: attnlab.load("outputs/cr_vs_ncr").episodes
"""


def help_text() -> str:
    """Commands, then the choices of each group, then the settings."""
    lines = [TEXT, "Choices (group=option):"]
    groups = {"experiment": "a study, ready to run", **{g.name: g.what for g in GROUPS.values() if g.in_run},
              "reading": "how the paper's open points are read"}
    for group, what in groups.items():
        lines += [f"  {group:12} {what}", *textwrap.wrap(", ".join(options(group)), 100, initial_indent=" " * 15,
                                                         subsequent_indent=" " * 15)]
    lines += ["", "Settings (setting=value):"]
    for name, field in RunSettings.__dataclass_fields__.items():
        doc = field.metadata.get("doc")
        if doc and name not in groups:
            value = field.default_factory() if callable(field.default_factory) else field.default
            shown = "" if not isinstance(value, (int, float, str, list)) else f" [{value}]"
            unit = f" ({field.metadata['unit']})" if field.metadata.get("unit") else ""
            lines += textwrap.wrap(f"{doc}{unit}{shown}", 100, initial_indent=f"  {name:20}",
                                   subsequent_indent=" " * 22)
    return "\n".join(lines)



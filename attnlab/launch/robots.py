"""The two robots as a study speaks of them: which other one there is, and what the certificate says of both."""

from __future__ import annotations

import json
import shlex
from collections.abc import Sequence

from attnlab.launch.jobs import Job
from attnlab.paths import certificate_file

TRANSFER = "transfer_"  # rows of the certificate in points of survival


def at_start(jobs: Sequence[Job]) -> str:
    """A line for who is about to wait: empty unless several runs are to be done on the slower robot."""
    if len(jobs) < 2 or _robot(jobs) != "pybullet":
        return ""
    return f"on pybullet; simulator=planar gives the same study several times faster. {certificate()}".rstrip()


def at_end(jobs: Sequence[Job], typed: Sequence[str]) -> dict[str, str]:
    """What to type for the other robot, and how far the two agree. ``typed``: the arguments of this study."""
    study, robot = jobs[0].folder.parent.name, _robot(jobs)
    other = {"planar": "pybullet", "pybullet": "planar"}.get(robot)
    if other is None:
        return {}
    kept = [argument for argument in typed if not argument.startswith(("simulator=", "study="))]
    command = "python -m attnlab " + shlex.join([*kept, f"simulator={other}", f"study={study}_{other}"])
    if other == "pybullet":
        return {"on pybullet": command}
    return {"on planar": command, "of the two": f"the same study, several times faster. {certificate()}".rstrip()}


def _robot(jobs: Sequence[Job]) -> str:
    """The simulator of all jobs; empty if they differ, or if it is a robot that has no other."""
    names = {str(job.settings.simulator["name"]) for job in jobs}
    wheels = any(job.settings.simulator.get("drive") == "wheels" for job in jobs)
    return names.pop() if len(names) == 1 and not wheels else ""


def certificate() -> str:
    """What the stored certificate says of the two, in a sentence; empty where there is none."""
    file = certificate_file()
    if file is None:
        return ""
    found = json.loads(file.read_text())
    rows = found["verdict"]
    failed = [f"{row['meaning']} ({row['world']})" for row in rows if not row["passes"]]
    worst = max((abs(row["worst"]) for row in rows if row["measure"].startswith(TRANSFER)), default=None)
    moved = "" if worst is None else f"; what one learned survives on the other within {worst:.1f} points"
    verdict = f"pass {len(rows) - len(failed)} of {len(rows)} rules of being the same robot in the worlds " \
              f"{', '.join(found['worlds'])}"
    return f"Certificate (docs/certificate.md, code {found['commit']}): they {verdict}{moved}" + \
        (f"; not in: {', '.join(failed)}." if failed else ".")

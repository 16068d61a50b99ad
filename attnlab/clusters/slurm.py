"""Runs as an array of SLURM jobs."""

from __future__ import annotations

import shlex
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from attnlab.clusters.base import Cluster
from attnlab.clusters.elsewhere import reopen
from attnlab.errors import ConfigError
from attnlab.launch.jobs import Job
from attnlab.launch.progress import Display
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.tables.files import write_bytes

SCRIPT = "slurm.sh"
GRACE_S = 60  # before its time is over SLURM says so


@register("cluster", "slurm")
class Slurm(Cluster):
    """One script with an array of ``python -m attnlab.work``, kept in the study as slurm.sh and submitted; the command
    leaves at once, and ``python -m attnlab.watch STUDY`` tells how it stands. Typed again it goes on where it was."""

    @dataclass
    class Params:
        partition: str | None = setting(None, "of the cluster; its default if left out")
        account: str | None = setting(None, "that is charged")
        minutes: int = setting(60, "that a job of the array may take", unit="min", low=2)
        memory_gb: float = setting(2.0, "of a job", unit="GB", above=0)
        cpus: int = setting(1, "of a job: runs that it does side by side", low=1)
        runs_per_job: int = setting(10, "runs of the study for each job of the array", unit="runs", low=1)
        setup: list[str] = setting([], "lines of the shell before the command, e.g. [module load python]")

    def at_once(self, jobs: Sequence[Job]) -> int:
        return self._size(jobs) * int(self.params.cpus)

    def check(self) -> None:
        if shutil.which("sbatch") is None:
            raise ConfigError("cluster=slurm", "there is no sbatch on this machine", "cluster=local, or type it on a "
                              "login node of the cluster")

    def run(self, jobs: Sequence[Job], display: Display) -> None:
        """Write the script, submit it, and leave. Raises ConfigError with SLURM's own words if it is refused."""
        reopen(jobs)
        study = jobs[0].folder.parent.resolve()
        text = self.script(study, self._size(jobs))
        write_bytes(study / SCRIPT, text.encode())
        done = subprocess.run(["sbatch", "--parsable", str(study / SCRIPT)], capture_output=True, text=True,
                              check=False)
        if done.returncode:
            raise ConfigError("cluster=slurm", " ".join(done.stderr.split()) or "sbatch refused the script",
                              f"The script is {study / SCRIPT}")
        print(f"{text}\nsubmitted as job {done.stdout.strip()}; the script is {study / SCRIPT}\n"
              f"python -m attnlab.watch {shlex.quote(str(study))}   tells how it stands")

    def script(self, study: Path, size: int) -> str:
        """The script for an array of so many jobs."""
        p = self.params
        options = {"job-name": f"attnlab-{study.name}", "array": f"1-{size}", "time": str(p.minutes),
                   "mem": f"{round(p.memory_gb * 1024)}M", "cpus-per-task": str(p.cpus), "ntasks": "1",
                   "signal": f"B:TERM@{GRACE_S}", "output": f"{study}/slurm-%A_%a.log", "requeue": None,
                   "partition": p.partition, "account": p.account}
        lines = [f"#SBATCH --{name}={value}" if value else f"#SBATCH --{name}" for name, value in options.items()
                 if value or name == "requeue"]
        # exec: SLURM's signals reach the command itself, which gives back what it is at
        work = shlex.join(["exec", sys.executable, "-m", "attnlab.work", str(study)])
        spare = min(1.0, p.minutes / 4)
        return "\n".join(["#!/bin/bash", *lines, "", f"cd {shlex.quote(str(Path.cwd()))}", *p.setup,
                          f"{work} --share $SLURM_ARRAY_TASK_ID/{size} --jobs {p.cpus} --minutes {p.minutes - spare:g}",
                          ""])

    def _size(self, jobs: Sequence[Job]) -> int:
        return -(-len(jobs) // int(self.params.runs_per_job))

"""``python benchmarks/claims.py``: what claims and signs of life cost, as a share of a run's CPU time.

A run of the paper's length is played by both engines; then its claim is taken, looked at as often as the run does, kept
alive for as many signs of life as such a run gives, and given back, many times over. Others' claims stand beside it.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
RESULT = ROOT / "benchmarks" / "results" / "reliability" / "claims.json"
OTHERS, TIMES = 16, 200
LOOKS = 2  # of robot/folder.py: before the tables are written, and before "complete"


def claim_s(study: Path, beats: int) -> float:
    """CPU seconds of all that a run's claim needs."""
    from attnlab.tables.claim import take
    begin = time.process_time()
    claim = take(study, "mine")
    assert claim is not None
    for _ in range(beats):
        claim.beat(1, 1)
    for _ in range(LOOKS):
        assert claim.held()
    claim.release()
    return time.process_time() - begin


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--publish", action="store_true", help=f"store the figures in {RESULT.relative_to(ROOT)}")
    given = parser.parse_args()
    import attnlab
    from attnlab.loading import load_all
    from attnlab.robot.folder import run_to_folder
    from attnlab.tables.claim import BEAT_S, take
    load_all()
    found: dict[str, dict[str, float]] = {}
    with tempfile.TemporaryDirectory() as home:
        study = Path(home) / "study"
        others = [take(study, f"other{i}") for i in range(OTHERS)]
        for engine in ("compiled", "python"):
            config = attnlab.compose("simulator=planar", f"engine={engine}")
            folder = study / engine
            for _ in range(2):  # what is compiled first is kept
                run_to_folder(config, folder, {"run": engine, "key": engine, "overrides": [], "swept": {}})
            about = json.loads((folder / "run.json").read_text())
            beats = int(about["wall_s"] // BEAT_S) + 1
            cost = statistics.median(claim_s(study, beats) for _ in range(TIMES))
            found[engine] = {"run_cpu_s": about["cpu_s"], "beats": beats, "claim_cpu_s": cost,
                             "share": cost / about["cpu_s"]}
        for claim in others:
            if claim:
                claim.release()
    print(json.dumps(found, indent=1))
    if given.publish:
        RESULT.parent.mkdir(parents=True, exist_ok=True)
        RESULT.write_text(json.dumps({"engines": found, "others": OTHERS, "load": os.getloadavg()[0]}, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())

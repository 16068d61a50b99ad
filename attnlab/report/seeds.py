"""The runs of a study seed by seed: where a verdict leads, and where an episode is watched from."""

from __future__ import annotations

import os
import re
import shlex
from html import escape
from pathlib import Path
from urllib.parse import quote

from attnlab.report.page import Section
from attnlab.results.load import Study

MOST, MOST_DEATHS, MOST_REPLAYS = 120, 8, 4
LEAD = re.compile(r'<p class="lead">((\w+) episode (\d+))')  # of a replay's page: which episode it shows
Replays = dict[tuple[str, int], str]  # (phase, episode) -> address


def section(study: Study, target: Path) -> Section:
    """A row a run: how it lived in validation (in training where there is none), in which episodes it died, and its
    replays, or the command that makes one; a death in an episode that has a replay leads to its cycle. Links are
    relative to ``target``, the report's folder."""
    episodes = study.plain("episodes")
    valid = episodes[episodes["phase"] == "validation"]
    shown = {str(run): rows for run, rows in (valid if len(valid) else episodes).groupby("run", observed=True)}
    phase = "validation" if len(valid) else "train"
    named = study.named()
    runs = sorted(named, key=lambda run: (study.seed(run), list(named).index(run)))
    body, before = [], None
    for run in runs[:MOST]:
        seed, rows, replays = study.seed(run), shown.get(run), _replays(study.path / run, target)
        dead = [] if rows is None else [(int(episode), str(death), int(cycles)) for episode, death, cycles in
                                        zip(rows["episode"], rows["death"], rows["cycles"], strict=True)
                                        if death != "none"]
        told = ", ".join(_death(*of, replays.get((phase, of[0]))) for of in dead[:MOST_DEATHS]) or "none"
        told += f" and {len(dead) - MOST_DEATHS} more" if len(dead) > MOST_DEATHS else ""
        lived = "-" if rows is None else f"{100 * rows['survival'].mean():.1f}"
        anchor = f' id="seed-{seed}"' if seed != before else ""
        before = seed
        body.append(f'<tr{anchor}><td class=n>{seed}</td><td>{escape(named[run])}</td><td class=n>{lived}</td>'
                    f"<td>{told}</td><td>{_watch(study, run, replays, dead[0][0] if dead else None)}</td></tr>")
    heads = "".join(f'<th scope="col"{" class=n" if name in ("seed", "survival, %") else ""}>{name}</th>'
                    for name in ("seed", "condition", "survival, %", "died in episode", "watch"))
    more = f"<p class=small>The first {MOST} of {len(runs)} runs.</p>" if len(runs) > MOST else ""
    words = "validation" if len(valid) else "training"
    return Section("seeds", "Seed by seed", (
        f"<details><summary>{len(runs)} runs, and how to watch each</summary><div class=scroll tabindex=0 role=region "
        f'aria-label="runs"><table class=runs><thead><tr>{heads}</tr></thead><tbody>{"".join(body)}</tbody></table>'
        f"</div>{more}<p class=small>Survival and deaths in {words}. A command writes the replay of that episode, a "
        "page on which it is scrubbed; make the report anew, and it is linked here, a death to its cycle.</p>"
        "</details>"))


def _replays(folder: Path, target: Path) -> Replays:
    """The replays of a run (``replay.html``, ``replay-7.html``), by what they say that they show."""
    found: Replays = {}
    for page in sorted(folder.glob("replay*.html"))[:MOST_REPLAYS]:
        with page.open(encoding="utf-8", errors="replace") as file:
            lead = LEAD.search(file.read(20_000))
        href = escape(quote(Path(os.path.relpath(page.resolve(), target.resolve())).as_posix()))
        found[(lead[2], int(lead[3])) if lead else (page.stem, 0)] = href
    return found


def _death(episode: int, death: str, cycles: int, replay: str | None) -> str:
    """HTML: which episode, of what, and the way to the cycle in which it happened, where there is one."""
    text = f"{episode} {escape(death)}"
    return f'<a href="{replay}#cycle={cycles}">{text} in cycle {cycles}</a>' if replay else text


def _watch(study: Study, run: str, replays: Replays, episode: int | None) -> str:
    """The run's replays, and the command that makes that of its first death, or of its last episode."""
    command = f"python -m attnlab.replay outputs/{shlex.quote(f'{study.name}/{run}')}"
    command += f" --episode {episode}" if episode is not None else ""
    links = [f'<a href="{href}">{escape(phase)} episode {number}</a>' for (phase, number), href in replays.items()]
    return " ".join([*links, f"<code>{escape(command)}</code>"])

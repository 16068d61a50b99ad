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

MOST, MOST_DEATHS = 120, 8
LEAD = re.compile(r'<p class="lead">(\w+ episode \d+)')  # of a replay's page: which episode it shows


def section(study: Study, target: Path) -> Section:
    """A row a run: how it lived in validation (in training where there is none), in which episodes it died, and its
    replay, or the command that makes one; links are relative to ``target``, the report's folder."""
    episodes = study.plain("episodes")
    valid = episodes[episodes["phase"] == "validation"]
    shown = {str(run): rows for run, rows in (valid if len(valid) else episodes).groupby("run", observed=True)}
    named = study.named()
    runs = sorted(named, key=lambda run: (study.seed(run), list(named).index(run)))
    body, before = [], None
    for run in runs[:MOST]:
        seed, rows = study.seed(run), shown.get(run)
        dead = [] if rows is None else [(int(episode), str(death)) for episode, death in
                                        zip(rows["episode"], rows["death"], strict=True) if death != "none"]
        told = ", ".join(f"{episode} {death}" for episode, death in dead[:MOST_DEATHS]) or "none"
        told += f" and {len(dead) - MOST_DEATHS} more" if len(dead) > MOST_DEATHS else ""
        lived = "-" if rows is None else f"{100 * rows['survival'].mean():.1f}"
        anchor = f' id="seed-{seed}"' if seed != before else ""
        before = seed
        body.append(f'<tr{anchor}><td class=n>{seed}</td><td>{escape(named[run])}</td><td class=n>{lived}</td>'
                    f"<td>{escape(told)}</td><td>{_watch(study, run, target, dead[0][0] if dead else None)}</td></tr>")
    heads = "".join(f'<th scope="col"{" class=n" if name in ("seed", "survival, %") else ""}>{name}</th>'
                    for name in ("seed", "condition", "survival, %", "died in episode", "watch"))
    more = f"<p class=small>The first {MOST} of {len(runs)} runs.</p>" if len(runs) > MOST else ""
    phase = "validation" if len(valid) else "training"
    return Section("seeds", "Seed by seed", (
        f"<details><summary>{len(runs)} runs, and how to watch each</summary><div class=scroll tabindex=0 role=region "
        f'aria-label="runs"><table class=runs><thead><tr>{heads}</tr></thead><tbody>{"".join(body)}</tbody></table>'
        f"</div>{more}<p class=small>Survival and deaths in {phase}. A command writes the replay of that episode, a "
        "page on which it is scrubbed; make the report anew, and it is linked here.</p></details>"))


def _watch(study: Study, run: str, target: Path, episode: int | None) -> str:
    """The run's replay if there is one, and the command that makes that of its first death, or of its last episode."""
    page = study.path / run / "replay.html"
    command = f"python -m attnlab.replay outputs/{shlex.quote(f'{study.name}/{run}')}"
    command += f" --episode {episode}" if episode is not None else ""
    parts = [f"<code>{escape(command)}</code>"]
    if page.is_file():
        with page.open(encoding="utf-8", errors="replace") as file:
            found = LEAD.search(file.read(20_000))
        href = quote(Path(os.path.relpath(page.resolve(), target.resolve())).as_posix())
        parts.insert(0, f'<a href="{escape(href)}">{escape(found[1] if found else "replay")}</a>')
    return " ".join(parts)

"""The certificate as a Markdown page."""

from __future__ import annotations

from typing import Any

NUMBERS = (
    ("sonar error, no edge grazed: median, 99 %, max (m)", ("sonar_m_median", "sonar_m_p99", "sonar_m_max")),
    ("sonar error, all rays: median, 99 %, max (m)", ("sonar_all_m_median", "sonar_all_m_p99", "sonar_all_m_max")),
    ("rays compared; grazing share", ("rays", "rays_grazing_share")),
    ("blobs compared; seen by one only (share)", ("blobs", "blob_miss_share")),
    ("bearing error: median, 99 %, max (px)", ("bearing_px_median", "bearing_px_p99", "bearing_px_max")),
    ("height error: median, 99 %, max (px)", ("height_px_median", "height_px_p99", "height_px_max")),
    ("area error: median, 99 %, max (px)", ("area_px_median", "area_px_p99", "area_px_max")),
    ("contact disagreement (share of poses); deepest (m)", ("contact_disagreement_share", "contact_depth_max_m")),
    ("same commands: largest gap (m), turn (rad); ends that differ", ("drive_gap_max_m", "drive_turn_max_rad",
                                                                     "drive_end_disagreements")),
    ("closed loop: paired episodes; identical to 1 mm; identical before the first that is not",
     ("loop_episodes", "loop_identical", "loop_first")),
    ("closed loop: gap of paired episodes, median, 99 %, max (m)", ("loop_gap_m_median", "loop_gap_m_p99",
                                                                   "loop_gap_m_max")),
    ("total variation of percepts, periods (worst behaviour), deaths", ("percepts_tv", "periods_tv", "deaths_tv")),
    ("permutation test over runs that they differ: 1 - p", ("loops_differ",)),
    ("survival, trained on planar: on planar, pybullet", ("planar_on_planar", "planar_on_pybullet")),
    ("survival, trained on pybullet: on pybullet, planar", ("pybullet_on_pybullet", "pybullet_on_planar")),
    ("survival, trained on planar, on pybullet with drive=wheels", ("planar_on_wheels",)),
)


def number(value: float) -> str:
    """Short, without losing what is small."""
    if isinstance(value, int) or value == 0:
        return f"{value:.0f}"
    return f"{value:.3f}" if abs(value) >= 0.001 else f"{value:.1e}"


def page(certificate: dict[str, Any]) -> str:
    """Verdict, tolerances, then all numbers world by world."""
    c, worlds = certificate, certificate["worlds"]
    lines = [
        "# Certificate: planar and pybullet are the same robot in the same world", "",
        f"**{'Passes' if c['passes'] else 'Fails'}** with `{c['command']}` at commit {c['commit']}, "
        f"{c['poses']} poses a world, {c['seeds']} seeds of {c['train']} training and {c['validation']} validation "
        f"episodes; camera {c['camera']}; {', '.join(f'{k} {v}' for k, v in c['versions'].items())}. "
        "Made by `python -m attnlab.certify`, stored beside this page as JSON.", "",
        "| measure | meaning | tolerance | worst | in world | |", "|---|---|---|---|---|---|",
    ]
    lines += [f"| `{r['measure']}` | {r['meaning']} | {number(r['limit'])} {r['unit']} | {number(r['worst'])} | "
              f"{r['world']} | {'passes' if r['passes'] else '**fails**'} |" for r in c["verdict"]]
    lines += ["", "| | " + " | ".join(worlds) + " |", "|---|" + "---|" * len(worlds)]
    for title, keys in NUMBERS:
        cells = [", ".join(number(m[k]) for k in keys if k in m) for m in worlds.values()]
        if any(cells):
            lines.append(f"| {title} | " + " | ".join(cells) + " |")
    lines += [
        "", "How to read it. Poses are uniform over the floor and all headings; sensors are compared where the robot "
        "touches nothing. A grazing ray passes a vertical edge nearer than 1 mm: Bullet's triangles reach some "
        "hundredths of a millimetre beyond their edges, so it may hear an edge that planar's ray just misses. Bullet's "
        "contact is exact to some tenths of a millimetre. Closed loops are the same runs from the same seeds in both "
        "simulators, with learning: one such ray or contact changes what is learned and what follows; from there they "
        "are different runs of the same robot. Distributions (total variation distance, at activations) are compared "
        "over all episodes, before and after that; the test asks whether runs of the two simulators could exchange "
        "their names, given how far runs of one are apart by seed. Survival is a share of the episode's cycles, a mean "
        "over validation episodes of all seeds; policies are moved without further learning."
        + (" The last row is not judged: wheels with physics are another robot."
           if any("planar_on_wheels" in m for m in worlds.values()) else ""), ""]
    return "\n".join(lines)

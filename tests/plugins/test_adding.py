"""What it takes to add a figure, a measure, an engine: one file each, and nothing else changes."""

import hashlib

FIGURE = '''
"""A figure."""
from attnlab.api import Figure, register
from attnlab.figures.curves import one_curve


@register("figure", "way")
class Way(Figure):
    """Length of the path along training."""
    title = "the length of the way"

    def draw(self, conditions):
        return one_curve(conditions, "Way", "path_m", 1, "m")

    def say(self, conditions):
        return "Somebody went somewhere."
'''
MEASURE = '''
"""A measure."""
from attnlab.api import Measure, register


@register("measure", "way")
class Way(Measure):
    """Length of the path, mean over training episodes."""
    unit = "m"

    def of(self, runs):
        return self.mean_of(runs, "path_m", "train")
'''
ENGINE = '''
"""An engine."""
from attnlab.api import Cluster, register
from attnlab.robot.folder import run_to_folder
from attnlab.tables.files import read_json


@register("cluster", "backwards")
class Backwards(Cluster):
    """The last run first."""

    def run(self, jobs, display):
        for job in reversed(jobs):
            run_to_folder(dict(job.config), job.folder, job.info)
            display.advance(job.episodes, 0)
            display.run_done(job, read_json(job.folder / "run.json"))
'''
CLAIMS = """
title: Ways
roles: {treatment: {where: {curiosity: none}}}
rules: {least_seeds: 3}
claims:
  W1: {title: It goes, where: here, says: somewhere, parts: [
    {measure: way, test: level, direction: higher, reference: 0, unit: m}]}
"""


def digests(study):
    return {f"{file.parent.name}/{file.name}": hashlib.sha256(file.read_bytes()).hexdigest()
            for file in study.glob("*/*.parquet")}


def test_one_file_each(place):
    place.plugin("way_figure", FIGURE)
    place.plugin("way_measure", MEASURE)
    place.plugin("backwards", ENGINE)
    (place.path / "ways.yaml").write_text(CLAIMS)
    done = place.attnlab("curiosity=none", "seed=0-2", "study=there", "cluster=backwards", "claims_file=ways.yaml",
                         "report=true")
    assert done.returncode == 0, done.stdout + done.stderr
    page = (place.path / "outputs" / "there" / "report" / "index.html").read_text()
    assert "the length of the way" in page and "Somebody went somewhere." in page and "It goes" in page
    assert place.attnlab("curiosity=none", "seed=0-2", "study=here").returncode == 0
    there, here = (digests(place.path / "outputs" / name) for name in ("there", "here"))
    assert len(there) == 15 and there == here  # an engine is in no key, and changes no byte


def test_a_file_that_was_copied_has_its_own_name(place):
    """Of a world copied under another name, tables and labels use the new one."""
    (place.path / "plugins" / "world").mkdir()
    copied = "defaults: [layout, _self_]\nname: paper\npart: layout\nwidth_m: 6.0\ndepth_m: 6.0\nboxes: " \
             "[{kind: food, x_m: 1, y_m: 1}, {kind: water, x_m: 4, y_m: 4}]\n"
    (place.path / "plugins" / "world" / "mine.yaml").write_text(copied)
    done = place.attnlab("curiosity=none", "world=mine,paper")
    assert done.returncode == 0, done.stdout + done.stderr
    assert set(place.runs()) == {"mine", "paper"}
    config = place.python("-c", "from attnlab.api import compose; print(compose('world=mine')['world']['name'])")
    assert config.stdout == "mine\n", config.stderr

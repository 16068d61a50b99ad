"""Bad input: one line that names the setting, exit 2, nothing written."""

from __future__ import annotations

import pytest

CASES = [
    (["curiosity=litmann"], "curiosity=litmann", "Did you mean 'litman'"),
    (["behaviours=[avoid,eatt]"], "behaviours=eatt", "Did you mean 'eat'"),
    (["+behaviours.avoid.gian=1"], "behaviours.avoid.gian", "Did you mean 'gain_rad_s'"),
    (["behaviours.avoid.gian=1"], "behaviours.avoid.gian", "Did you mean 'gain_rad_s'"),
    (["seed=-1"], "seed", "at least 0"),
    (["seed=5-2"], "seed", "write seed=2-5"),
    (["seed=a"], "seed", "whole number"),
    (["seed=1.5"], "seed", "whole number"),
    (["seed=1,1"], "seed", "twice"),
    (["train_episodes=0"], "train_episodes", "at least 1"),
    (["train_episodes=1.5"], "train_episodes", "whole number"),
    (["train_episodes=1e9"], "train_episodes", "GB"),
    (["validation_episodes=-1"], "validation_episodes", "at least 0"),
    (["outputs=/proc/x"], "outputs", "cannot be written"),
    (["study=../elsewhere"], "study", "folder"),
    (["curiosty=none"], "curiosty", "Did you mean 'curiosity'"),
    (["+foo=1"], "foo", "no such setting"),
    (["learner.tau=3"], "learner.tau", "no such setting"),
    (["learner.lam=0.5"], "learner.lam", "It is one of learner=q_lambda"),
    (["behaviours=[avoid,eat],[avoid,drink]", "+behaviours=rest"], "behaviours", "Write all names into the list"),
    (["behaviours=avoid,eat"], "behaviours=avoid,eat", "behaviours=[avoid,eat]; robots of one"),
    (["alpha=0.5"], "alpha", "learner.alpha"),
    (["validation.simulatr=planar"], "validation.simulatr", "Did you mean 'simulator'"),
    (["needs=energy_only"], "behaviours.eat", "nobody brings a need called 'hunger'"),
    (["study=a,b"], "study", "cannot be swept"),
    (["need_k=3"], "need_k", "Did you mean 'reading.need_k'"),
    (["reading.penalised=nobody"], "reading.penalised=nobody", "no penalty is called"),
    (["+experiment=cr_vs_ncrr"], "experiment=cr_vs_ncrr", "Did you mean 'cr_vs_ncr'"),
    (["reading=table5"], "reading=table5", "Did you mean 'table4'"),
    (["reading.crash=contac"], "reading.crash", "Did you mean 'contact'"),
    (["reading.dt_s=abc"], "reading.dt_s", "a number"),
    (["reading.dt_s=nan"], "reading.dt_s", "a finite number"),
    (["reading.need_start=2000"], "reading.need_start", "below need_max"),
    (["periods=[1,1]"], "periods", "different"),
    (["world.boxes=[{kind:obstacle,x_m:9,y_m:1}]"], "world=paper", "outside"),
    (["world.boxes=[{kind:obstacle,x_m:2,y_m:1},{kind:food,x_m:2.2,y_m:1}]"], "world=paper", "overlaps boxes[0]"),
    (["world.boxes=[{kind:obstacle,x_m:2,y_m:2}]", "world.start.x_min_m=2", "world.start.x_max_m=2",
      "world.start.y_min_m=2", "world.start.y_max_m=2"], "world=paper", "no free start"),
    (["world=random", "world.obstacles=60"], "world=random", "no solvable layout"),
    (["learner=fixed", "learner.period=3"], "learner.period", "not one of the periods"),
    (["learner.alpah=0.5"], "learner.alpah", "Did you mean 'alpha'"),
    (["-m", "learner.alpha=0.1,2"], "learner.alpha", "at most 1"),
    (["-m", "curiosity=litman,litmann"], "curiosity=litmann", "Did you mean 'litman'"),
    (["validation.simulator=plana"], "validation.simulator=plana", "Did you mean 'planar'"),
    (["simulator.gui=maybe"], "simulator.gui", "true or false"),
    (["cluster.jobs=0"], "cluster.jobs", "at least 1"),
    (["behaviours=[]"], "behaviours", "there are none"),
    (["claims_file=nobody"], "claims_file=nobody", "no claims file"),
    (["a=b=c"], "a=b=c", "cannot be read"),
    (["--multirum"], "--multirum", "Did you mean '--multirun'"),
    (["-m", "curiosity=interval(0,1)"], "curiosity", "List them"),
]


@pytest.mark.parametrize(("arguments", "names", "says"), CASES, ids=[" ".join(c[0])[:60] for c in CASES])
def test_one_clear_line(complain, arguments, names, says):
    code, err, written = complain(*arguments)
    lines = [line for line in err.strip().splitlines() if "did not load" not in line]
    assert code == 2
    assert len(lines) == 1, err
    assert lines[0].startswith(f"attnlab: {names}"), lines[0]
    assert says.lower() in lines[0].lower()
    assert "Traceback" not in err
    assert written == []


def test_the_whole_sweep_is_checked_before_its_first_run(complain):
    """The last of the jobs is the bad one."""
    code, err, written = complain("-m", "+experiment=smoke", "reading.novelty_window=10,20,0")
    assert code == 2
    assert "reading.novelty_window" in err
    assert written == []

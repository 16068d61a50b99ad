"""Bad input: one line that names the setting, exit 2, nothing written."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

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
    (["record=all", "train_episodes=100000", "max_cycles=10000"], "record", "GB"),
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
    (["learner=tempo_rl", "learner.observe=all"], "learner", "Only a log can give them"),
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
    *(([f"{group}=null"], f"{group}=null", "expected a name") for group in (
        "simulator", "reading", "behaviours", "cluster", "experiment", "world", "curiosity", "probe")),
    *(([f"{group}=1"], f"{group}=1", "expected a name") for group in (
        "simulator", "reading", "behaviours", "cluster", "experiment", "world", "curiosity")),
    (["curiosity=true"], "curiosity=true", "expected a name"),
    (["curiosity=${seed}"], "curiosity=${seed}", "expected a name"),
    (["curiosity="], "curiosity=", "no curiosity is called ''"),
    (["curiosity={}"], "curiosity", "{} sets nothing"),
    (["learner=[sarsa,q_learning]"], "learner", "learner=sarsa,q_learning"),
    (["learner={alpah:0.5}"], "learner.alpah", "Did you mean 'alpha'"),
    (["learner.name=x"], "learner.name", "learner=NAME"),
    (["variants=5"], "variants", "expected {name: {setting: value}}"),
    (["variants={a: {learnr.alpha: 1}}"], "learnr.alpha", "Did you mean 'learner.alpha'"),
    (["variants={a: {curiosity: nobody}}"], "curiosity=nobody", "no curiosity is called"),
    (["+behaviours=avoid"], "behaviours", "has 'avoid' already, so that +behaviours=avoid adds nothing"),
    (["experiment=multiverse", "variants.siez=3"], "variants.siez", "Did you mean 'size'"),
    (["experiment=cr_vs_ncr,smoke"], "experiment", "a study of its own"),
    (["seed=range(0,5,0)"], "seed", "is empty"),
    (["train_episodes=range(0,0)"], "train_episodes", "names no value"),
    (["train_episodes=range(0,5,0)"], "train_episodes", "names no value"),
    (["curiosity=glob(x*)"], "curiosity", "names no value"),
    (["=glob(*)"], "=glob(*)", "names no setting"),
    (["=5"], "=5", "names no setting"),
    (["seed"], "seed", "cannot be read"),
    (["ключ=5"], "ключ=5", "cannot be read"),
    (["curiosity@x=none"], "curiosity@x=none", "packages are not used"),
    (["hydra.sweeper._target_=x"], "hydra.sweeper._target_=x", "is not used here"),
    (["hydra/sweeper=optuna"], "hydra/sweeper=optuna", "no hydra/sweeper is called 'optuna'"),
    (["hydra/launcher=joblib"], "hydra/launcher=joblib", "cluster=local"),
    (["hydra.launcher.n_jobs=2"], "hydra.launcher.n_jobs=2", "cluster=local"),
    (["+hydra.callbacks.x._target_=os.getcwd"], "+hydra.callbacks.x._target_=os.getcwd", "callback="),
    (["hydra.run.dir=/tmp/x"], "hydra.run.dir=/tmp/x", "outputs="),
    (["+learner._target_=x"], "learner._target_", "no class is named"),
    (["world.boxes=[{_target_: os.system}]"], "world.boxes", "no class is named"),
    (["seed=1", "seed=2"], "seed", "is typed twice"),
    (["learner.alpha=0.1", "+learner.alpha=0.2"], "learner.alpha", "is typed twice"),
    (["experiment=smoke", "+experiment=cr_vs_ncr"], "experiment", "is typed twice"),
    (["+behaviours=rest", "+behaviours=rest"], "behaviours", "is typed twice"),
    (["behaviours=[avoid,eat,avoid]"], "behaviours", "names avoid twice"),
    (["behaviours.rest.threshold=1"], "behaviours.rest", "+behaviours=rest"),
    (["behaviours.avoyd.weights=1"], "behaviours.avoyd.weights", "Did you mean 'avoid'"),
    (["seed=9223372036854775808"], "seed", "at most 9223372036854775807"),
    (["outputs="], "outputs", "cannot be a folder"),
    (["outputs=null"], "outputs", "expected a word"),
    (["study="], "study", "cannot be the name"),
    (["study=null"], "study", "expected a word"),
    (["study=' '"], "study", "cannot be the name"),
    (["study=a\tb"], "study", "cannot be the name"),
    (["study='a\x1b[31m'"], "study", "cannot be the name"),
    (["study=" + "a" * 300], "study", "300 bytes"),
    (["labels={litman:null}"], "labels.litman", "expected a word"),
    (["labels={litman:CR,none:CR}"], "labels", "must differ"),
    (["~curiosity"], "curiosity", "cannot be left out"),
    (["~seed"], "seed", "cannot be left out"),
    (["learnr.alpha=0.1"], "learnr.alpha", "Did you mean 'learner.alpha'"),
    (["penalty=all"], "penalty", "reading.penalised"),
    (["measure=survival"], "measure", "A claims file names measures"),
    (["claims=dinocera2014"], "claims", "claims_file="),
    (["curiosity/x=none"], "curiosity/x", "no such group"),
    (["--cfg", "jobs"], "--cfg", "One of: job, hydra, all"),
    (["-p"], "-p", "says nothing"),
    (["-cn", "smoke"], "-cn", "no such flag"),
    (["--train_episodes=10"], "--train_episodes=10", "without dashes: train_episodes=10"),
    (["report", "outputs/mine"], "report", "python -m attnlab.report"),
    (["behaviours=[avoid,sleep]"], "behaviours=sleep", "no behaviour is called 'sleep'"),
    (["--help=3"], "--help=3", "takes no value"),
    (["--resolve"], "--resolve", "--cfg job --resolve"),
    (["--cfg", "job", "--info", "all"], "--info", "cannot go with --cfg"),
    (["hydra.verbose=null"], "hydra.verbose=null", "sets nothing"),
    (["hydra/job_logging=null"], "hydra/job_logging=null", "sets nothing"),
    (["learner.alpha=range(0,inf)"], "learner.alpha", "more than 100,000 values"),
    (["learner.alpha=range(0,1e9)"], "learner.alpha", "more than 100,000 values"),
    (["learner.alpha=range(0,1,1e-9)"], "learner.alpha", "more than 100,000 values"),
    (["variants={a:{outputs:elsewhere}}"], "variants.a.outputs", "is one for all runs"),
    (["variants={a:{cluster.jobs:2}}"], "variants.a.cluster.jobs", "is one for all runs"),
    (["variants={a:{experiment:smoke}}"], "variants.a.experiment", "is one for all runs"),
    (["cluster.jobs=1,2"], "cluster.jobs", "cannot be swept"),
    (["behaviours=[avoid,rest]", "+behaviours=rest"], "behaviours", "names rest twice"),
    (["world.boxes=" + "x" * 300], "world.boxes", "xxx..."),
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


CLAIMS = {"no YAML": ("claims: [", "is no readable YAML"),
          "no claims": ("title: nothing", "there are none"),
          "a role of no setting": ("roles: {treatment: {where: {curiosty: x}}}\n"
                                   "claims: {C1: {title: t, where: w, says: s, parts: []}}",
                                   "where.curiosty: no such setting. Did you mean 'curiosity'")}


@pytest.mark.parametrize(("text", "says"), CLAIMS.values(), ids=CLAIMS)
def test_claims_that_cannot_be_read_stop_it_before_the_first_run(complain, tmp_path, text, says):
    (tmp_path / "own.yaml").write_text(text)
    code, err, written = complain(f"claims_file={tmp_path / 'own.yaml'}", "simulator=planar")
    assert code == 2 and says in err and err.startswith("attnlab: own.yaml")
    assert written == ["own.yaml"]


FRAGMENTS = ("curiosity", "learner", "behaviours", "seed", "reading", "study", "outputs", "variants", "labels", "hydra",
             "world", "null", "none", "litman", "avoid", "alpha", "dt_s", "experiment", "smoke", "_target_", "1", "-1",
             "0-3", "1e9", "=", "=", "=", ".", ",", "[", "]", "{", "}", ":", "+", "~", "@", "/", "$", "(", ")", "'",
             '"', " ", "\n", "\0", "range(0,3)", "glob(*)", "choice(", "é", "-m", "--cfg", "../x")


@settings(max_examples=60, deadline=None, derandomize=True,
          suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.lists(st.sampled_from(FRAGMENTS), min_size=1, max_size=6).map("".join), min_size=1, max_size=3))
def test_whatever_is_typed(complain, monkeypatch, arguments):
    """A study that may run, or one line: never a traceback, and never a file."""
    monkeypatch.setattr("attnlab.launch.drive.drive", lambda jobs, typed: 0)
    code, err, written = complain(*arguments)
    assert code in (0, 2) and "Traceback" not in err, arguments
    assert written == [] and (code == 0 or len(err.strip().splitlines()) == 1), (arguments, err)

"""``attnlab.new`` in every group: what it writes works, passes its own tests, and is never written over."""

from __future__ import annotations

from attnlab.new import groups


def test_every_group_starts_with_a_part_that_passes_its_tests(attnlab, tmp_path):
    assert groups() == ["behaviours", "curiosity", "exploration", "figure", "fusion", "learner", "measure", "needs",
                        "penalty", "simulator", "world"]
    for group in groups():
        done = attnlab(group, f"my_{group}", module="attnlab.new")
        assert done.returncode == 0, done.stderr
        assert (tmp_path / "plugins" / f"my_{group}.py").is_file()
    tested = attnlab("-q", "-p", "no:cacheprovider", "tests", module="pytest")
    assert tested.returncode == 0, tested.stdout
    again = attnlab("fusion", "my_fusion", module="attnlab.new")
    assert again.returncode == 2 and "exists already" in again.stderr

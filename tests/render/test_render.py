"""A film shows the episode that was recorded."""

import numpy as np
import pytest
from PIL import Image

from attnlab.console import guarded
from attnlab.render.__main__ import main
from attnlab.render.film import INSET, SIDE, WIDTH, YELLOW
from attnlab.render.scene import Scene
from attnlab.robot.folder import run_to_folder
from attnlab.simulators.bullet_bodies import draw_beams
from attnlab.testing import config
from attnlab.testing.build import layout


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    path = tmp_path_factory.mktemp("run")
    chosen = config(train_episodes=1, validation_episodes=1, max_cycles=120, record="last", seed=4)
    assert run_to_folder(chosen, path, {"run": "run", "key": "k", "overrides": [], "swept": {}})
    return path


def test_a_gif_of_the_robot(run, tmp_path, capsys):
    assert main([str(run), "--out", str(tmp_path / "film.gif"), "--cycles", "60", "--every", "5"]) == 0
    assert capsys.readouterr().out.strip() == str(tmp_path / "film.gif")
    shown = []
    with Image.open(tmp_path / "film.gif") as film:
        assert film.n_frames == 12 and film.size[0] == WIDTH + SIDE
        for i in range(film.n_frames):
            film.seek(i)
            shown.append(np.asarray(film.convert("RGB")).astype(int))
    first, last = shown[0], shown[-1]
    assert (np.abs(first - last).sum(axis=2) > 60).sum() > 500  # it moves
    beams = (np.abs(first[:, :WIDTH] - YELLOW).sum(axis=2) < 60).sum()
    assert beams > 50  # in the first cycle everybody looks
    assert sorted(p.name for p in tmp_path.iterdir()) == ["film.gif"]


def test_the_view_from_outside_is_where_the_robot_is(run):
    """The red robot is drawn where its pose is, and moves with it; its own view has the blue source ahead."""
    with Scene(layout(), 320, 240) as scene:
        for x, y in ((1.0, 1.0), (3.0, 2.0)):
            red = scene.outside((x, y, 0.0)).astype(int)
            where = np.argwhere((red[:, :, 0] > 90) & (red[:, :, 1] < 60) & (red[:, :, 2] < 60)).mean(axis=0)
            assert np.abs(where[::-1] - scene.pixel(x, y, 0.12)).max() < 6
        assert scene.inside((2.5, 3.0, 0.0), *INSET, 1.05).reshape(-1, 3).mean(axis=0).argmax() == 2


def test_an_mp4(run, tmp_path):
    pytest.importorskip("imageio_ffmpeg")
    import imageio_ffmpeg
    assert main([str(run), "--out", str(tmp_path / "film.mp4"), "--cycles", "40"]) == 0
    assert imageio_ffmpeg.count_frames_and_secs(str(tmp_path / "film.mp4"))[0] == 10


@pytest.mark.parametrize(("arguments", "said"), [
    (["--out", "film.avi"], "neither .gif nor .mp4"), (["--every", "0"], "--every: is 0"),
    (["--from", "500"], "the episode has cycles 0 to 119"), (["--episode", "3"], "there is no validation episode 3")])
def test_bad_input_is_one_line(run, tmp_path, capsys, monkeypatch, arguments, said):
    monkeypatch.chdir(tmp_path)
    assert guarded(main, [str(run), *arguments]) == 2
    err = capsys.readouterr().err
    assert said in err and err.count("\n") == 1 and not list(tmp_path.iterdir())


def test_the_window_has_a_line_for_each_beam_that_was_read():
    """Bullet's window needs a display; what is asked of it does not."""
    class Window:
        calls: list = []

        def addUserDebugLine(self, start, end, colour, **more):
            self.calls.append((start, end, more))
            return len(self.calls)
    window = Window()
    lines = draw_beams(window, 0, 7, [1.0] * 8, [])
    assert lines == list(range(1, 9)) and window.calls[0][1][1] == pytest.approx(1.136)  # straight to the left
    assert draw_beams(window, 0, 7, [2.0] * 16, lines)[8:] == list(range(17, 25))
    assert window.calls[8][2]["replaceItemUniqueId"] == 1 and "replaceItemUniqueId" not in window.calls[16][2]

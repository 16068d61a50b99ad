"""The same three scans in every format are the same stream; the real logs are what their page says."""

import gzip
import sys
from itertools import pairwise
from math import isclose, pi
from pathlib import Path

import pytest

from attnlab.errors import ConfigError
from attnlab.logs.base import LogSettings
from attnlab.logs.file import Log
from attnlab.logs.sonars import cones, nearest_ahead, ring
from tests.logs import made

REAL = next((data for up in Path(__file__).resolve().parents if (data := up / "shared" / "data").is_dir()), None)


def written(tmp_path, name, data):
    path = tmp_path / name
    path.write_bytes(data)
    return path


@pytest.fixture(params=["csv", "csv.gz", "carmen", "rawlog", "rawlog7", "mcap"])
def log(request, tmp_path):
    kind = request.param
    if kind == "mcap":
        return Log(made.mcap_scans(tmp_path / "log.mcap"))
    data = {"csv": made.csv(), "csv.gz": gzip.compress(made.csv()), "carmen": made.carmen(), "rawlog": made.rawlog(),
            "rawlog7": made.rawlog(version=7, pose=3, spaces=b"mrpt")}[kind]
    return Log(written(tmp_path, f"log.{kind}", data), LogSettings(range_max_m=5.0))


def test_every_format_gives_the_same_stream(log):
    """9 m is beyond the 5 m that the sensor hears. Twice: a log can be read again."""
    for _ in range(2):
        scans = list(log)
        assert [round(scan.time_s, 6) for scan in scans] == [0.0, 0.25, 0.5]
        assert [scan.ranges_m for scan in scans] == [pytest.approx(r) for r in
                                                     [(1.0, 2.0, 0.5), (1.5, 4.9, 0.7), (1.25, 5.0, 0.25)]]
        for scan, pose in zip(scans, made.POSES, strict=True):
            assert scan.pose == pytest.approx(pose)
            assert scan.beams.range_max_m == 5.0
            assert scan.beams.bearings_rad == pytest.approx((-pi / 2, 0.0, pi / 2))
        assert log.ledger.skipped == {}


def test_a_carmen_log_of_180_beams_stands_in_the_middles_of_degrees(tmp_path):
    [scan] = Log(written(tmp_path, "a", f"FLASER 180 {'2 ' * 180}0 0 0 0 0 0 1.0 host 1.0".encode()))
    assert scan.beams.bearings_rad[0] == pytest.approx(-89.5 * pi / 180)
    assert scan.beams.bearings_rad[-1] == pytest.approx(89.5 * pi / 180)
    assert scan.beams.range_max_m == 80.0


def test_a_carmen_laser_says_its_bearings(tmp_path):
    line = "ROBOTLASER1 0 -1.5 3.0 1.5 30.0 0.01 0 3 1 2 31 0 9 9 9 1 2 0.5 0 0 0 0 0 7.5 host 7.5"
    [scan] = Log(written(tmp_path, "a", line.encode()))
    assert scan.beams.bearings_rad == (-1.5, 0.0, 1.5) and scan.ranges_m == (1.0, 2.0, 30.0)
    assert (scan.time_s, scan.pose) == (7.5, (1.0, 2.0, 0.5))
    [scan] = Log(written(tmp_path, "a", b"RAWLASER1 0 -1.5 3.0 1.5 30.0 0.01 0 3 1 2 31 1 77 7.5 host 7.5"))
    assert scan.pose is None and scan.ranges_m == (1.0, 2.0, 30.0)


def test_a_bare_csv_is_what_its_settings_say(tmp_path):
    path = written(tmp_path, "a.csv", b"1,2,3,4,Move\n2,3,4,5,Turn\n")
    log = Log(path)
    first, second = log
    assert first.ranges_m == (1.0, 2.0, 3.0, 4.0) and second.time_s == pytest.approx(1 / 9)
    assert first.beams.bearings_rad == pytest.approx((0.0, -pi / 2, -pi, -3 * pi / 2))
    assert "4 ranges, the first at 0 degrees, the next -90 degrees" in log.ledger.lines()[0]
    first, second = Log(path, LogSettings(rate_hz=2.0, first_deg=-90.0, step_deg=60.0, range_max_m=3.5))
    assert second.time_s == 0.5 and first.ranges_m == (1.0, 2.0, 3.0, 3.5)
    assert first.beams.bearings_rad == pytest.approx((-pi / 2, -pi / 6, pi / 6, pi / 2))


def test_single_ranges_of_ros_become_a_ring(tmp_path):
    """Eight topics of a sonar each: a scan a round. sonar_10 comes after sonar_9; one unheard is no number."""
    names = [f"/sonar_{i}" for i in range(3, 11)]
    messages = [(name, "sensor_msgs/msg/Range", "cdr", made.sonar(t, 1.0 + i))
                for t in (1.0, 2.0, 3.0) for i, name in enumerate(names)
                if (t, i) != (1.0, 1)]
    first, second, _ = Log(made.mcap(tmp_path / "a.mcap", messages))
    assert second.ranges_m == (1.0, 2.0, 3.0, 4.0, 5.0, 5.0, 5.0, 5.0) and (first.time_s, second.time_s) == (1.0, 2.0)
    assert str(first.ranges_m[1]) == "nan" and first.ranges_m[2] == 3.0
    assert first.beams.bearings_rad[0] == pytest.approx(pi / 2) and first.beams.range_min_m == pytest.approx(0.1)
    with pytest.raises(ConfigError, match="2 topics of single ranges"):
        list(Log(made.mcap(tmp_path / "b.mcap", [message for message in messages if message[0] in names[:2]])))


def test_foxglove_and_topics(tmp_path):
    kind = "foxglove.LaserScan"
    path = made.mcap(tmp_path / "a.mcap", [("/back", kind, "json", made.foxglove(1.0, [1.0, None, 3.0])),
                                           ("/front", kind, "json", made.foxglove(1.0, [2.0, 2.0, 2.0])),
                                           ("/other", kind, "protobuf", b"\0")])
    [scan] = Log(path)
    assert scan.ranges_m[0] == 1.0 and scan.ranges_m[1] != scan.ranges_m[1]  # the first topic; null is no number
    [scan] = Log(path, LogSettings(topic="/front"))
    assert scan.ranges_m == (2.0, 2.0, 2.0)
    with pytest.raises(ConfigError, match="no laser scans under '/fornt'. Known: /back, /front, /other"):
        list(Log(path, LogSettings(topic="/fornt")))
    other = Log(path, LogSettings(topic="/other"))
    assert list(other) == [] and other.ledger.skipped == {"message of /other in protobuf, which is not read": 1}


def test_a_file_without_the_package_mcap_says_what_to_install(tmp_path, monkeypatch):
    path = made.mcap_scans(tmp_path / "log.mcap")
    for name in [name for name in sys.modules if name.partition(".")[0] == "mcap"]:
        monkeypatch.setitem(sys.modules, name, None)
    monkeypatch.setitem(sys.modules, "mcap", None)
    with pytest.raises(ConfigError, match=r"pip install 'attnlab\[logs\]'"):
        list(Log(path))


def test_sonars_hear_the_nearest_beam_of_their_cone():
    """On a ring of 24 the sonar at 10 degrees hears 15, that at 50 hears 45; a laser's has 15 beams to hear."""
    ring24 = cones(tuple(-i * pi / 12 for i in range(24)))
    assert [beams[0] for beams in ring24[:8]] == [18, 21, 22, 23, 1, 2, 3, 6] and all(len(b) == 1 for b in ring24)
    half = cones(tuple((i - 90) * pi / 180 for i in range(181)))
    assert half[3] == tuple(range(93, 108)) and half[8] == half[7] and half[9] == ()  # 130 degrees: unheard


def test_a_ring_and_the_nearest_ahead(tmp_path):
    [first, second, third] = Log(written(tmp_path, "a.csv", made.csv()))
    assert ring(first, 3.0)[:8] == [0.5, 3.0, 3.0, 2.0, 2.0, 3.0, 3.0, 1.0] and ring(second, 3.0)[3] == 3.0
    assert nearest_ahead(third) == nearest_ahead(third, sonars=False) == 0.25


@pytest.mark.skipif(REAL is None, reason="the logs of real robots are not here")
def test_real_logs():
    """Their README's figures: 5,456 x 24 and 71 onsets below 0.6 m; 225 x 361; 4,791 scans in 1,062 s."""
    scitos = list(Log(REAL / "scitos-g5-24-ultrasound.csv.gz"))
    near = [nearest_ahead(scan) for scan in scitos]
    assert len(scitos) == 5456 and sum(b < 0.6 <= a for a, b in pairwise(near)) == 71
    sena = Log(REAL / "sena-2006.rawlog")
    scans = list(sena)
    assert (len(scans), len(scans[0].ranges_m), sena.ledger.skipped) == (225, 361, {})
    assert scans[-1].pose is not None and isclose((scans[-1].time_s - scans[0].time_s), 59.1, abs_tol=0.1)
    freiburg = Log(REAL / "freiburg-079.carmen.log.gz")
    scans = list(freiburg)
    assert len(scans) == 4791 and list(freiburg.ledger.skipped) == ["hole of more than 1 s"]

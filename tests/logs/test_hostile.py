"""What a log may do to its reader: a clear line, or a skip that is counted and named; never a wrong number."""

import gzip
import tracemalloc
from math import isnan

import pytest

from attnlab.errors import ConfigError
from attnlab.logs.__main__ import main
from attnlab.logs.base import LogSettings
from attnlab.logs.file import Log
from tests.logs import made

HEAD = "t_s,r-90,r0,r90\n"


def csv(*rows):
    return (HEAD + "\n".join(rows) + "\n").encode()


def flaser(*ranges, t=1.0):
    return f"FLASER {len(ranges)} {' '.join(map(str, ranges))} 0 0 0 0 0 0 {t} host {t}\n"


def raw(*objects):
    return made.named(b"CSensoryFrame", 2) + b"".join(objects)


GOOD, LATER = made.scan_object(1.0, (1, 2, 3)), made.scan_object(2.0, (1, 2, 3))

# what is in the file, scans that come of it, and the reason that is counted (or noted), with the first place
TABLE = {
    "time goes back": (csv("2,1,1,1", "1,1,1,1", "3,1,1,1"), 2, "1 x scan whose time does not rise (first: line 3)"),
    "time stands": (csv("1,1,1,1", "1,1,1,1"), 1, "1 x scan whose time does not rise (first: line 3)"),
    "time is no number": (csv("nan,1,1,1", "1,1,1,1"), 1, "1 x scan without a time (first: line 2)"),
    "time is infinite": (csv("inf,1,1,1", "1,1,1,1"), 1, "1 x scan without a time (first: line 2)"),
    "a hole": (csv("1,1,1,1", "2.5,1,1,1"), 2, "1 x hole of more than 1 s (first: line 3)"),
    "NaN beam": (csv("1,nan,1,1", "2,1,1,1"), 2, "1 x beam without a valid range (first: line 2)"),
    "empty cell": (csv("1,,1,1"), 1, "1 x beam without a valid range (first: line 2)"),
    "negative beam": (csv("1,-1,1,1"), 1, "1 x beam without a valid range (first: line 2)"),
    "zero beam": (csv("1,0,1,1"), 1, "1 x beam without a valid range (first: line 2)"),
    "all beams broken": (csv("1,nan,-1,0", "2,1,1,1"), 1, "1 x scan without a valid beam (first: line 2)"),
    "half a line": (csv("1,1,1,1", "2,1,1"), 1, "1 x row of another number of columns (first: line 3)"),
    "words in a row": (csv("1,1,one,1", "2,1,1,1"), 1, "1 x row that is no numbers (first: line 2)"),
    "no text": (csv("1,1,1,1") + b"2,1,\xff\xfe,1\n3,1,1,1\n", 2, "1 x line that is no text (first: line 3)"),
    "a long line": (csv("1,1,1,1") + b"2," * 800_000 + b"\n3,1,1,1\n", 2, "1 x line of more than 1 MB (first: line 3)"),
    "other beams in a bare CSV": (b"1,2,3\n1,2\n1,2,3\n", 2, "1 x scan of another number of beams (first: line 2)"),
    "numbers after words": (b"1,2,3\n1,x,3\n", 1, "1 x row that is no numbers (first: line 2)"),
    "a pose that is none": (b"t_s,x_m,y_m,heading_rad,r0\n1,0,nan,0,1\n2,0,0,0,1\n", 1,
                            "1 x scan without a finite pose (first: line 2)"),
    "half a carmen line": ((flaser(1, 2, 3) + flaser(1, 2, 3, t=2)[:20] + "\n").encode(), 1,
                           "1 x FLASER line that is broken (first: line 2)"),
    "a carmen count that lies": ((flaser(1, 2, 3) + "FLASER 99999999999 1 2 3\nFLASER -1 2\nFLASER x\nFLASER").encode(),
                                 1, "4 x FLASER line that is broken (first: line 2)"),
    "other beams in carmen": ((flaser(1, 2, 3) + flaser(1, 2, t=2)).encode(), 1,
                              "1 x scan of another number of beams (first: line 2)"),
    "an unknown message": (("PARAM a b\nBOGUS 1 2\n" + flaser(1, 2, 3)).encode(), 1,
                           "1 x line of an unknown message (first: line 2)"),
    "a rawlog cut off": (raw(GOOD, LATER[:60]), 1, f"1 x object that is broken or cut off (first: byte "
                         f"{len(raw(GOOD))})"),
    "a rawlog count that lies": (raw(GOOD.replace(b"\3\0\0\0", b"\xff\xff\xff\x7f", 1), LATER), 1,
                                 f"1 x object that is broken or cut off (first: byte {len(raw())})"),
    "an old scan object": (raw(GOOD[:24] + b"\2" + GOOD[25:], LATER), 1,
                           f"1 x laser scan of version 2, which is not read (first: byte {len(raw())})"),
    "a new pose object": (raw(made.scan_object(1.0, (1, 2, 3), pose=9), LATER), 1,
                          f"1 x sensor pose of version 9, which is not read (first: byte {len(raw())})"),
    "a broken beam in a rawlog": (raw(made.scan_object(1.0, (1, 2, 3), valid=[1, 0, 1])), 1,
                                  f"1 x beam without a valid range (first: byte {len(raw())})"),
    "gzip cut off": (gzip.compress(csv(*(f"{i},1,2,3" for i in range(30000))))[:40000], None,
                     "1 x gzip file that is cut off or damaged: what came before it was read"),
    "ranges that are no metres": (csv("1,1500,900,inf", "2,1500,900,nan"), 2,
                                  "no beam ever heard anything within 5 m: are its ranges metres?"),
    "an infinite beam": (csv("1,inf,-inf,7", "2,1,1,1"), 2, "1 x beam without a valid range (first: line 2)"),
    "an editor's mark": (b"\xef\xbb\xbf" + csv("1,1,1,nan"), 1, "1 x beam without a valid range (first: line 2)"),
    "a name that lies": (csv("1,1,1,1"), 1, "named as rawlog, it holds csv"),
}


@pytest.mark.parametrize("what", TABLE)
def test_counted_and_named(what, tmp_path):
    data, count, line = TABLE[what]
    path = tmp_path / ("a.rawlog" if what == "a name that lies" else "log")
    path.write_bytes(data)
    log = Log(path)
    scans = list(log)
    assert count is None or len(scans) == count
    assert any(line in found for found in log.ledger.lines()), log.ledger.lines()
    for scan in scans:
        assert all(isnan(r) or 0.0 < r <= scan.beams.range_max_m for r in scan.ranges_m)
    assert [scan.time_s for scan in scans] == sorted({scan.time_s for scan in scans})


@pytest.mark.parametrize(("data", "problem"), [
    (b"", "log is of no format known here. Known: csv, carmen, rawlog, mcap"),
    (b"\0" * 5000, "is of no format known here"), (b"\x89PNG\r\n\x1a\n" + b"\0" * 99, "is of no format known here"),
    (b"hello world\n", "is of no format known here"), (b"a,b\n1,2\n", "neither ranges nor a header"),
    (b"x_m,r0\n1,2\n", "no column t_s"), (b"t_s,r0,r0\n1,2,3\n", "names a column twice"),
    (gzip.compress(b"hello", mtime=0), "is of no format known here"),  # 0: the same test in every process
    (b"\x1f\x8bno gzip at all", "of no format known here")])
def test_no_log_at_all(data, problem, tmp_path):
    (tmp_path / "log").write_bytes(data)
    with pytest.raises(ConfigError, match=problem.replace("(", r"\(")):
        list(Log(tmp_path / "log"))


def test_a_damaged_mcap(tmp_path):
    whole = made.mcap_scans(tmp_path / "a.mcap", made.SCANS).read_bytes()
    for cut in (300, 40):
        (tmp_path / "b.mcap").write_bytes(whole[:cut])
        log = Log(tmp_path / "b.mcap")
        assert len(list(log)) < 3
        assert "file that ends early or is damaged" in log.ledger.skipped
    bad = made.mcap(tmp_path / "c.mcap", [("/scan", "sensor_msgs/msg/LaserScan", "cdr", data) for data in
                                          (made.laser(1.0, (1, 2, 3))[:30], made.laser(2.0, (1, 2, 3)),
                                           made.laser(3.0, (1, 2)))])
    log = Log(bad)
    assert [scan.time_s for scan in log] == [2.0]
    assert log.ledger.skipped == {"message of /scan that is broken": 1, "scan of another number of beams": 1}


def test_a_format_that_was_forced(tmp_path):
    (tmp_path / "log").write_bytes(made.carmen())
    with pytest.raises(ConfigError, match="log is no mcap file. It looks like carmen"):
        Log(tmp_path / "log", kind="mcap")
    with pytest.raises(ConfigError, match="Did you mean 'carmen'"):
        Log(tmp_path / "log", kind="carmne")
    with pytest.raises(ConfigError, match="there is no file"):
        Log(tmp_path / "none")


@pytest.mark.parametrize("rows", [3000, 30000])
def test_memory_is_flat(tmp_path, rows):
    """Reading costs the same few MB, however long the log: all formats read through one window."""
    path = tmp_path / "log.csv"
    with path.open("w") as file:
        file.write(HEAD)
        file.writelines(f"{i},{1 + i % 3},2,{'3' * 50}\n" for i in range(rows))
    tracemalloc.start()
    count = sum(1 for _ in Log(path))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert count == rows and peak < 2_000_000


def test_memory_is_flat_for_objects_and_lines_that_never_end(tmp_path):
    objects, line = tmp_path / "log.rawlog", tmp_path / "line.csv"
    with objects.open("wb") as file:
        file.write(made.named(b"CSensoryFrame", 2))
        for i in range(40):
            file.write(made.scan_object(float(i + 1), (1.0,) * 361) + b"\0" * 250_000)
    line.write_bytes(csv("1,1,1,1") + b"9" * 12_000_000)
    tracemalloc.start()
    found = [sum(1 for _ in Log(path)) for path in (objects, line)]
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert found == [40, 1] and peak < 8_000_000


def test_the_command(tmp_path, capsys):
    (tmp_path / "log.csv").write_bytes(csv("1,1,1,1", "2,nan,1,1"))
    assert main([str(tmp_path / "log.csv"), "--set", "hole_s=0.5"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "log.csv: csv, 2 scans", "3 beams from -90 to 90 degrees, up to 5 m; 1.0 s, 1.00 scans a second; no poses",
        "1 x beam without a valid range (first: line 3)", "1 x hole of more than 0.5 s (first: line 3)"]
    with pytest.raises(ConfigError, match="hole: no such setting. Did you mean 'hole_s'"):
        main([str(tmp_path / "log.csv"), "--set", "hole=1"])
    with pytest.raises(ConfigError, match="rate_hz: is 0.0 Hz, must be more than 0"):
        main([str(tmp_path / "log.csv"), "--set", "rate_hz=0"])
    assert LogSettings().hole_s == 1.0

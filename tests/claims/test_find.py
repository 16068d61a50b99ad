"""Claims files are found by name or path, and fingerprinted."""

import hashlib
import subprocess
import sys

import pytest

from attnlab.claims import claims_hash, claims_path
from attnlab.errors import ConfigError


def test_shipped_file_by_name():
    path = claims_path("dinocera2014")
    assert path.name == "dinocera2014.yaml"
    assert claims_hash("dinocera2014") == hashlib.sha256(path.read_bytes()).hexdigest()


def test_by_path(tmp_path):
    file = tmp_path / "mine.yaml"
    file.write_text("a: 1\n")
    assert claims_path(str(file)) == file
    before = claims_hash(str(file))
    file.write_text("a: 2\n")
    assert claims_hash(str(file)) != before


def test_in_a_plugins_folder(tmp_path, monkeypatch):
    (tmp_path / "claims").mkdir()
    (tmp_path / "claims" / "own.yaml").write_text("x: 1\n")
    monkeypatch.setenv("ATTNLAB_PLUGINS", str(tmp_path))
    assert claims_path("own") == (tmp_path / "claims" / "own.yaml").resolve()


@pytest.mark.parametrize("name", ["dinocera2015", "no/such.yaml", "nothing.yaml", "", "  "])
def test_unknown_name(name):
    with pytest.raises(ConfigError):
        claims_path(name)


def test_a_typo_gets_a_hint():
    with pytest.raises(ConfigError, match="Did you mean 'dinocera2014'"):
        claims_path("dinocera2015")


def test_nothing_heavy_is_imported():
    code = ("import sys; from attnlab.claims import claims_hash; claims_hash('dinocera2014');"
            "print([m for m in ('pandas', 'scipy', 'matplotlib', 'seaborn', 'pyarrow') if m in sys.modules])")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"

"""What the processes of runs are forked from."""

from __future__ import annotations

import subprocess
import sys


def test_all_that_is_ours_is_there_and_no_plugin(tmp_path):
    (tmp_path / "plugins").mkdir()
    (tmp_path / "plugins" / "mine.py").write_text("raise SystemExit('a plugin was read before its run')\n")
    text = ("import sys, attnlab.launch.preload as p\nfrom attnlab import registry\n"
            "print('pandas' in sys.modules, registry.find('curiosity', 'litman') is not None,\n"
            "      [m for m in sys.modules if m.startswith('attnlab.plugins')])")
    done = subprocess.run([sys.executable, "-c", text], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stdout.split("\n")[0] == "True True []"

"""What was compiled before is found again, and what was not is not."""

from __future__ import annotations

import importlib.util

from attnlab.kernels.compile import compiled, is_kept

SIGNATURE = "int64(int64, boolean)"


def test_compiled_code_is_found_again(tmp_path):
    file = tmp_path / "doubles.py"
    file.write_text("def double(n, sure):\n    return 2 * n if sure else n\n")
    spec = importlib.util.spec_from_file_location("doubles", file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert not is_kept(SIGNATURE, module.double, nogil=True)
    assert compiled(SIGNATURE, nogil=True)(module.double)(4, True) == 8
    assert is_kept(SIGNATURE, module.double, nogil=True)

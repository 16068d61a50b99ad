"""A small study and its report, made once."""

from pathlib import Path

import pytest

from tests.report.small_study import write_study


@pytest.fixture(scope="session")
def study(tmp_path_factory) -> Path:
    """Six seeds, CR and NCR, CR safer by 0.3."""
    return write_study(tmp_path_factory.mktemp("studies") / "small", safety=0.3)


@pytest.fixture(scope="session")
def built(study, tmp_path_factory) -> Path:
    """The report of that study, drawn by one process: the folder with index.html."""
    from attnlab.report.build import build
    return build(study, tmp_path_factory.mktemp("report"), None, None, True, hands=1).parent

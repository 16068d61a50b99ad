"""Scripts of docs/ and benchmarks/, as modules."""

import importlib.util

import pytest

from tests.docs.typed import ROOT


@pytest.fixture(scope="session")
def site_pages():
    spec = importlib.util.spec_from_file_location("site_pages", ROOT / "docs" / "site_pages.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module

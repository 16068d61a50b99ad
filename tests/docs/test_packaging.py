"""What stands around the code agrees with it: version, citation, tested versions, types, the source archive."""

import ast
import re
import tomllib
from importlib import metadata
from pathlib import Path

import yaml
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import attnlab

ROOT = Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text())


def asked_for() -> list[Requirement]:
    """Every requirement that pyproject.toml names, of the package and of its tools."""
    lists = [PROJECT["project"]["dependencies"], *PROJECT["project"]["optional-dependencies"].values()]
    found = [Requirement(text) for each in lists for text in each]
    return [requirement for requirement in found if requirement.name != "attnlab"]


def pinned() -> dict[str, str]:
    """The constraints file: version by name."""
    lines = [line for line in (ROOT / "constraints.txt").read_text().splitlines() if not line.startswith("#")]
    return {canonicalize_name(name): version for name, version in (line.split("==") for line in lines)}


def needs(name: str) -> set[str]:
    """What an installed package requires here; nothing is known of one that is not installed."""
    try:
        required = [Requirement(text) for text in metadata.requires(name) or []]
    except metadata.PackageNotFoundError:
        return set()
    return {canonicalize_name(r.name) for r in required if r.marker is None or r.marker.evaluate({"extra": ""})}


def test_the_version_stands_once():
    assert metadata.version("attnlab") == attnlab.__version__
    assert "version" not in PROJECT["project"]
    assert PROJECT["tool"]["hatch"]["version"]["path"] == "attnlab/__init__.py"


def test_the_citation_agrees():
    assert CITATION["version"] == attnlab.__version__
    assert CITATION["license"] == PROJECT["project"]["license"]
    assert CITATION["title"].partition(":")[0] == PROJECT["project"]["name"]
    assert CITATION["title"].partition(": ")[2].lower() == PROJECT["project"]["description"].partition(":")[0].lower()
    assert [author["name"] for author in CITATION["authors"]] == [a["name"] for a in PROJECT["project"]["authors"]]
    [paper] = CITATION["references"]
    assert PROJECT["project"]["urls"]["Paper"] == f"https://doi.org/{paper['doi']}"


def test_the_changelog_knows_the_version():
    headings = re.findall(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert headings[:2] == ["Unreleased", attnlab.__version__]


def test_what_is_asked_for_was_pinned():
    """Each requirement but the launcher of the checks has a tested version, and its bound lets it in."""
    versions = pinned()
    for requirement in asked_for():
        if requirement.name != "nox":
            assert versions[canonicalize_name(requirement.name)] in requirement.specifier, requirement


def test_what_was_tested_is_asked_for():
    """No version is bound that nothing here needs."""
    reached, rest = set(), {canonicalize_name(requirement.name) for requirement in asked_for()}
    while rest:
        reached |= rest
        rest = set().union(*map(needs, rest)) - reached
    assert set(pinned()) <= reached


def test_every_bound_has_a_reason():
    text = (ROOT / "pyproject.toml").read_text()
    for requirement in asked_for():
        before, line = re.search(rf'^(.*)\n( +"{re.escape(requirement.name)}[<>=].*)$', text, re.MULTILINE).groups()
        assert "  # " in line or before.strip().startswith("#"), line


def test_groups_point_to_extras():
    extras = PROJECT["project"]["optional-dependencies"]
    for name, group in PROJECT["dependency-groups"].items():
        assert group[0] == f"attnlab[{name}]" and name in extras


def test_the_package_is_typed():
    assert (Path(attnlab.__file__).parent / "py.typed").is_file()
    assert PROJECT["tool"]["mypy"]["strict"] is True


def test_the_source_archive_has_what_tests_read():
    """Every file or folder of the checkout that a test names is in the archive."""
    include = PROJECT["tool"]["hatch"]["build"]["targets"]["sdist"]["include"]
    shipped = {name.strip("/").split("/")[0] for name in include}
    read = {"tests", "conf", "plugins", "attnlab"}
    for path in (ROOT / "tests").rglob("*.py"):
        read |= {node.right.value.split("/")[0] for node in ast.walk(ast.parse(path.read_text())) if _in_root(node)}
    assert {"docs", "CITATION.cff"} <= read, "the search finds what this file reads"
    markdown = {name for name in read if name.endswith(".md") and "*.md" in shipped}
    assert read - markdown - {"pyproject.toml"} <= shipped


def _in_root(node: ast.AST) -> bool:
    """Whether it is ``ROOT / "name"``."""
    return (isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div) and isinstance(node.right, ast.Constant)
            and isinstance(node.left, ast.Name) and node.left.id == "ROOT")

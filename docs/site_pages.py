"""What the site has beside the pages in docs/: the map from paper to code and the reference of all parts, both made
from the code whenever the site is (``mkdocs build --strict``), and the notebooks as they were executed."""

from __future__ import annotations

import ast
import base64
import inspect
import json
import re
from pathlib import Path
from typing import Any

from attnlab import equations, registry
from attnlab.groups import GROUPS
from attnlab.loading import load_all
from attnlab.paths import PACKAGE
from attnlab.reading import Reading

DOCS = Path(__file__).parent
REPOSITORY = PACKAGE.parent
PLAIN = re.compile(r":[a-z]+:`~?([^`]*)`")  # a reference in a docstring

SCIENCE = """# The science, and where it is in the code

Made from the code.

Attention is a *sampling rate*. Each behaviour of the robot owns a clock (eq 1); only when it fires does the behaviour
read its sensors, decide, and send a motor command. Learning (eqs 2, 3) chooses the next period of each clock from 1, 4,
8 and 12 machine cycles, with a table a behaviour; what the robot *does* is a side effect. Curiosity is wanting
(residual energy, eq 11) and liking (novelty of the percept, eq 12); it enters the reward (eq 4) and the state. CR is
the curious robot, NCR the same without curiosity. One machine cycle is `attnlab/cycle.py`, the whole model on a screen.

Di Nocera, Finzi, Rossi, Staffa (2014): The role of intrinsic motivations in attention allocation and shifting.
Frontiers in Psychology 5:273, [doi.org/10.3389/fpsyg.2014.00273](https://doi.org/10.3389/fpsyg.2014.00273).

## From the paper to the code

`attnlab/equations.py` has every numbered equation as one function, and nothing else.

| equation | function | what it says | called in |
|---|---|---|---|
"""
OPEN = """
## What the paper leaves open

Each sentence that can be read in two ways is a setting, `reading.NAME=VALUE`; `reading=table4` sets them to the paper's
Table 4. The [results](results/README.md) say which claims hang on which.

| setting | default | unit | |
|---|---|---|---|
"""
PARTS = """# Parts

Made from the registry. A run is composed of one part of each group (of some, several); a
part of one's own is one file ([authors](authors.md)). `python -m attnlab.parts NAME` tells the same of plugins, too.
"""


def callers() -> dict[str, list[str]]:
    """Function of equations.py -> the files that import it."""
    found: dict[str, list[str]] = {}
    for file in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.ImportFrom) and node.module == "attnlab.equations":
                for name in node.names:
                    found.setdefault(name.name, []).append(str(file.relative_to(REPOSITORY)))
    for file in sorted(PACKAGE.rglob("*.py")):  # equations.wanting(...)
        for name in re.findall(r"\bequations\.([a-z_]+)\(", file.read_text()):
            found.setdefault(name, []).append(str(file.relative_to(REPOSITORY)))
    return {name: sorted(set(files)) for name, files in found.items()}


def cell(text: object) -> str:
    """As a cell of a Markdown table."""
    return " ".join(PLAIN.sub(r"`\1`", str(text)).replace("``", "`").replace("|", "\\|").split())


def science() -> str:
    used, rows = callers(), []
    functions = [f for _, f in inspect.getmembers(equations, inspect.isfunction) if f.__module__ == equations.__name__]
    for function in sorted(functions, key=lambda f: f.__code__.co_firstlineno):
        text = (inspect.getdoc(function) or "").split("\n\n")[0]
        number = re.match(r"(?:First half of )?((?:\(\d+\)(?:, |-)?)+)", text)
        numbers = number[1].strip(", ") if number else "State space"
        places = ", ".join(f"`{file}`" for file in used.get(function.__name__, []))
        rows.append(f"| {numbers} | `{function.__name__}` | {cell(text)} | {places} |")
    settings = [f"| `{name}` | {cell(field.default)} | {field.metadata['unit']} | {cell(field.metadata['doc'])} |"
                for name, field in Reading.__dataclass_fields__.items()]
    return SCIENCE + "\n".join(rows) + "\n" + OPEN + "\n".join(settings) + "\n"


def parts() -> str:
    load_all()
    text = [PARTS]
    for group in GROUPS.values():
        specs = sorted((spec for spec in registry.parts.values() if spec.group == group.name
                        and Path(spec.origin).is_relative_to(PACKAGE)), key=lambda spec: spec.name)
        if not specs:
            continue
        text.append(f"\n## {group.name}\n\n{group.what[:1].upper()}{group.what[1:]}.\n")
        for spec in specs:
            about = cell((inspect.getdoc(spec.cls) or "").split("\n\n")[0])
            file = Path(spec.origin).relative_to(REPOSITORY)
            text.append(f"\n### {group.name}: {spec.name}\n\n{about}\n\n`{file}`\n")
            rows = [f"| `{name}` | {cell(spec.nodes()[spec.name].get(name))} | {field.metadata.get('unit', '')} | "
                    f"{cell(field.metadata.get('doc', ''))} |"
                    for name, field in spec.params.__dataclass_fields__.items()]
            if rows:
                text += ["\n| setting | default | unit | |", "\n|---|---|---|---|\n", "\n".join(rows) + "\n"]
    return "".join(text)


def notebook(file: Path) -> tuple[str, dict[str, bytes]]:
    """A notebook as a page, and its images by name."""
    parts, images = [], dict[str, bytes]()
    for number, cell in enumerate(json.loads(file.read_text())["cells"]):
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            parts.append(source)
            continue
        parts.append(f"````python\n{source}\n````")
        for out in cell["outputs"]:
            data = {kind: "".join(text) for kind, text in out.get("data", {}).items()}
            if "image/png" in data:
                name = f"{file.stem}-{number}.png"
                images[name] = base64.b64decode(data["image/png"])
                parts.append(f"![what the cell above draws]({name})")
            elif "<table" in data.get("text/html", ""):
                table = re.search(r"<table.*?>(.*)</table>", data["text/html"], re.DOTALL)
                parts.append(f"<table>{re.sub(r' style=.*?>', '>', table[1]) if table else ''}</table>")
            else:
                parts.append(f"````text\n{(''.join(out.get('text', '')) or data.get('text/plain', '')).rstrip()}\n````")
    return "\n\n".join(parts) + "\n", images


PAGES = {"science.md": science, "parts.md": parts}
LINK = re.compile(r"\[([^\]\[]*)\]\(([^)#\s]+)\)")


def on_files(files: Any, config: Any) -> Any:
    """MkDocs asks which pages there are."""
    from mkdocs.structure.files import File
    for name, page in PAGES.items():
        files.append(File.generated(config, name, content=page()))
    for book in sorted((DOCS / "notebooks").glob("*.ipynb")):
        text, images = notebook(book)
        for name, content in ((f"{book.stem}.md", text), *images.items()):
            files.append(File.generated(config, f"notebooks/{name}", content=content))
    return files


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """A link to a file that is in the repository and not on the site becomes its name."""
    here = (DOCS / page.file.src_uri).parent

    def only_here(link: re.Match[str]) -> str:
        target = (here / link[2]).resolve()
        inside = target.is_file() and target.is_relative_to(DOCS) and target.suffix in (".md", ".png", ".gif")
        return link[0] if "://" in link[2] or inside or not target.exists() else link[1]
    return LINK.sub(only_here, markdown)

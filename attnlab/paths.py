"""Where the shipped configuration is: beside the package in a checkout, inside it in a wheel."""

from __future__ import annotations

from pathlib import Path

PACKAGE = Path(__file__).resolve().parent


def conf_dir() -> Path:
    """The folder of config groups."""
    shipped = PACKAGE / "_conf"
    return shipped if shipped.is_dir() else PACKAGE.parent / "conf"


def plugins_dir() -> Path:
    """The folder of the plugins that are shipped as examples."""
    shipped = PACKAGE / "_plugins"
    return shipped if shipped.is_dir() else PACKAGE.parent / "plugins"


def certificate_file() -> Path | None:
    """The certificate of the two simulators, as JSON; None where it was taken away."""
    shipped = PACKAGE / "_certificate.json"
    file = shipped if shipped.is_file() else PACKAGE.parent / "docs" / "certificate.json"
    return file if file.is_file() else None

"""What the paper shows in each figure: data that stands beside its claims."""

from __future__ import annotations

from pathlib import Path

from attnlab.errors import ConfigError, nearest
from attnlab.loading import config_folders, load_all
from attnlab.paths import conf_dir
from attnlab.registry import parts


def captions_path(claims: Path) -> Path | None:
    """Where the captions of a claims file are; None if there are none.

    By name, as claims are: in conf/captions, in captions/ of a plugins folder and of a package's conf. Of a claims file
    that was given by its path: ``<stem>.captions.yaml`` beside it.
    """
    load_all()
    homes = [conf_dir(), *config_folders()]
    by_name = any(claims.resolve().parent == (home / "claims").resolve() for home in homes)
    places = [home / "captions" / f"{claims.stem}.yaml" for home in homes] if by_name else \
        [claims.with_name(f"{claims.stem}.captions.yaml")]
    return next((place for place in places if place.is_file()), None)


def load_captions(claims: Path) -> dict[str, str]:
    """Name of a figure -> what the paper shows there, for a claims file. Raises ConfigError for a figure that nobody
    registered, or a caption that is no text."""
    import yaml
    path = captions_path(claims)
    if path is None:
        return {}
    try:
        content = yaml.safe_load(path.read_bytes().decode()) or {}
    except (yaml.YAMLError, UnicodeDecodeError) as cause:
        raise ConfigError(path.name, f"is no readable YAML: {cause}") from None
    if not isinstance(content, dict):
        raise ConfigError(path.name, "names no figures", "Write a line a figure: survival: what the paper shows")
    known = [name for group, name in parts if group == "figure"]
    for name, caption in content.items():
        if name not in known:
            raise ConfigError(f"{path.name}: {name}", "no figure is called that", nearest(str(name), known))
        if not isinstance(caption, str):
            raise ConfigError(f"{path.name}: {name}", f"expected a text, got {caption!r}")
    return content

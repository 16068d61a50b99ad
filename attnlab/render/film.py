"""Frames of an episode, and the file they go to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from attnlab.errors import ConfigError
from attnlab.render.scene import Image, Scene
from attnlab.worlds.base import Layout

WIDTH, HEIGHT, SIDE = 456, 360, 184  # px: the view from outside, and what is told beside it
INSET = (168, 126)  # px: the robot's own view
YELLOW, DARK, SOFT, WHITE = (230, 159, 0), (22, 27, 34), (139, 148, 158), (255, 255, 255)
BARS = ((0, 158, 115), (0, 114, 178), (204, 121, 167), (213, 94, 0))


def frames(track: Mapping[str, Any], layout: Layout, fov_rad: float, every: int) -> Iterator[Any]:
    """Pictures (PIL) of every so many cycles. What was read in a cycle since the picture before is shown: the sonar's
    beams in yellow, the camera's view with a frame of the same colour; a name is lit when that behaviour looked."""
    from PIL import Image as Pictures
    from PIL import ImageDraw
    poses = [tuple(track["start"]), *zip(track["x"], track["y"], track["h"], strict=True)]
    with Scene(layout, WIDTH, HEIGHT) as scene:
        trail = [scene.pixel(x, y, 0.0) for x, y, _ in poses]
        for cycle in range(0, track["n"], every):
            pose, since = poses[cycle], range(max(0, cycle - every + 1), cycle + 1)
            picture = Pictures.new("RGB", (WIDTH + SIDE, HEIGHT), DARK)
            picture.paste(Pictures.fromarray(scene.outside(pose)), (0, 0))
            draw = ImageDraw.Draw(picture)
            if cycle:
                draw.line(trail[max(0, cycle - 400):cycle + 1], fill=(130, 80, 223), width=2)
            heard = next((c for c in reversed(since) if c in track["fans"]), None)
            if heard is not None:
                for one, two in scene.beams(poses[heard], track["fans"][heard]):
                    draw.line([one, two], fill=YELLOW, width=2)
            looked = any(c in track["blobs"] for c in since)
            _inset(picture, draw, scene.inside(pose, *INSET, fov_rad), looked)
            _tell(draw, track, cycle, since)
            yield picture


def _inset(picture: Any, draw: Any, view: Image, looked: bool) -> None:
    from PIL import Image as Pictures
    left, top = WIDTH + 8, 8
    picture.paste(Pictures.fromarray(view if looked else view // 2 + 30), (left, top))
    draw.rectangle([left - 2, top - 2, left + INSET[0] + 1, top + INSET[1] + 1], outline=YELLOW if looked else SOFT,
                   width=3 if looked else 1)


def _tell(draw: Any, track: Mapping[str, Any], cycle: int, since: range) -> None:
    """Clocks, then needs and energy."""
    left, y = WIDTH + 8, INSET[1] + 18
    draw.text((left, y), f"{track['label']}, seed {track['seed']}", fill=WHITE)
    draw.text((left, y + 15), f"cycle {cycle} of {track['most']}", fill=SOFT)
    y += 38
    for name, looks in track["looks"].items():
        last = [look for look in looks if look[0] <= cycle]
        now = any(look[0] in since for look in last[-len(since):])
        draw.ellipse([left, y + 2, left + 9, y + 11], fill=YELLOW if now else (60, 66, 74))
        draw.text((left + 16, y), f"{name} every {last[-1][3]}" if last else name, fill=WHITE if now else SOFT)
        y += 16
    bars = [(need["name"], need["v"], need["deadly"] or max(need["v"])) for need in track["needs"]]
    bars.append(("energy", track["energy"], max(track["full"], *track["energy"])))
    for i, (name, values, most) in enumerate(bars):
        y, share = y + 16, max(0.0, min(1.0, values[cycle] / most))
        draw.text((left, y), name, fill=SOFT)
        draw.rectangle([left + 50, y + 3, left + 168, y + 10], fill=(45, 51, 59))
        draw.rectangle([left + 50, y + 3, left + 50 + int(118 * share), y + 10], fill=BARS[i % len(BARS)])


def write_gif(pictures: Sequence[Any], path: Path, ms: int) -> None:
    """A looping GIF, ``ms`` a picture; one palette for all, so that it stays small."""
    palette = pictures[len(pictures) // 2].quantize(96)
    small = [picture.quantize(palette=palette, dither=0) for picture in pictures]
    small[0].save(path, format="GIF", save_all=True, append_images=small[1:], duration=ms, loop=0, optimize=True)


def write_mp4(pictures: Iterator[Any], path: Path, fps: float) -> None:
    """H.264 in MP4, by imageio-ffmpeg."""
    try:
        import imageio_ffmpeg
    except ImportError:
        raise ConfigError("--out", "mp4 needs imageio-ffmpeg", "pip install 'attnlab[video]', or --out film.gif"
                          ) from None
    import numpy as np
    writer = imageio_ffmpeg.write_frames(str(path), (WIDTH + SIDE, HEIGHT), fps=fps, quality=7, macro_block_size=8)
    writer.send(None)
    try:
        for picture in pictures:
            writer.send(np.ascontiguousarray(picture))
    finally:
        writer.close()

"""A movie of the plate as a file: APNG or GIF by Pillow, MP4 by ffmpeg.

Brightness grows with displacement, so that it reads without colour, and with the root of its size, so that waves show beside the
focus. The frame at T stays for a second.
"""

import contextlib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import matplotlib as mpl
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from controller.errors import ConfigError
from controller.programs import how_it_ended, last_line
from controller.workshop.physics.pictures.movie import Frames, Movie

KINDS = {".png": "PNG", ".apng": "PNG", ".gif": "GIF", ".mp4": "MP4"}
ENCODED_S = 600.0  # that ffmpeg may need after the last picture
RATE_HZ = 20  # frames a second
HELD = 20  # times that the frame at T is shown
LEVELS = 253  # colours; the middle one is at rest
BLACK, WHITE = 254, 255
CAPTION_PIXELS = 30
Point = tuple[float, float]


def check_movie(path: Path) -> None:
    """Refuse a movie that could not be written, before the work for it is done.

    Raises ConfigError if its folder does not exist or is not writable, its suffix is none of `KINDS`, or there is no ffmpeg for it.
    """
    if path.suffix not in KINDS:
        raise ConfigError(f"{path}: a movie is {', '.join(KINDS)}, by the ending of its name")
    if path.is_dir() or not path.parent.is_dir() or not os.access(path if path.exists() else path.parent, os.W_OK):
        raise ConfigError(f"{path}: the movie cannot be written there")
    if KINDS[path.suffix] == "MP4" and shutil.which("ffmpeg") is None:
        raise ConfigError(f"{path}: there is no program ffmpeg to write it: install it, or take .png (APNG) or .gif")


def write_movie(
    path: Path,  # `check_movie` has seen it. Not touched unless the whole movie is written
    movie: Movie,
    frames: Iterator[Frames],  # in m
    foci: Sequence[Point],  # each (x_m, y_m): circles of `radius_m` are drawn around them
    largest_m: float,  # displacement of the brightest colour; the darkest is its negative
    radius_m: float,
    progress: Callable[[int, int], None],  # called with the number of frames done and of all
) -> None:
    """Write the frames of a movie; raises ConfigError if the file cannot be written."""
    part = path.with_name(f".{path.name}.part")
    pictures = _pictures(movie, frames, foci, largest_m, radius_m, progress)
    held = np.where(movie.time_s == 0, HELD, 1)
    try:
        if KINDS[path.suffix] == "MP4":
            _encode(part, pictures, held.tolist())
        else:
            first, *others = pictures
            duration_ms = (held * (1000 / RATE_HZ)).tolist()
            first.save(part, KINDS[path.suffix], save_all=True, append_images=others, duration=duration_ms, loop=0, optimize=False)
        part.replace(path)
    except (OSError, ValueError) as error:
        raise ConfigError(f"{path}: the movie cannot be written ({error})") from error
    finally:
        part.unlink(missing_ok=True)


def _pictures(
    movie: Movie,
    frames: Iterator[Frames],
    foci: Sequence[Point],
    largest_m: float,
    radius_m: float,
    progress: Callable[[int, int], None],
) -> Iterator[Image.Image]:
    palette = (mpl.colormaps["viridis"](np.linspace(0, 1, LEVELS))[:, :3] * 255).round().astype(np.uint8).ravel().tolist()
    colours = [*palette, *[0] * (3 * (WHITE - LEVELS)), 255, 255, 255]
    step_m = movie.x_m[1] - movie.x_m[0], movie.y_m[1] - movie.y_m[0]
    shown, scale = 0, f"bright +{largest_m * 1e6:.2g} um, dark -{largest_m * 1e6:.2g} um, root scale"
    for block in frames:
        for u in block:
            picture = Image.new("P", (movie.x_m.size, movie.y_m.size + CAPTION_PIXELS), WHITE)
            picture.putpalette(colours)
            picture.paste(Image.fromarray(_levels(u[::-1], largest_m)), (0, CAPTION_PIXELS))  # y upwards
            drawn = ImageDraw.Draw(picture)
            for x_m, y_m in foci:
                at = x_m / step_m[0], CAPTION_PIXELS + movie.y_m.size - y_m / step_m[1]
                size = radius_m / step_m[0], radius_m / step_m[1]
                drawn.ellipse((at[0] - size[0], at[1] - size[1], at[0] + size[0], at[1] + size[1]), outline=BLACK)
            drawn.text((4, 1), f"{movie.time_s[shown] * 1e3:+.3f} ms from T", fill=BLACK)
            drawn.text((4, 15), scale, fill=BLACK)
            shown += 1
            progress(shown, len(movie.bits))
            yield picture


def _levels(u: Frames, largest_m: float) -> NDArray[np.uint8]:
    """Colour of each point: root of the share of `largest_m`, with its sign."""
    share = np.clip(u / largest_m, -1, 1)
    middle = (LEVELS - 1) / 2
    levels: NDArray[np.uint8] = (middle + 0.5 + middle * np.copysign(np.sqrt(np.abs(share)), share)).astype(np.uint8)
    return levels


def _encode(part: Path, pictures: Iterator[Image.Image], held: Sequence[int]) -> None:
    """Give all frames to ffmpeg; raises ConfigError with the last line that it said."""
    first = next(pictures)
    size = f"{first.width}x{first.height}"
    read = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", size, "-r", str(RATE_HZ), "-i", "-"]
    write = ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-f", "mp4", str(part)]
    with tempfile.TemporaryFile() as err:
        run = subprocess.Popen(["ffmpeg", "-y", "-loglevel", "error", *read, *write], stdin=subprocess.PIPE, stderr=err)
        assert run.stdin is not None
        try:
            with contextlib.suppress(BrokenPipeError), run.stdin:  # it says why
                for picture, times in zip(_from(first, pictures), held, strict=True):
                    run.stdin.write(picture.convert("RGB").tobytes() * times)
            code = run.wait(ENCODED_S)
        except subprocess.TimeoutExpired:
            raise ConfigError(f"{part}: ffmpeg did not end within {ENCODED_S:g} s of the last picture") from None
        finally:
            run.kill()
            run.wait()
        err.seek(0)
        if code:
            raise ConfigError(f"{part}: {how_it_ended('ffmpeg', code, last_line(err.read().decode(errors='replace')))}")


def _from(first: Image.Image, others: Iterator[Image.Image]) -> Iterator[Image.Image]:
    yield first
    yield from others

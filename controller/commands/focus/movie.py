"""`haptic-panel focus --movie`: the plate over time, as a file."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from controller.commands.common.output import progress_bar
from controller.errors import ConfigError

if TYPE_CHECKING:
    from controller.workshop.benchmark.focus.focus_emission import FocusEmission


def add_movie(command: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    movie = command.add_argument_group("movie")
    movie.add_argument("--movie", metavar="FILE", help="show the plate over time: .png (APNG), .gif, or .mp4 if there is ffmpeg")
    movie.add_argument(
        "--movie-from-ms", type=float, metavar="MS", help="first frame, from T (default: -0.3 in a band as the paper's)"
    )
    movie.add_argument("--movie-to-ms", type=float, metavar="MS", help="last frame, from T (default: 0.3)")
    movie.add_argument(
        "--movie-step-us", type=float, metavar="US", help="from frame to frame, in whole bits (default: for 151 frames)"
    )
    movie.add_argument("--movie-frames", type=int, metavar="N", help="at most this many frames, instead of a step")


def movie_path(options: argparse.Namespace) -> Path | None:
    """File given with --movie; checked before any work.

    Raises ConfigError if it could not be written, or both step and number of frames are given.
    """
    if options.movie is None:
        return None
    if not options.at:
        raise ConfigError("--movie shows foci: give --at X_MM Y_MM too")
    if options.movie_step_us is not None and options.movie_frames is not None:
        raise ConfigError("--movie-step-us and --movie-frames: give one of them")
    from controller.workshop.physics.pictures.movie_file import check_movie

    check_movie(Path(options.movie))
    return Path(options.movie)


def film(options: argparse.Namespace, path: Path, emission: FocusEmission, points_m: Sequence[tuple[float, float]]) -> None:
    """Write the movie of an emission."""
    from controller.workshop.physics.pictures.movie import Movie
    from controller.workshop.physics.pictures.movie_file import write_movie

    twin = emission.twin
    from_s, to_s = (None if at_ms is None else at_ms * 1e-3 for at_ms in (options.movie_from_ms, options.movie_to_ms))
    step_s = None if options.movie_step_us is None else options.movie_step_us * 1e-6
    movie = Movie.of(twin, from_s, to_s, step_s, options.movie_frames)
    frames = movie.frames(twin, emission.words, options.memory_mb)
    largest_m = float(abs(emission.field.at(points_m)).max()) or 1e-6  # nothing moves
    write_movie(path, movie, frames, points_m, largest_m, twin.scale.circle_m, progress_bar("movie"))

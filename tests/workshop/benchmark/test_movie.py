"""Movies of the plate: frames against other ways to them, files that are whole or not there, limits, and their time."""

import json
import os
import time

import numpy as np
import pytest
from PIL import Image
from tables import each_row

from controller.cli import main
from controller.errors import ConfigError
from controller.workshop.benchmark.focus.focus_emission import emission_at
from controller.workshop.physics.pictures.movie import MOST_FRAMES, Movie, PixelGrid, modal_frames
from controller.workshop.physics.pictures.movie_file import HELD, check_movie, write_movie
from controller.workshop.physics.responses.modal_history import modal_history
from controller.workshop.physics.word_capture import volts_above_idle

POINT = (0.052, 0.031)


@pytest.fixture(scope="module")
def emission(small_board):
    return emission_at(small_board, [POINT])


def unseen(done, total):
    """Progress that nobody looks at."""


def played_volts(emission, bits):
    board = emission.twin.board
    words = np.append(emission.words, np.full(max(0, bits - len(emission.words)), board.idle_word, np.uint32))[:bits]
    return volts_above_idle(board, words)


@pytest.mark.parametrize(("every", "first"), [(1, 240), (10, 0), (7, 100), (300, 0), (257, 0)])
def test_blocks_of_bits_give_what_bit_by_bit_gives(emission, monkeypatch, every, first):
    """257 is prime, and longer than a block of 250 bits: it goes bit by bit."""
    twin = emission.twin
    monkeypatch.setattr(f"{modal_frames.__module__}.STATES_AT_ONCE", 250 * twin.step.poles.size)
    volts = played_volts(emission, 530)
    period_s = twin.board.waveform.bit_period_s
    stepped = np.concatenate([motion.displacement for motion in modal_history(twin.step, twin.forces, volts, period_s)])
    wanted = stepped[first:][(len(stepped) - 1 - first) % every :: every]
    found = np.concatenate(list(modal_frames(twin.step, twin.forces, volts, period_s, every, first)))
    assert found.shape == wanted.shape
    error = abs(found - wanted).max() / abs(stepped).max()
    print(f"largest difference {error:.1e} of the largest displacement of a mode, by sums of blocks in float32")
    assert error <= 1e-5


def test_the_frame_at_t_is_the_field_at_t(emission):
    movie = Movie.of(emission.twin, step_s=20e-6)
    frames = np.concatenate(list(movie.frames(emission.twin, emission.words)))
    assert frames.shape == (len(movie.time_s), movie.y_m.size, movie.x_m.size)
    at_t = frames[np.flatnonzero(movie.time_s == 0)[0]]
    u = emission.field.modes.on_grid(emission.field.modal, movie.x_m, movie.y_m)
    error = abs(at_t - u).max() / abs(u).max()
    print(f"largest difference at T {error:.1e} of the amplitude, of sums in float32")
    assert error < 1e-5
    assert abs(1.01 * at_t - u).max() > 1e-3 * abs(u).max()
    assert abs(at_t).max() == abs(frames).max(), "nowhere at any time is more than the focus at T"


def test_modes_without_factors_give_the_same_frames(emission):
    class Whole:
        """Modes whose shapes are no products."""

        factors = None
        on_grid = staticmethod(emission.twin.modes.on_grid)

    movie = Movie.of(emission.twin, -20e-6, 20e-6, step_s=4e-6)
    amplitudes = np.concatenate(list(movie.amplitudes(emission.twin, emission.words)))
    by_factors = PixelGrid.of(emission.twin.modes, movie.x_m, movie.y_m).sum(amplitudes)
    summed = PixelGrid.of(Whole(), movie.x_m, movie.y_m).sum(amplitudes)
    assert abs(summed - by_factors).max() <= 1e-5 * abs(summed).max()


def test_frames_are_evenly_spaced_and_have_t_among_them(emission):
    waveform = emission.twin.board.waveform
    whole = Movie.of(emission.twin, -1.0, 0.5e-3)
    assert whole.bits[0] >= 0
    assert len(whole.time_s) <= 151
    assert len(set(np.diff(whole.bits))) == 1
    assert 0 in whole.time_s
    assert whole.time_s == pytest.approx((whole.bits + 1) * waveform.bit_period_s - waveform.duration_s)
    assert len(Movie.of(emission.twin, frames=10).time_s) <= 10


@each_row(
    "window",
    [
        {"from_s": 1e-4},
        {"to_s": -1e-4},
        {"to_s": float("nan")},
        {"to_s": 60.0},
        {"frames": 1},
        {"frames": MOST_FRAMES + 1},
        {"step_s": 1e-6},
        {"step_s": float("nan")},
        {"step_s": 2e-6, "to_s": 1.0},
    ],
)
def test_what_is_no_movie_is_refused(emission, window):
    with pytest.raises(ConfigError, match=r"^a (movie|step) .*\d"):
        Movie.of(emission.twin, **window)


def test_a_movie_that_needs_more_memory_than_it_may_is_refused(emission):
    movie = Movie.of(emission.twin)
    with pytest.raises(ConfigError, match="movie of 151 frames of 210 x 148 points takes"):
        next(movie.frames(emission.twin, emission.words, 100.0))


@pytest.mark.parametrize("named", ["movie.apng", "movie.png", "movie.gif"])
def test_a_file_has_all_frames_and_holds_the_one_at_t(emission, tmp_path, named):
    movie = Movie.of(emission.twin, -40e-6, 40e-6, step_s=8e-6)
    calls = []
    frames = movie.frames(emission.twin, emission.words)
    write_movie(tmp_path / named, movie, frames, [POINT], 1e-6, 4e-3, lambda *at: calls.append(at))
    assert [file.name for file in tmp_path.iterdir()] == [named]
    assert calls == [(k + 1, len(movie.bits)) for k in range(len(movie.bits))]
    with Image.open(tmp_path / named) as read:
        assert (read.n_frames, read.size) == (11, (210, 148 + 30))
        durations, brightness = [], []
        for index in range(read.n_frames):
            read.seek(index)
            durations.append(read.info["duration"])
            place = (round(POINT[0] * 2000), 30 + 148 - round(POINT[1] * 2000))
            brightness.append(read.convert("L").getpixel(place))
            rim = [read.convert("L").getpixel((place[0] + 8 + off, place[1])) for off in (-1, 0, 1)]
            assert min(rim) == 0, "a black circle of 4 mm"
    assert durations == [50 * (HELD if at == 0 else 1) for at in movie.time_s]
    assert brightness[5] == max(brightness) > 150, "the focus is the brightest at T"


def test_a_movie_that_cannot_be_written_leaves_the_old_file(emission, tmp_path):
    old = tmp_path / "movie.png"
    old.write_bytes(b"old")
    movie = Movie.of(emission.twin, -40e-6, 40e-6, step_s=8e-6)

    def broken():
        yield from movie.frames(emission.twin, emission.words)
        raise OSError(28, "No space left on device")

    with pytest.raises(ConfigError, match=r"movie\.png: the movie cannot be written .*No space"):
        write_movie(old, movie, broken(), [POINT], 1e-6, 4e-3, unseen)
    assert [(file.name, file.read_bytes()) for file in tmp_path.iterdir()] == [("movie.png", b"old")]


FFMPEG = """#!/bin/sh
for last; do :; done
echo "$@" > "$0.arguments"
cat > "$last"
{ending}
"""


@pytest.mark.parametrize("ending", ["exit 0", "echo 'no such codec' >&2; exit 1"])
def test_ffmpeg_gets_every_frame_and_its_refusal_is_reported(emission, tmp_path, monkeypatch, ending):
    program = tmp_path / "bin" / "ffmpeg"
    program.parent.mkdir()
    program.write_text(FFMPEG.format(ending=ending))
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{program.parent}{os.pathsep}{os.environ['PATH']}")
    movie = Movie.of(emission.twin, -40e-6, 40e-6, step_s=8e-6)
    path = tmp_path / "movie.mp4"
    check_movie(path)
    frames = movie.frames(emission.twin, emission.words)
    if ending == "exit 0":
        write_movie(path, movie, frames, [POINT], 1e-6, 4e-3, unseen)
        assert path.stat().st_size == 3 * 210 * (148 + 30) * (11 - 1 + HELD)
        assert "-s 210x178" in program.with_name("ffmpeg.arguments").read_text()
    else:
        with pytest.raises(ConfigError, match="no such codec"):
            write_movie(path, movie, frames, [POINT], 1e-6, 4e-3, unseen)
        assert not path.exists()


@each_row(
    ("arguments", "said"),
    [
        (("--at", "100", "70", "--movie", "a.avi"), ".png, .apng, .gif, .mp4"),
        (("--at", "100", "70", "--movie", "nowhere/a.png"), "cannot be written there"),
        (("--at", "100", "70", "--movie", "a.mp4"), "no program ffmpeg"),
        (("--movie", "a.png"), "give --at"),
        (("--at", "100", "70", "--movie", "a.png", "--movie-frames", "10", "--movie-step-us", "4"), "give one of them"),
        (("--at", "100", "70", "--period-ms", "1"), "--period-ms 1: from 2 ms"),
    ],
)
def test_the_command_refuses_in_one_line(capsys, tmp_path, monkeypatch, arguments, said):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert main(["focus", *arguments]) == 78
    out, err = capsys.readouterr()
    assert out == ""
    assert said in err
    assert err.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_the_time_of_frames_is_reported_beside_that_of_their_matrix_products(board, capsys, tmp_path):
    """Best of fifteen, in turns, of processor time; the products in float32 alone, of matrices that are ready."""
    emission = emission_at(board, [(0.1, 0.07)])
    for window in ({}, {"from_s": -2e-3, "to_s": 1e-3}, {"from_s": -2e-3, "to_s": 3e-3}):
        movie = Movie.of(emission.twin, **window)
        grid = PixelGrid.of(emission.twin.modes, movie.x_m, movie.y_m)
        amplitudes = np.concatenate(list(movie.amplitudes(emission.twin, emission.words)))
        ready = [grid.by_factors(amplitudes[k : k + grid.at_once]) for k in range(0, len(amplitudes), grid.at_once)]
        times = np.empty((15, 2))
        for turn in times:
            start = time.process_time()
            for matrices in ready:
                rows = matrices.reshape(-1, matrices.shape[2]) @ grid.along_x.T
                _ = grid.along_y @ rows.reshape(len(matrices), -1, movie.x_m.size)
            turn[0] = time.process_time() - start
            start = time.process_time()
            shown = sum(len(block) for block in movie.frames(emission.twin, emission.words))
            turn[1] = time.process_time() - start
        products_s, frames_s = times.min(axis=0)
        with capsys.disabled():
            print(f"\n{len(movie.bits)} frames: {frames_s / products_s:.2f} of their products, {products_s * 1e3:.0f} ms")
        assert shown == len(movie.bits)
    code = main(["focus", "--at", "100", "70", "--movie", str(tmp_path / "focus.apng"), "--json"])
    assert code == 0
    assert json.loads(capsys.readouterr().out)["board"] == "simulated"
    with Image.open(tmp_path / "focus.apng") as read:
        assert read.n_frames == 151

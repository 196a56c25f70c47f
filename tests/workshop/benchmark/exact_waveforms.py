"""Figures of exact composition and of nulls (controller/workshop/bank_builder/methods/README.md).

`python -m tests.workshop.benchmark.exact_waveforms` prints them.
"""

from __future__ import annotations

import argparse
import math
import tempfile
import time
from pathlib import Path

import msgspec
import numpy as np
from threadpoolctl import threadpool_limits

from controller.device.bank.grid import Grid
from controller.device.bank.packing import channel_bits
from controller.device.bank.reader import Bank
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.scene.scene import load_scene
from controller.device.touch.recordings.recording import Recording
from controller.device.waveforms.composition import Composer
from controller.device.waveforms.pad import pad_places
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.methods.device_composition import DeviceComposition
from controller.workshop.bank_builder.methods.dual import farthest
from controller.workshop.bank_builder.methods.exact_composition import ExactComposition, best_bits
from controller.workshop.bank_builder.methods.nulls import ExactNulls, independent
from controller.workshop.bank_builder.methods.plain import SignOfSum
from controller.workshop.bank_builder.methods.prediction import Prediction
from controller.workshop.bank_builder.request import BankRequest, cells_around
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.simulation.simulated_run import Run, play

MARGIN_M = 15e-3
APART_M = 9e-3  # of two foci
NEAR_M, FAR_M = 10e-3, 40e-3  # from a null to the nearest focus
NOISE_DB = 30
PAD_M = 2e-3 * np.array([(x, y) for x in range(-2, 3) for y in range(-2, 3) if x * x + y * y <= 4])  # a pad of 8 mm, every 2 mm
DRIFT = 1e-3  # of all frequencies
LAG_MS, PERIOD_S, NOISE_M = 10.0, 8e-3, 0.02e-3  # of a touch panel
TAPS = 4
AXES = "A: 2f 0 9 0 0 0\nA: 35 0 21000 0 0 0\nA: 36 0 14800 0 0 0\nA: 39 0 65535 0 0 0\n"  # hundredths of a millimetre
SCENE = """
[[regions]]
name = "button"
shape = "circle"
x_mm = {x_mm}
y_mm = {y_mm}
radius_mm = 5.0
{key}
effects = ["click"]

[[regions]]
name = "elsewhere"
shape = "plate"
effects = []
"""


def scene(rng: np.random.Generator, board: Board, foci: int, quiet: int) -> tuple[np.ndarray, np.ndarray]:
    """Random foci, and nulls 10 to 40 mm from one of them and at least 10 mm from all."""
    low, high = np.full(2, MARGIN_M), np.array([board.plate.length_m, board.plate.width_m]) - MARGIN_M
    while True:
        points = rng.uniform(low, high, (foci, 2))
        if foci > 1 and min(np.linalg.norm(points - points[i], axis=1)[np.arange(foci) != i].min() for i in range(foci)) < APART_M:
            continue
        angle, away_m = rng.uniform(0, 2 * np.pi, quiet), rng.uniform(NEAR_M, FAR_M, quiet)
        places = points[rng.integers(foci, size=quiet)] + away_m[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
        on_plate = ((places > low) & (places < high)).all()
        if on_plate and all(np.linalg.norm(points - place, axis=1).min() >= NEAR_M for place in places):
            return points, places


def drifted(board: Board, by: float) -> Board:
    """The board with all frequencies of its plate higher by a share."""
    plate = msgspec.structs.replace(board.plate, young_modulus_pa=board.plate.young_modulus_pa * (1 + by) ** 2)
    return msgspec.structs.replace(board, plate=plate)


def full(points: np.ndarray) -> list[tuple[float, float, float]]:
    return [(x_m, y_m, 1.0) for x_m, y_m in points.tolist()]


def compositions(board: Board, model: ResponseModel, seed: int, scenes: int) -> None:
    """Worst point over the bound and equality, of the plain sum, the device and exact composition; and amplitudes of the last."""
    plain, exact = SignOfSum(board, model), ExactComposition(board, model)
    print(
        "points: worst over the bound: plain, device, exact: median, least; largest difference: device, exact; amplitudes off; ms"
    )
    for foci in (1, 2, 4, 10):
        rng = np.random.default_rng(seed)
        drawn = [scene(rng, board, foci, 0)[0] for _ in range(scenes)]
        times, rows = [], []
        with tempfile.TemporaryDirectory() as folder:
            path, grid = Path(folder) / "bank", Grid.of(board.plate, board.bank.pitch_mm * 1e-3)
            build_bank(BankRequest(board, path, grid.pitch_m, cells_around(grid, np.concatenate(drawn).tolist())))
            with Bank.open(path, board) as bank:
                device = DeviceComposition(board, bank)
                for points in drawn:
                    begun = time.process_time()
                    best = exact.design(full(points))
                    times.append(time.process_time() - begun)
                    in_band = exact.deviations(model.drive_order_responses(points, dtype=np.float64))
                    sizes = np.abs(in_band).sum(axis=1)
                    _, bound = farthest(in_band / sizes[:, None], np.sign(best.displacement_m))
                    said = Prediction(board, model)
                    before, live, size = (
                        np.abs(said.at_focus(some.words, points)) / sizes
                        for some in (plain.design(full(points)), device.design(full(points)), best)
                    )
                    asked = rng.uniform(0.25, 1, foci)
                    less = [(*point, share) for point, share in zip(points.tolist(), asked.tolist(), strict=True)]
                    off = np.abs(np.abs(exact.design(less).displacement_m) / sizes / size / asked - 1).max()
                    rows.append([*(some.min() / bound for some in (before, live, size)), *map(_spread, (live, size)), off])
        found = np.array(rows)
        medians, least, most = np.median(found, axis=0), found.min(axis=0), found.max(axis=0)
        print(
            f"{foci:3}: "
            + "; ".join(f"{medians[i]:.3f} {least[i]:.3f}" for i in range(3))
            + f"; {100 * most[3]:.2f}, {100 * most[4]:.2f} %; {100 * most[5]:.2f} %; {1e3 * np.median(times):.0f}",
            flush=True,
        )


def _spread(shares: np.ndarray) -> float:
    return float(np.ptp(shares) / shares.mean())


def nulls(board: Board, model: ResponseModel, seed: int, scenes: int) -> None:
    """Over pads: what exact nulls leave, below what exact composition leaves and below the focus, and what they cost."""
    exact, null, said = ExactComposition(board, model), ExactNulls(board, model), Prediction(board, model)
    drift = Prediction(drifted(board, DRIFT), ResponseModel(drifted(board, DRIFT)))
    print("foci, nulls: pad below the focus: without, with: median, least; rms better: median, least; loss: median, most;")
    print("rms better at 0.1 % drift; with responses of 30 dB SNR; s")
    for foci, quiet in ((1, 1), (1, 3), (2, 2), (4, 4)):
        rng = np.random.default_rng(seed)
        rows, times = [], []
        for _ in range(scenes):
            points, places = scene(rng, board, foci, quiet)
            alone = exact.design(full(points))
            begun = time.process_time()
            design = null.design(full(points), [(x_m, y_m) for x_m, y_m in places.tolist()])
            times.append(time.process_time() - begun)
            in_band = exact.deviations(model.drive_order_responses(points, dtype=np.float64))
            whole = exact.deviations(model.responses(points)[:, ::-1])
            near = null.near_focus([spot for place in places.tolist() for spot in pad_places(*place)])
            noisy = [_noisy(rng, some, NOISE_DB) for some in (in_band, whole, near)]
            bits = best_bits(noisy[0], noisy[1], np.ones(foci), independent(noisy[2]), 48)
            packed = np.packbits(bits.reshape(-1, 32), axis=1, bitorder="little").view("<u4")[:, 0] ^ np.uint32(board.idle_word)
            rows.append([*_over_pads(said, alone.words, design.words, points, places)])
            rows[-1].append(_over_pads(drift, alone.words, design.words, points, places)[2])
            rows[-1].append(_over_pads(said, alone.words, packed, points, places)[2])
        _print_nulls(f"{foci} {quiet}", np.array(rows), f"{np.median(times):.2f}")


def _over_pads(
    said: Prediction, before: np.ndarray, after: np.ndarray, points: np.ndarray, places: np.ndarray
) -> tuple[float, float, float, float]:
    """Largest |u| on any pad below the worst focus, before and after; how much better the rms of the worst pad is; loss in %."""
    left, kept = ([said.near_focus(words, place + PAD_M) for place in places] for words in (before, after))
    full_m, got_m = (np.abs(said.at_focus(words, points)) for words in (before, after))
    most, least = (max(np.abs(u).max() for u in some) for some in (left, kept))
    rms, rms_kept = (max(float((u**2).mean()) for u in some) ** 0.5 for some in (left, kept))
    return _db(full_m.min() / most), _db(got_m.min() / least), _db(rms / rms_kept), 100 * (1 - (got_m / full_m).min())


def _print_nulls(name: str, rows: np.ndarray, taken: str) -> None:
    mid, least = np.median(rows, axis=0), rows.min(axis=0)
    print(
        f"{name}: {mid[0]:.1f}, {mid[1]:.1f} {least[1]:.1f}; {mid[2]:.1f} {least[2]:.1f}; {mid[3]:.1f} {rows[:, 3].max():.1f} %; "
        + "; ".join(f"{some:.1f}" for some in mid[4:])
        + f"; {taken}",
        flush=True,
    )


def device(board: Board, model: ResponseModel, seed: int, scenes: int) -> None:
    """What `Composer.keep_still` reaches over pads from a bank's responses, and what that costs."""
    said, drift = Prediction(board, model), Prediction(drifted(board, DRIFT), ResponseModel(drifted(board, DRIFT)))
    print("device: foci, nulls, amplitude, quiet finger beside the place in mm: as above; rms better at 0.1 % drift; us")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "bank"
        build_bank(BankRequest(board, path))
        with Bank.open(path, board) as bank:
            composer = Composer(bank, board.idle_word)
            cases = [(*numbers, amplitude, 0.0) for numbers in ((1, 1), (1, 2), (1, 3), (2, 2), (4, 4)) for amplitude in (1.0, 0.5)]
            for foci, quiet, amplitude, beside_mm in cases + [(1, 1, 1.0, beside_mm) for beside_mm in (0.5, 1.0, 2.0)]:
                rng = np.random.default_rng(seed)
                rows, times = [], []
                for _ in range(scenes):
                    points, places = scene(rng, board, foci, quiet)
                    asked = [(x_m, y_m, amplitude) for x_m, y_m in points.tolist()]
                    still = [(x_m, y_m, 1.0) for x_m, y_m in places.tolist()]
                    best_s = math.inf
                    for _ in range(5):
                        before = np.frombuffer(bytes(composer.compose(asked)), "<u4")
                        begun = time.thread_time()
                        composer.keep_still(asked, still)
                        best_s = min(best_s, time.thread_time() - begun)
                    view = composer.compose(asked)
                    composer.keep_still(asked, still)
                    after = np.frombuffer(bytes(view), "<u4")
                    felt = places + np.array([1e-3 * beside_mm, 0.0])
                    rows.append([*_over_pads(said, before, after, points, felt)])
                    rows[-1].append(_over_pads(drift, before, after, points, felt)[2])
                    times.append(1e6 * best_s)
                _print_nulls(f"{foci} {quiet} {amplitude:g} {beside_mm:g}", np.array(rows), f"{np.median(times):.0f}")


def moving(board: Board, model: ResponseModel, seed: int, scenes: int) -> None:
    """What a finger that slides past, 15 to 30 mm away, feels of another one's taps, on a panel that reports late."""
    late_board = msgspec.structs.replace(board, touch=msgspec.structs.replace(board.touch, lag_ms=LAG_MS))
    said = Prediction(board, model)
    print(
        f"moving, panel of {LAG_MS:g} ms lag, {PERIOD_S * 1e3:g} ms period: mm/s: below focus without; depth: median, worst tenth"
    )
    with tempfile.TemporaryDirectory() as folder:
        path, file = Path(folder) / "bank", Path(folder) / "scene.toml"
        build_bank(BankRequest(board, path))
        for speed_m_s in (0.0, 0.05, 0.2):
            found = []
            for number in range(scenes):
                moved = []
                for key in ("", 'nulled = "others"'):
                    rng = np.random.default_rng((seed, number))
                    tap_m = rng.uniform([0.07, 0.04], [0.14, 0.10])
                    from_m = tap_m + np.array([-0.05 * TAPS * speed_m_s, rng.choice([-1, 1]) * rng.uniform(0.015, 0.03)])
                    file.write_text(SCENE.format(x_mm=1e3 * tap_m[0], y_mm=1e3 * tap_m[1], key=key))
                    run = _run(late_board, path, file, tap_m, from_m, speed_m_s, rng)
                    for tick in run.capture.focus_ticks.tolist():
                        place_m = from_m + np.array([speed_m_s * (run.link.time_s(tick) - run.start_s), 0.0])
                        sampled = tick - board.bit_ticks * np.arange(board.waveform.samples, 0, -1)
                        words = run.capture.words[np.searchsorted(run.capture.ticks.astype(np.int64), sampled, side="right") - 1]
                        moved.append((np.abs(said.near_focus(words, place_m)).max(), np.abs(said.at_focus(words, tap_m))[0]))
                plain, quiet = np.array(moved).reshape(2, -1, 2)
                found += [(_db(p[1] / p[0]), _db(p[0] / q[0])) for p, q in zip(plain, quiet, strict=True)]
            rows = np.array(found)
            depth = rows[:, 1]
            print(f"{1e3 * speed_m_s:g}: {np.median(rows[:, 0]):.1f}; {np.median(depth):.1f} {np.quantile(depth, 0.1):.1f}")


def _run(
    board: Board, path: Path, file: Path, tap_m: np.ndarray, from_m: np.ndarray, speed_m_s: float, rng: np.random.Generator
) -> Run:
    """One finger taps, the other one slides from a place along x; it is reported late and with noise."""
    lines = [AXES]
    for number in range(round(0.1 * TAPS / PERIOD_S)):
        at_s = number * PERIOD_S
        events = [] if number else [(3, 0x2F, 0), (3, 0x39, 0)]
        events += _at(0, from_m + np.array([speed_m_s * (at_s - LAG_MS * 1e-3), 0.0]) + rng.normal(0, NOISE_M, 2))
        step = number % round(0.1 / PERIOD_S)
        if step == 6:
            events += [(3, 0x2F, 1), (3, 0x39, 1 + number), *_at(1, tap_m)[1:]]
        elif step == 9:
            events += [(3, 0x2F, 1), (3, 0x39, -1)]
        lines += [f"E: {at_s:.6f} {kind:04x} {code:04x} {value:04d}\n" for kind, code, value in (*events, (0, 0, 0))]
    with Bank.open(path, board) as bank:
        return play(board, load_scene(file, board), bank, Recording("".join(lines)), real_time=False)


def _at(slot: int, place_m: np.ndarray) -> list[tuple[int, int, int]]:
    return [(3, 0x2F, slot), (3, 0x35, round(1e5 * place_m[0])), (3, 0x36, round(1e5 * place_m[1]))]


def _noisy(rng: np.random.Generator, rows: np.ndarray, snr_db: float) -> np.ndarray:
    """Rows with white noise of their own."""
    return rows + rng.normal(size=rows.shape) * np.sqrt((rows**2).mean()) * 10 ** (-snr_db / 20)


def _db(ratio: float) -> float:
    return float(20 * np.log10(ratio))


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--scenes", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", choices=["compositions", "nulls", "device", "moving"], default="")
    options = parser.parse_args()
    board = load_board(find_board("simulated"))
    assert channel_bits(np.array([board.idle_word], np.uint32)).sum() == 16
    model = ResponseModel(board)
    with threadpool_limits(1, "blas"):
        for figures in (compositions, nulls, device, moving):
            if options.only in ("", figures.__name__):
                figures(board, model, options.seed, options.scenes)


if __name__ == "__main__":
    main()

"""Figures of exact composition and of nulls (controller/waveform_design/README.md): `python -m tests.benchmark.exact_waveforms`."""

from __future__ import annotations

import argparse
import time

import msgspec
import numpy as np
from threadpoolctl import threadpool_limits

from controller.bank.packing import channel_bits
from controller.board.board import Board, load_board
from controller.board.lookup import find_board
from controller.physics.impulse_response import ResponseModel
from controller.waveform_design.dual import farthest
from controller.waveform_design.exact_composition import ExactComposition, best_bits
from controller.waveform_design.nulls import ExactNulls, independent
from controller.waveform_design.plain import SignOfSum
from controller.waveform_design.prediction import Prediction

MARGIN_M = 15e-3
APART_M = 9e-3  # of two foci
NEAR_M, FAR_M = 10e-3, 40e-3  # from a quiet place to the nearest focus
NOISE_DB = (20, 30, 40)
DRIFT = 1e-3  # of all frequencies


def scene(rng: np.random.Generator, board: Board, foci: int, quiet: int) -> tuple[np.ndarray, np.ndarray]:
    """Random foci, and quiet places 10 to 40 mm from one of them and at least 10 mm from all."""
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
    """Worst point over the bound, equality and amplitudes."""
    plain, exact = SignOfSum(board, model), ExactComposition(board, model)
    print("points: worst over the bound: plain median, worst; exact median, worst; largest difference; amplitudes off; ms")
    for foci in (1, 2, 4, 10):
        rng = np.random.default_rng(seed)
        rows, times = [], []
        for _ in range(scenes):
            points, _ = scene(rng, board, foci, 0)
            begun = time.process_time()
            reached = exact.design(full(points)).displacement_m
            times.append(time.process_time() - begun)
            in_band = exact.deviations(model.drive_order_responses(points, dtype=np.float64))
            _, bound = farthest(in_band, np.sign(reached))
            size = np.abs(reached)
            asked = rng.uniform(0.25, 1, foci)
            got = np.abs(
                exact.design([(*point, share) for point, share in zip(points.tolist(), asked.tolist(), strict=True)]).displacement_m
            )
            before = plain.design(full(points)).displacement_m
            rows.append(
                (before.min() / bound, size.min() / bound, np.ptp(size) / size.mean(), np.abs(got / size / asked - 1).max())
            )
        found = np.array(rows)
        medians, worst = np.median(found, axis=0), [found[:, 0].min(), found[:, 1].min(), found[:, 2].max(), found[:, 3].max()]
        print(
            f"{foci:3}: {medians[0]:.3f} {worst[0]:.3f}; {medians[1]:.3f} {worst[1]:.3f}; {100 * worst[2]:.2f} %; "
            f"{100 * worst[3]:.2f} %; {1e3 * np.median(times):.0f}"
        )


def nulls(board: Board, model: ResponseModel, seed: int, scenes: int) -> None:
    """Depth below plain and below the focus, and loss."""
    plain, exact, null = SignOfSum(board, model), ExactComposition(board, model), ExactNulls(board, model)
    drift = Prediction(drifted(board, DRIFT), ResponseModel(drifted(board, DRIFT)))
    print(
        "foci, quiet places: plain below focus; null below plain: median, worst; loss: median, worst; at 0.1 % drift below plain,"
    )
    print("below the focus; with responses of 20, 30, 40 dB SNR: null below plain, below the focus; s")
    for foci, quiet in ((1, 1), (1, 3), (2, 2), (4, 4)):
        rng = np.random.default_rng(seed)
        rows, times = [], []
        for _ in range(scenes):
            points, places = scene(rng, board, foci, quiet)
            before, alone = plain.design(full(points)), exact.design(full(points))
            begun = time.process_time()
            design = null.design(full(points), [(x_m, y_m) for x_m, y_m in places.tolist()])
            times.append(time.process_time() - begun)
            said = Prediction(board, model)
            left = np.abs(said.near_focus(before.words, places)).max()
            focus = np.abs(before.displacement_m).min()
            row = [_db(focus / left), _db(left / design.quiet_m.max())]
            row.append(100 * (1 - np.abs(design.displacement_m).min() / np.abs(alone.displacement_m).min()))
            drift_left = np.abs(drift.near_focus(design.words, places)).max()
            row.append(_db(np.abs(drift.near_focus(before.words, places)).max() / drift_left))
            row.append(_db(np.abs(drift.at_focus(design.words, points)).min() / drift_left))
            in_band = exact.deviations(model.drive_order_responses(points, dtype=np.float64))
            whole = exact.deviations(model.responses(points)[:, ::-1])
            near = null.near_focus(places)
            for snr_db in NOISE_DB:
                noisy = [_noisy(rng, rows_, snr_db) for rows_ in (in_band, whole, near)]
                bits = best_bits(noisy[0], noisy[1], np.ones(foci), independent(noisy[2]), 48)
                row += [_db(left / np.abs(near @ bits).max()), _db(np.abs(whole @ bits).min() / np.abs(near @ bits).max())]
            rows.append(row)
        found = np.array(rows)
        mid = np.median(found, axis=0)
        print(
            f"{foci} {quiet}: {mid[0]:.1f}; {mid[1]:.1f} {found[:, 1].min():.1f}; {mid[2]:.2f} {found[:, 2].max():.2f} %; "
            f"{mid[3]:.1f} {mid[4]:.1f}; "
            + ", ".join(f"{mid[5 + 2 * i]:.1f} {mid[6 + 2 * i]:.1f}" for i in range(3))
            + f"; {np.median(times):.2f}"
        )


def _noisy(rng: np.random.Generator, rows: np.ndarray, snr_db: float) -> np.ndarray:
    """Rows with white noise of their own."""
    return rows + rng.normal(size=rows.shape) * np.sqrt((rows**2).mean()) * 10 ** (-snr_db / 20)


def _db(ratio: float) -> float:
    return float(20 * np.log10(ratio))


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--scenes", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    board = load_board(find_board("simulated"))
    assert channel_bits(np.array([board.idle_word], np.uint32)).sum() == 16
    model = ResponseModel(board)
    with threadpool_limits(1, "blas"):
        compositions(board, model, options.seed, options.scenes)
        nulls(board, model, options.seed, options.scenes)


if __name__ == "__main__":
    main()

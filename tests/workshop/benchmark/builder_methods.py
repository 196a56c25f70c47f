"""What each method of the bank builder buys: `python -m tests.workshop.benchmark.builder_methods [METHOD ...]`.

Foci at random places, played on the plate twin of the simulated board, beside the paper's words at the same places: rows of medians
for the table in controller/workshop/bank_builder/methods/README.md. "Off": all frequencies of the twin's plate are 0.5 % higher, or
lower, whichever is worse. Some minutes for all.
"""

import argparse
import dataclasses

import msgspec
import numpy as np

from controller.device.bank.packing import channel_bits
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.board.panel import AssumedFinger
from controller.workshop.bank_builder.methods.descent import AIMS, Descent
from controller.workshop.benchmark.focus.focus_figures import emit, random_points
from controller.workshop.benchmark.stage.power import resistor_loss_j
from controller.workshop.physics.audible import surface_energy
from controller.workshop.physics.felt import LIGHT_TOUCH, ONE_NEWTON, felt_amplitudes_um
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.sound import PlateSound, decibels

BOARD = load_board(find_board("simulated"))
OFF = 0.005
FINGER = {"finger": AssumedFinger()}
BOARDS = {
    "the paper's": ({}, {}),
    "`[finger]`": (FINGER, {}),
    "`slope = -1`": ({}, {"slope": -1.0}),
    "`slope = 1`": ({}, {"slope": 1.0}),
    "`drift_percent = 0.3`": ({}, {"drift_percent": 0.3}),
    "`drift_percent = 0.4`": ({}, {"drift_percent": 0.4}),
    "`slope = -1`, `drift_percent = 0.3`": ({}, {"slope": -1.0, "drift_percent": 0.3}),
    "`[finger]`, `drift_percent = 0.3`": (FINGER, {"drift_percent": 0.3}),
}
HEADS = ("amplitude", "off by 0.5 %", "light touch", "1 N", "contrast", "spot mm", "edges", "heat", "below 16 kHz dB", "dB(A)")
COLUMNS = ("{:.2f}", "{:.2f}", "{:.2f}", "{:.2f}", "{:.0f}", "{:.2f}", "{:.2f}", "{:.2f}", "{:+.1f}", "{:+.1f}")


def plates():
    """Twins of the board's plate, and of those whose frequencies are off."""
    twin = PlateTwin(BOARD)
    higher = [dataclasses.replace(twin.modes, angular_frequency=twin.modes.angular_frequency * (1 + off)) for off in (OFF, -OFF)]
    return [twin, *(PlateTwin(BOARD, modes=modes) for modes in higher)]


def words_of(method, twin, places):
    if method in AIMS:
        return Descent(BOARD, twin.responses, AIMS[method]).entries(places)
    keys, of_waveform = BOARDS[method]
    board = msgspec.structs.replace(BOARD, waveform=msgspec.structs.replace(BOARD.waveform, **of_waveform), **keys)
    source = PlateTwin(board, modes=twin.modes).words_source
    return [focus(source.drive_order_responses([place], dtype=np.float64), [1.0], BOARD.idle_word) for place in places]


def figures(words, place, twins, sound):
    """A row: um, um, um, um, contrast, mm, edges, J, dB, dB."""
    found, *off = (emit(twin, words).focus_metrics(*place.tolist()) for twin in twins)
    idle = np.array([BOARD.idle_word], np.uint32)
    levels = channel_bits(np.concatenate([idle, words, idle]).astype("<u4")).astype(np.int8)
    felt = (felt_amplitudes_um(BOARD, twins[0].modes, words, place, load)[0] for load in (LIGHT_TOUCH, ONE_NEWTON))
    return [
        *(found.amplitude_m * 1e6, min(one.amplitude_m for one in off) * 1e6, *felt, found.contrast, found.spot_m * 1e3),
        *(np.abs(np.diff(levels, axis=0)).sum(), resistor_loss_j(BOARD.driver, levels, BOARD.waveform.bit_period_s).sum()),
        *(decibels(surface_energy(BOARD, words, BOARD.idle_word)), decibels(sound.exposure_pa2_s(words, BOARD.idle_word))),
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("methods", nargs="*", metavar="METHOD", help=f"of {', '.join([*BOARDS, *AIMS])}; all by default")
    parser.add_argument("--points", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    twins, places = plates(), random_points(BOARD, given.seed, given.points)
    sound = PlateSound(BOARD, twins[0].modes)

    def rows(method):
        words = words_of(method, twins[0], places)
        return np.array([figures(*one, twins, sound) for one in zip(words, places, strict=True)])

    plain = rows("the paper's")
    print(f"| {given.points} foci, seed {given.seed} |", *(f"{head} |" for head in HEADS))
    print("|---" * (len(HEADS) + 1) + "|")
    for method in given.methods or [*BOARDS, *AIMS]:
        found = plain.copy() if method == "the paper's" else rows(method)
        found[:, 1] /= plain[:, 0]
        for column in (0, 2, 3, 6, 7):
            found[:, column] /= plain[:, column]
        found[:, 8:] -= plain[:, 8:]
        cells = (one.format(value) for one, value in zip(COLUMNS, np.median(found, axis=0), strict=True))
        print(f"| {method if method in BOARDS else f'`--optimise {method}`'} |", *(f"{cell} |" for cell in cells), flush=True)


if __name__ == "__main__":
    main()

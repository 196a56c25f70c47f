"""Responses of the plate model, and what a bank keeps of them by each way of making words, against those that were recorded for
`MODEL_VERSION`: they change only together.

After a change that is meant: raise `MODEL_VERSION` in device/bank/provenance.py, then run this file by `.venv/bin/python`, which
records.
"""

import json
from pathlib import Path

import msgspec
import numpy as np
from tables import each_row

from controller.device.bank.provenance import MODEL_VERSION
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.board.panel import AssumedFinger
from controller.device.board.plate.plate import Edges
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.responses.loaded_responses import words_source

FILE = Path(__file__).with_name("model_responses.json")
TOLERANCE = 1e-6  # of the rms of a response: rounding of other processors and libraries
POINTS_M = ((0.031, 0.042), (0.1, 0.07))
SAMPLES, KEPT = slice(100, 1000, 150), slice(100, 1500, 91)
PLATES = {
    "supported": {},
    "mindlin": {"theory": "mindlin"},
    "free": {"edges": Edges(x0="supported", x1="free", y0="supported", y1="clamped")},
}
WORDS = {
    "slope": {"waveform": {"slope": -1.0}},
    "drift": {"waveform": {"drift_percent": 0.3}},
    "finger at a point": {"finger": AssumedFinger()},
    "finger on a plate": {"finger": AssumedFinger(receptance="plate"), "waveform": {"slope": 1.0}},
}
BOARD = load_board(find_board("simulated"))


def board_of(name):
    """Of the plates the board with the channels that are on it; of the ways of making words with these keys."""
    keys = dict(WORDS.get(name, {}))
    plate = msgspec.structs.replace(BOARD.plate, length_mm=120.0, width_mm=90.0, **PLATES.get(name, {}))
    waveform = msgspec.structs.replace(BOARD.waveform, **keys.pop("waveform", {}))
    inside = tuple(a for a in BOARD.actuators if a.x_mm < plate.length_mm - 10 and a.y_mm < plate.width_mm - 10)
    return msgspec.structs.replace(BOARD, plate=plate, waveform=waveform, actuators=inside, **keys)


def responses(board):
    """Some samples of some responses in nm per V: {kind: (point, sample, channel)}."""
    model = ResponseModel(board, 40e3)
    channels = [board.actuators[0].channel, board.actuators[-1].channel]
    found = {band: model.responses(POINTS_M, band_limited=band == "band")[:, SAMPLES] for band in ("band", "whole")}
    found["kept"] = words_source(board, model, model.plate_modes).entry_responses(POINTS_M, dtype=np.float64)[:, KEPT]
    return {kind: 1e9 * responses[:, :, channels] for kind, responses in found.items()}


def error(board, name):
    """Greatest difference from what was recorded, of the rms."""
    recorded = json.loads(FILE.read_text())["responses"][name]
    return max(np.abs(values - recorded[kind]).max() / np.std(recorded[kind]) for kind, values in responses(board).items())


@each_row("name", [*PLATES, *WORDS])
def test_responses_are_those_of_this_version(name):
    assert json.loads(FILE.read_text())["model_version"] == MODEL_VERSION
    board = board_of(name)
    assert error(board, name) < TOLERANCE
    if name in WORDS:
        return
    stiffer = msgspec.structs.replace(board.plate, young_modulus_pa=board.plate.young_modulus_pa * 1.00001)
    assert error(msgspec.structs.replace(board, plate=stiffer), name) > TOLERANCE


def record():
    reported = {name: {kind: values.tolist() for kind, values in responses(board_of(name)).items()} for name in (*PLATES, *WORDS)}
    FILE.write_text(json.dumps({"model_version": MODEL_VERSION, "responses": reported}, indent=1) + "\n")


if __name__ == "__main__":
    record()

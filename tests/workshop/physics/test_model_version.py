"""Responses of the plate model against those that were recorded for `MODEL_VERSION`: they change only together.

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
from controller.device.board.panel import Edges
from controller.workshop.physics.responses.impulse_response import ResponseModel

FILE = Path(__file__).with_name("model_responses.json")
TOLERANCE = 1e-6  # of the rms of a response: rounding of other processors and libraries
POINTS_M = ((0.031, 0.042), (0.1, 0.07))
SAMPLES = slice(100, 1000, 150)
PLATES = {
    "supported": {},
    "mindlin": {"theory": "mindlin"},
    "free": {"edges": Edges(x0="supported", x1="free", y0="supported", y1="clamped")},
}
BOARD = load_board(find_board("simulated"))


def board_with(**plate):
    return msgspec.structs.replace(BOARD, plate=msgspec.structs.replace(BOARD.plate, length_mm=120.0, width_mm=90.0, **plate))


def responses(board):
    """Some samples of some responses in nm per V: {band: (point, sample, channel)}."""
    inside = [a for a in board.actuators if a.x_mm < board.plate.length_mm - 10 and a.y_mm < board.plate.width_mm - 10]
    model = ResponseModel(msgspec.structs.replace(board, actuators=tuple(inside)), 40e3)
    channels = [inside[0].channel, inside[-1].channel]
    found = {band: model.responses(POINTS_M, band_limited=band == "band") for band in ("band", "whole")}
    return {band: 1e9 * responses[:, SAMPLES][:, :, channels] for band, responses in found.items()}


def error(board, name):
    """Greatest difference from what was recorded, of the rms."""
    recorded = json.loads(FILE.read_text())["responses"][name]
    return max(np.abs(values - recorded[band]).max() / np.std(recorded[band]) for band, values in responses(board).items())


@each_row("name", PLATES)
def test_responses_are_those_of_this_version(name):
    assert json.loads(FILE.read_text())["model_version"] == MODEL_VERSION
    board = board_with(**PLATES[name])
    assert error(board, name) < TOLERANCE
    stiffer = msgspec.structs.replace(board.plate, young_modulus_pa=board.plate.young_modulus_pa * 1.00001)
    assert error(msgspec.structs.replace(board, plate=stiffer), name) > TOLERANCE


def record():
    reported = {
        name: {band: values.tolist() for band, values in responses(board_with(**plate)).items()} for name, plate in PLATES.items()
    }
    FILE.write_text(json.dumps({"model_version": MODEL_VERSION, "responses": reported}, indent=1) + "\n")


if __name__ == "__main__":
    record()

"""The plate's modes as a file from which a web page computes the field of one emission at any point that is pressed.

The page (`field_model.js`) does what `focus` does: it weights the modes' band-limited responses by their shapes at the point, takes
the sign, and steps the modes exactly from bit to bit. Of what it needs only those responses are large. They decide about signs
alone, so a byte a sample is enough: words that differ do so where the response is next to zero.
"""

import contextlib
import os
from pathlib import Path
from typing import Any, Final

import msgspec
import numpy as np
from numpy.typing import NDArray

from controller.device.bank.provenance import MODEL_VERSION
from controller.device.board.board import Board
from controller.device.board.paths import user_cache
from controller.errors import ConfigError
from controller.workshop.physics.field import FocusScale
from controller.workshop.physics.modes.closed_form import Sines
from controller.workshop.physics.responses.impulse_response import ResponseModel

MAGIC: Final = b"HPfield1"
BYTES_MAX: Final = 16 << 20  # that the bridge serves
ALIGNED: Final = 8
LEVELS: Final = 127


def write_field(board: Board, path: Path) -> int:
    """Write the file of a board, whole or not at all; returns its bytes.

    Raises ConfigError if the plate's shapes are no products of sines, the file would be too large, or it cannot be written.
    """
    data = encoded_field(board)
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        part.write_bytes(data)
        part.replace(path)
    except OSError as error:
        raise ConfigError(f"{path}: the field cannot be written ({error.strerror})") from error
    finally:
        with contextlib.suppress(OSError):
            part.unlink(missing_ok=True)
    return len(data)


def kept_field(board: Board) -> Path:
    """The file of a board in the user's cache, written if it is not there; its name says what it was computed from.

    Raises ConfigError as `write_field`, or if there is no cache.
    """
    path = user_cache() / "fields" / f"{board.key}-{board.digest().hex()[:16]}-model{MODEL_VERSION}.field"
    if not path.is_file():
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ConfigError(f"{path.parent}: cannot be made ({error.strerror})") from error
        write_field(board, path)
    return path


def encoded_field(board: Board) -> bytes:
    """The file: magic, length of the header as uint32, header in JSON, sections; little-endian, each begins at 8 bytes.

    Raises ConfigError if the plate's shapes are no products of sines, or the file would be too large.
    """
    model = ResponseModel(board)
    factors = model.plate_modes.factors
    if not isinstance(factors, Sines):
        raise ConfigError(
            f"board {board.name!r}: the field view needs shapes that are products of sines: a plate with"
            ' edges = "simply_supported" and without [patches]; `haptic-panel focus --movie` shows any plate'
        )
    expected = model.modes * model.samples
    if expected > BYTES_MAX:
        raise ConfigError(
            f"board {board.name!r}: {model.modes} modes and {model.samples} samples are {expected >> 20} MB: a field view has at"
            f" most {BYTES_MAX >> 20}; `haptic-panel focus --movie` shows any plate"
        )
    sections = _sections(model, factors, board.waveform.bit_period_s)
    plate, waveform = board.plate, board.waveform
    header: dict[str, Any] = {
        "board": board.name,
        "length_m": plate.length_m,
        "width_m": plate.width_m,
        "bit_period_s": waveform.bit_period_s,
        "samples": waveform.samples,
        "middle_hz": waveform.middle_hz,
        "supply_v": board.driver.supply_v,
        "idle_word": board.fpga_boards[0].idle_word,
        **({"idle_words": [one.idle_word for one in board.fpga_boards]} if board.link.fpga else {}),
        "outside_m": FocusScale.of(board).outside_m,
        "patches_m": [[side * 1e-3 for side in (a.x_mm, a.y_mm, a.size_mm)] for a in board.actuators],
        "modes": model.modes,
        "sections": {},
    }
    body = bytearray()
    for name, values in sections.items():
        header["sections"][name] = {"type": values.dtype.name, "offset": len(body), "count": values.size}
        body += values.astype(values.dtype.newbyteorder("<"), copy=False).tobytes()
        body += bytes(-len(body) % ALIGNED)
    head = msgspec.json.encode(header)
    head += b" " * (-(len(MAGIC) + 4 + len(head)) % ALIGNED)
    return MAGIC + len(head).to_bytes(4, "little") + head + bytes(body)


def _sections(model: ResponseModel, factors: Sines, bit_period_s: float) -> dict[str, NDArray[Any]]:
    """Tables of the modes; a term is an exponential in a mode's displacement after a step of force: of the plate, or the driver."""
    step, modes = model.step, np.arange(model.modes)
    poles = np.concatenate([step.poles, np.repeat(step.driver_poles, model.modes)])
    residues = np.concatenate([step.residues, step.driver_residues.T.ravel()])
    turn = np.exp(poles * bit_period_s)
    response = model.modal_band
    scale = np.abs(response).max(axis=1) / LEVELS
    return {
        "half_waves_x": (factors.x_index + 1).astype(np.uint16),
        "half_waves_y": (factors.y_index + 1).astype(np.uint16),
        "static": step.static.astype(np.float32),
        "forces": np.ascontiguousarray(model.forces.T, np.float32),  # channel by channel
        "term_mode": np.concatenate([step.mode_of_pole, modes, modes]).astype(np.uint16),
        "term_turn": np.column_stack([turn.real, turn.imag]).astype(np.float32),
        "term_residue": np.column_stack([residues.real, residues.imag]).astype(np.float32),
        "response_scale": scale.astype(np.float32),
        "response": np.rint(response / scale[:, None]).astype(np.int8),  # sample j: j + 1 bits after the pulse began
    }

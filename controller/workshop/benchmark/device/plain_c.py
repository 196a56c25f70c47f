"""What composing costs in plain C: `compose_reference.c`, compiled by the system's compiler while the benchmark runs."""

import ctypes
import os
import shutil
from array import array
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from controller.device.bank.packing import WORD
from controller.device.bank.reader import Bank
from controller.device.kernel import Point
from controller.errors import ConfigError
from controller.programs import ProgramError, run_program

SOURCE = Path(__file__).with_name("compose_reference.c")
COMPILE_S = 300.0  # that a compiler may take
SAMPLES = 1000  # of a waveform: fixed in the source


class BankOfReference(ctypes.Structure):
    """`struct bank` of the source."""

    _fields_ = (
        *((name, ctypes.c_void_p) for name in ("response", "entry_of", "scale_of")),
        *((name, ctypes.c_int64) for name in ("stride", "nx", "ny")),
        *((name, ctypes.c_double) for name in ("pitch_m", "x0_m", "y0_m", "equaliser", "band_lost")),
        ("idle_word", ctypes.c_uint32),
    )


class PlainC:
    """Plain C on the responses of an open bank of which every cell that is played was used before.

    `folder` is for the compiled library. Raises ConfigError if there is no C compiler, or it fails, or the bank's waveforms are not
    of 1,000 samples.
    """

    def __init__(self, folder: Path, bank: Bank, idle_word: int) -> None:
        if bank.samples != SAMPLES:
            raise ConfigError(f"plain C composes {SAMPLES} samples, not {bank.samples}")
        self._call = ctypes.CDLL(str(_compiled(folder))).compose_reference
        self._call.restype = ctypes.c_int64
        grid, (entries, scales, _) = bank.grid, bank.responses.tables()
        self._kept = np.array(entries, np.int32), np.array(scales, np.float32), np.frombuffer(bank.responses.section, np.int8)
        entry_of, scale_of, response = (some.ctypes.data for some in self._kept)
        stride = bank.sections["response"].stride
        self._bank = BankOfReference(
            response,
            entry_of,
            scale_of,
            stride,
            grid.nx,
            grid.ny,
            grid.pitch_m,
            grid.x0_m,
            grid.y0_m,
            bank.header.equaliser,
            bank.header.band_lost,
            idle_word,
        )
        self.words = (ctypes.c_uint32 * bank.samples)()  # of the last call

    def compose(self, points: Sequence[Point]) -> int:
        """Compose up to ten points, all at full amplitude; time in ns."""
        places = array("d", [number for x_m, y_m, _ in points for number in (x_m, y_m)])
        address, _ = places.buffer_info()
        taken_ns: int = self._call(ctypes.byref(self._bank), ctypes.c_void_p(address), len(points), self.words)
        return taken_ns

    def words_bytes(self) -> bytes:
        """Drive words of the last call."""
        return np.array(self.words, WORD).tobytes()


def _compiled(folder: Path) -> Path:
    """The source as a library."""
    compiler = os.environ.get("CC", "cc")
    if not shutil.which(compiler):
        raise ConfigError(f"no C compiler ({compiler}): what plain C takes is left out")
    library = folder / "compose_reference.so"
    command = [compiler, "-O3", "-fno-math-errno", "-shared", "-fPIC"]
    try:
        run_program([*command, "-o", library, SOURCE, "-lm"], COMPILE_S)
    except ProgramError as error:
        raise ConfigError(f"{SOURCE.name} is not compiled: {error}") from error
    return library

"""The C twin beside a loop: the same reports and plays, and the same bytes as the loop sends, or an error."""

from __future__ import annotations

import ctypes
import platform
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.fpga.frames import FRAME_BYTES, PLAY, UPLOAD_BYTES
from controller.device.fpga.registers import Control, FrameType
from controller.device.scene.scene import Scene
from controller.device.touch.axes import AxisRange, PanelAxes
from controller.device.touch.drivers.event_device import INPUT_EVENT
from controller.device.touch.event_codes import POSITIONS
from controller.device.touch.event_reader import DeviceDescription
from controller.device.touch.tracker import Tracker
from controller.device.waveforms.selection import LATTICE_M, REUSE_RADIUS_M
from controller.metrics import LatencyHistogram

PLAIN = ("-O2", "-fno-tree-vectorize")
VECTORS_128 = ("-O3", "-DVECTORS", *(("-msse4.2", "-mno-avx") if platform.machine() == "x86_64" else ()))
SOURCE = Path(__file__).with_name("c_twin.c")
REGIONS = 16


class Config(ctypes.Structure):
    _fields_ = (
        *((name, ctypes.c_void_p) for name in ("drive", "response", "entry_of", "scale_of", "crc_of", "crc32")),
        *((name, ctypes.c_int64) for name in ("drive_stride", "response_stride", "nx", "ny", "regions", "slots")),
        *(
            (name, ctypes.c_double)
            for name in ("pitch_m", "x0_m", "y0_m", "equaliser", "band_lost", "snap_m", "near_m", "lattice_m")
        ),
        *((name, ctypes.c_double) for name in ("length_m", "width_m", "lag_s", "max_size_m")),
        ("rectangle", ctypes.c_double * 4 * REGIONS),
        ("spacing_m", ctypes.c_double * REGIONS),
        ("idle_word", ctypes.c_int64),
    )


class CAxes(ctypes.Structure):
    _fields_ = (
        ("origin", ctypes.c_double * 6),
        ("size_m", ctypes.c_double),
        *((name, ctypes.c_int64) for name in ("x_low", "x_high", "y_low", "y_high")),
    )


class Reported(ctypes.Structure):
    _fields_ = (
        ("focus_s", ctypes.c_double),
        *((name, ctypes.c_int) for name in ("slot", "sequence", "stop", "nops", "count", "start")),
        ("period_ticks", ctypes.c_uint32),
        ("when_ticks", ctypes.c_uint64),
    )


def compiled(folder: Path, *flags: str) -> ctypes.CDLL:
    """The twin as a library; another one each time, with a state of its own."""
    library = folder / f"c_twin_{len(list(folder.iterdir()))}.so"
    warnings = ("-Wall", "-Wextra", "-Werror")
    subprocess.run(["cc", *flags, *warnings, "-ffp-contract=off", "-shared", "-fPIC", "-o", library, SOURCE, "-lm"], check=True)
    twin = ctypes.CDLL(str(library))
    twin.twin_read.restype = twin.twin_upload.restype = twin.twin_play.restype = ctypes.c_int64
    twin.twin_read.argtypes = (ctypes.c_void_p, ctypes.c_int, ctypes.c_double)
    twin.twin_sent.restype = ctypes.c_void_p
    return twin


class Twin:
    """Follows a loop: its reads, where it aims, and what it sends.

    Attributes
    ----------
    checked, composed, played : int
        Uploads compared; those of several fingers; plays from a slot compared. All have to be equal, byte for byte.
    """

    def __init__(self, folder: Path, board: Board, scene: Scene, bank: Bank, descriptions: Sequence[DeviceDescription]) -> None:
        self.checked = self.composed = self.played = 0
        self._folder = folder
        self._twin = compiled(folder, *VECTORS_128)
        self._descriptions = descriptions
        self._board = board
        self._panel: int | None = None
        self._asked: list[int] = []
        self._focus_s = 0.0
        self._images: dict[bytes, int] = {}
        self._kept: list[Any] = []
        self._calls: list[tuple[Any, ...]] = []  # a function of the twin and its arguments; none where a turn begins
        self._config = self._configured(board, scene, bank)
        self._twin.twin_begin(ctypes.byref(self._config))
        self._sent = np.ctypeslib.as_array(
            ctypes.cast(self._twin.twin_sent(), ctypes.POINTER(ctypes.c_uint8)), (UPLOAD_BYTES + 8 * FRAME_BYTES,)
        )

    def turn(self) -> None:
        """A turn of the loop begins."""
        self._calls.append(())

    def replay(self, flags: Sequence[str]) -> dict[str, LatencyHistogram]:
        """All once more without the loop: its times from the read of the report, if that was in the same turn, by kind.

        Caches are then as the twin leaves them, not as the loop has just filled them.

        Parameters
        ----------
        flags : sequence of str
            For the compiler: `PLAIN`, or `VECTORS_128`.

        Returns
        -------
        dict
            "uploads" and "resident".
        """
        found = {"twin_upload": LatencyHistogram(), "twin_play": LatencyHistogram()}
        twin = compiled(self._folder, *flags)
        twin.twin_begin(ctypes.byref(self._config))
        calls = [(call[0], getattr(twin, call[0]), call[1:]) if call else ("", None, ()) for call in self._calls]
        read_ns = 0
        for name, function, arguments in calls:
            if function is None:
                read_ns = 0
                continue
            took_ns = function(*arguments)
            if name == "twin_read":
                read_ns += took_ns
            elif name in found:
                assert took_ns > 0, f"the twin does not know what it played before ({took_ns})"
                found[name].record(took_ns + read_ns)
        return {"uploads": found["twin_upload"], "resident": found["twin_play"]}

    def _call(self, name: str, *arguments: Any) -> int:
        self._calls.append((name, *arguments))
        result: int = getattr(self._twin, name)(*arguments)
        return result

    def given(self, now_s: float, which: int, image: bytes, first: int, count: int) -> None:
        """A read of the loop's panel."""
        if count and which != self._panel:
            self._panel = which
            x, y = (AxisRange(*self._descriptions[which].axes[code][:2]) for code in POSITIONS)
            axes = PanelAxes(self._board, x, y)
            from_axes = (ctypes.c_double * 6)(*axes.from_axes)
            panel = CAxes(from_axes, axes.size_m_per_unit, x.minimum, x.maximum, y.minimum, y.maximum)
            self._call("twin_panel", ctypes.byref(panel))
        at = 0
        if count:
            if id(image) not in self._images:
                self._kept.append(image)  # replays read it too
                self._images[id(image)] = np.frombuffer(image, np.uint8).ctypes.data
            at = self._images[id(image)] + first * INPUT_EVENT.size
        self._call("twin_read", at, count, now_s)

    def aimed(self, finger: int, focus_s: float) -> None:
        """The loop asks where a finger will be."""
        if focus_s != self._focus_s:
            self._asked.clear()
            self._focus_s = focus_s
        if finger not in self._asked:  # it asks twice: for when it would play from a slot, and for after an upload
            self._asked.append(finger)

    def sent(self, sent: memoryview, lengths: Sequence[int]) -> None:
        """The loop sends a message."""
        asked, self._asked = self._asked, []
        focus_s, self._focus_s = self._focus_s, 0.0
        end = sum(lengths)
        shorts = sum(length == FRAME_BYTES for length in lengths)
        kinds = [sent[end - FRAME_BYTES * back + 2] for back in range(shorts, 0, -1)]
        if FrameType.PLAY not in kinds:
            return
        play = end - FRAME_BYTES * (shorts - kinds.index(FrameType.PLAY))
        _, _, _, _, slot, _, _, count, start, _, period_ticks, _, when_ticks = PLAY.unpack_from(sent, play)
        stop = Control.STOP if FrameType.WRITE in kinds else 0
        nops = kinds.count(FrameType.NOP) - 1
        reported = Reported(focus_s, slot, sent[3], stop, nops, count, start, period_ticks, when_ticks)
        fingers = (ctypes.c_int * len(asked))(*asked)
        resident = len(lengths) == shorts
        took_ns = self._call("twin_play" if resident else "twin_upload", fingers, len(asked), ctypes.byref(reported))
        assert took_ns > 0, f"the twin does not know what the loop plays ({took_ns})"
        self._compare(np.frombuffer(sent, np.uint8, end), len(asked), resident)

    def _compare(self, ours: np.ndarray, fingers: int, resident: bool) -> None:
        theirs = self._sent[: ours.size]
        self.played += resident
        self.checked += not resident
        self.composed += fingers > 1 and not resident
        what = f"play {self.played} from a slot" if resident else f"upload {self.checked} of {fingers} fingers"
        assert np.array_equal(ours, theirs), f"{what}: the twin's frames differ"

    def _configured(self, board: Board, scene: Scene, bank: Bank) -> Config:
        bank.responses.response(
            next(cell for cell, here in enumerate(bank.cells) if here)
        )  # both sections are mapped with the first use
        bank.drive.words(next(cell for cell, here in enumerate(bank.cells) if here))
        crc32 = ctypes.CDLL("libz.so.1").crc32
        drive, response = (np.frombuffer(view, np.uint8) for view in (bank.drive._mapped, bank.responses.section))
        entry_of, scale_of = np.array(bank.file.tables.entries, np.int32), np.array(bank.file.tables.scales)
        crc_of = np.array([drive_crc for drive_crc, _ in bank.file.tables.crcs], np.uint32)
        self._kept = [crc32, drive, response, entry_of, scale_of, crc_of]
        grid, config = bank.grid, Config()
        values = {
            "drive": drive.ctypes.data,
            "response": response.ctypes.data,
            "entry_of": entry_of.ctypes.data,
            "scale_of": scale_of.ctypes.data,
            "crc_of": crc_of.ctypes.data,
            "crc32": ctypes.cast(crc32, ctypes.c_void_p).value,
            "drive_stride": bank.sections["drive"].stride,
            "response_stride": bank.sections["response"].stride,
            "nx": grid.nx,
            "ny": grid.ny,
            "regions": len(scene.regions),
            "slots": board.link.slots,
            "pitch_m": grid.pitch_m,
            "x0_m": grid.x0_m,
            "y0_m": grid.y0_m,
            "equaliser": bank.header.equaliser,
            "band_lost": bank.header.band_lost,
            "snap_m": board.bank.snap_mm * 1e-3,
            "near_m": REUSE_RADIUS_M,
            "lattice_m": LATTICE_M,
            "length_m": board.plate.length_m,
            "width_m": board.plate.width_m,
            "lag_s": board.touch.lag_s,
            "max_size_m": board.touch.max_size_m,
            "idle_word": board.idle_word,
        }
        for name, value in values.items():
            setattr(config, name, value)
        for index, region in enumerate(scene.regions):
            config.rectangle[index][:] = region.shape.bounds
            config.spacing_m[index] = region.spacings[0].spacing_m if region.spacings else 0.0
        return config


class Watched:
    """A tracker that tells the twin what it was asked.

    Not a class of its kind: the tracker may be a compiled one.
    """

    def __init__(self, tracker: Tracker, twin: Twin) -> None:
        self._tracker = tracker
        self._twin = twin

    def __getattr__(self, name: str) -> Any:
        return getattr(self._tracker, name)

    def predict(self, finger: int, at_s: float) -> tuple[float, float] | None:
        """As the tracker's."""
        self._twin.aimed(finger, at_s)
        return self._tracker.predict(finger, at_s)

"""The process that checks clients' layers for the event loop: warm, next to it in priority, one request after the other.

It has the board and its bank open from the first message on, and has imported all it needs. A request has a limit of time, the
process one of memory; each request gets exactly one answer. The process ends when the loop closes the socket.
"""

from __future__ import annotations

import os
import signal
import socket
from pathlib import Path
from types import FrameType

import numpy as np

from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.scene.coverage import cells_needed
from controller.device.scene.layer_tables import CheckedLayer, off_plate, read_layer, refusal
from controller.device.scene.layers import Placement, RefusedRegion
from controller.device.scene.scene import Region, Scene, SpatialIndex
from controller.device.service.scenes.layer_message import pack_layer, pack_refusal, unpack_request, unpack_setup
from controller.device.service.scenes.message_frame import board_of
from controller.device.service.scenes.realtime_share import RealtimeShare
from controller.device.service.scenes.scene_helper import MEMORY_BYTES, limit_memory, receive
from controller.errors import BankError, ControllerError


class _TooLong(Exception):
    """A request has taken longer than its limit."""


class LayerChecker:
    """Checks layers against a board and its bank.

    Cells that are `checked`, a byte each, or that were checked for a layer before, are not checked again.
    """

    def __init__(self, board: Board, bank: Path, checked: bytes) -> None:
        self._board = board
        self._bank = Bank.open(bank, board)
        grid = self._bank.grid
        self._has = self._bank.cells
        known = np.frombuffer(checked, np.uint8).astype(bool)
        self._good = known if len(known) == len(self._has) else np.zeros(len(self._has), bool)
        self._points_m, self._pitch_m = grid.points(), grid.pitch_m

    def answer(self, line: bytes, placement: Placement) -> bytes:
        """The answer to a request: the layer as a message; raises ControllerError if the layer as a whole is refused."""
        layer = self._with_waveforms(read_layer(line, self._board), placement)
        regions = layer.regions
        return pack_layer(regions, SpatialIndex.of(regions), off_plate(regions, placement, self._board), layer.refused)

    def _with_waveforms(self, layer: CheckedLayer, placement: Placement) -> CheckedLayer:
        """The layer with those regions whose waveforms the bank has, undamaged; the others are refused."""
        if self._good.all() or not layer.regions:
            return layer
        wanted = self._cells(layer.regions, placement)
        if not self._lacking(wanted):
            return layer
        regions, indices, refused = [], [], list(layer.refused)
        for region, index in zip(layer.regions, layer.indices, strict=True):
            lacking = self._lacking(self._cells((region,), placement))
            if lacking:
                refused.append(refusal(index, region.name, f"regions[{index}] ({region.name!r}): {lacking}"))
            else:
                regions.append(region)
                indices.append(index)
        return CheckedLayer(tuple(regions), tuple(indices), tuple(sorted(refused, key=_index)))

    def _cells(self, regions: tuple[Region, ...], placement: Placement) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
        """Cells that regions need; the plate's lengths are expressed in those of the layer."""
        x_m, y_m, scale = placement
        points_m = (self._points_m - (x_m, y_m)) / scale
        return cells_needed(Scene(regions), points_m, self._pitch_m / scale, wave_scale=self._bank.wave_scale / scale)

    def _lacking(self, wanted: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]) -> str:
        """What of these cells cannot be played; empty: nothing. Checked once, they are not checked again."""
        missing = int((wanted & ~self._has).sum())
        if missing:
            return f"the bank has no entry for {missing} cells that it reaches; rebuild it: {self._bank.rebuild}"
        cells = (wanted & ~self._good).nonzero()[0].tolist()
        try:
            self._bank.drive.check_frames(cells)
        except BankError as error:
            return str(error)
        self._good[cells] = True
        return ""


def serve_layers(loop: socket.socket, limit_s: float) -> None:
    """Answer requests until the other end of the socket is closed.

    `loop` is a stream to the loop, whose first message is the setup; `limit_s` is the time limit of one request.
    """
    signal.signal(signal.SIGALRM, _too_long)
    checker: LayerChecker | None = None
    unusable = ""
    message = receive(loop)
    if message is None:
        return
    try:
        setup = unpack_setup(message)
        board, bank = board_of(setup.board), Path(setup.bank)
        os.chdir(board.folder)
        limit_memory(bank)
        checker = LayerChecker(board, bank, setup.checked)
    except (ControllerError, OSError) as error:
        unusable = str(error)
    share = RealtimeShare(os.getppid())
    while (message := receive(loop)) is not None:
        with share:
            loop.sendall(pack_refusal(unusable) if checker is None else _answer(checker, message, limit_s))


def _answer(checker: LayerChecker, message: bytes, limit_s: float) -> bytes:
    """The answer to a request; any error becomes a refusal."""
    try:
        signal.setitimer(signal.ITIMER_REAL, limit_s)
        try:
            request = unpack_request(message)
            return checker.answer(request.line, request.placement)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
    except ControllerError as error:
        return pack_refusal(str(error))
    except _TooLong:
        return pack_refusal(f"checking the regions took longer than {limit_s:g} s")
    except MemoryError:
        return pack_refusal(f"checking the regions takes more memory than {MEMORY_BYTES >> 20} MB beside the bank")
    except Exception as error:  # whatever it is, the answer is one line, and the layer before stays in force
        return pack_refusal(f"checking the regions failed: {type(error).__name__}: {error}")


def _too_long(_number: int, _frame: FrameType | None) -> None:
    raise _TooLong


def _index(region: RefusedRegion) -> int:
    return region.index

"""Clients' layers for the event loop: a helper process checks them, one after the other; nothing here blocks."""

from __future__ import annotations

import time
from collections.abc import Iterable

import msgspec

from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.loop.layer_source import AcceptedLayer
from controller.device.scene.layers import Placement
from controller.device.service.scenes.helper_process import HelperProcess
from controller.device.service.scenes.layer_message import pack_request, pack_setup, unpack_layer
from controller.device.service.scenes.message_frame import HEADER, MessageError, length

LIMIT_S = 1.0  # time limit of one layer
GRACE_S = 5.0  # after that, until the helper counts as hanging: it may still be importing, or reading the bank from a slow card


class LayerPreparer:
    """A `LayerPreparation` that starts and uses a helper process, which is warm from its start on.

    `checked` are cells of the bank in use whose waveforms were checked; `limit_s` is the time limit of one layer.
    """

    def __init__(self, board: Board, bank: Bank, checked: Iterable[int], limit_s: float = LIMIT_S) -> None:
        cells = bytearray(bank.grid.cells)
        for cell in checked:
            cells[cell] = 1
        own = msgspec.structs.replace(board, folder=board.folder.absolute())
        self._setup = pack_setup(own, bank.path.absolute(), bytes(cells))
        self._limit_s = limit_s
        self._helper = HelperProcess("layers", limit_s)
        self._request = b""
        self._asked_again = False
        self._until_s = 0.0
        self._failed = ""
        self._said = bytearray()
        self._start()

    @property
    def pid(self) -> int:
        """Process id of the helper."""
        return self._helper.pid

    def begin(self, line: bytes, placement: Placement) -> None:
        """Begin to prepare a layer; see `LayerPreparation.begin`."""
        self._until_s = time.monotonic() + self._limit_s + GRACE_S
        self._request = pack_request(line, placement)
        self._asked_again = False
        self._failed = ""
        self._said.clear()
        if not self._helper.send(self._request):
            self._ask_again()

    def fileno(self) -> int | None:
        """File that is readable when the helper has answered; None while nothing is being prepared."""
        return self._helper.fileno() if self._request else None

    def take(self) -> AcceptedLayer | str | None:
        """The prepared layer, or why it was refused; None while it is not ready."""
        if not self._request:
            return None
        if not self._failed:
            self._read()
        if self._failed:
            self._request = b""
            return self._failed
        try:
            if len(self._said) < HEADER.size or len(self._said) < HEADER.size + length(self._said):
                return None
            layer = unpack_layer(bytes(self._said))
        except MessageError as error:
            self._helper.end()  # its next answer could not be distinguished from the rest of this one
            self._start()
            layer = f"what checks regions answers wrongly: {error}"
        self._request = b""
        return layer

    def close(self) -> None:
        """End the helper."""
        self._helper.close()

    def _start(self) -> None:
        """Start a helper, and have it get ready."""
        self._helper.start()
        self._helper.send(self._setup)

    def _ask_again(self) -> None:
        """The helper has died: start another one and repeat the request, once."""
        self._helper.end()
        self._start()
        if self._asked_again:
            self._failed = "the process that checks regions ends again and again"
            return
        self._asked_again = True
        self._said.clear()
        if not self._helper.send(self._request):
            self._failed = "no process to check regions"

    def _read(self) -> None:
        """Read a part of the helper's answer."""
        more = self._helper.receive()
        if more:
            self._said += more
        elif more is not None:
            self._ask_again()
        elif time.monotonic() > self._until_s:
            self._helper.end()
            self._start()
            self._failed = "the process that checks regions hangs, and was ended; send them again"

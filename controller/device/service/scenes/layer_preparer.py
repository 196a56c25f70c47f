"""Clients' layers for the event loop: a helper process checks them, one after the other; nothing here blocks."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.loop.preparation import AcceptedLayer
from controller.device.scene.layers import Placement
from controller.device.service.scenes.helper_process import Helper
from controller.device.service.scenes.layer_message import pack_request, pack_setup, unpack_layer

LIMIT_S = 1.0  # time limit of one layer


class LayerPreparer:
    """A `LayerPreparation` that starts and uses a helper process, which is warm from its start on.

    `checked` are cells of the bank in use whose waveforms were checked; `limit_s` is the time limit of one layer.
    """

    def __init__(self, board: Board, bank: Bank, checked: Iterable[int], limit_s: float = LIMIT_S) -> None:
        cells = bytearray(bank.grid.cells)
        for cell in checked:
            cells[cell] = 1
        own = msgspec.structs.replace(board, folder=board.folder.absolute())
        self.helper = Helper("layers", limit_s, "checks regions", pack_setup(own, bank.path.absolute(), bytes(cells)))
        self.fileno = self.helper.fileno
        self.close = self.helper.process.close

    def begin(self, line: bytes, placement: Placement) -> None:
        """Begin to prepare a layer; see `LayerPreparation.begin`."""
        self.helper.ask(pack_request(line, placement))

    def take(self) -> AcceptedLayer | str | None:
        """The prepared layer, or why it was refused; None while it is not ready."""
        return self.helper.take(unpack_layer)

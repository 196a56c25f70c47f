"""Entries of the cells of a bank, block by block: in this process as they are asked for, or by workers.

What workers send is kept in a file beside the bank until the bank is there (`workshop/workers/`).
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats, Reals, Words
from controller.device.bank.packing import CHANNELS, WORD, drive_words, quantise
from controller.errors import ConfigError
from controller.workshop.bank_builder.optimised import kept_path
from controller.workshop.bank_builder.plan import BankPlan, inputs_sha256
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.physics.memory import BASE_BYTES, require
from controller.workshop.physics.responses.kept_rest import rest_lift
from controller.workshop.physics.responses.response_source import ResponseSource
from controller.workshop.workers.map_kept import Mapped, map_kept

DEPEND_ON = ("pitch_mm", "highest_hz", "responses", "cells_sha256")  # build parameters: entries of blocks

Entry = tuple[Words, NDArray[np.int8], float]  # plain drive words, response in levels, m per V of a level


@dataclass(frozen=True, eq=False)
class CellEntries:
    """What makes entries from responses; a worker gets it once."""

    source: ResponseSource
    samples: int
    rows: int  # of a response: samples, then rest
    idle_word: int
    lift: tuple[float, float]  # of the rest (`rest_lift`)

    @classmethod
    def of(cls, plan: BankPlan) -> Self:
        """That of a build."""
        samples = plan.header.samples
        lift = rest_lift(plan.board, plan.header.grid.pitch_m)
        return cls(plan.source, samples, samples + plan.header.rest_rows, plan.board.idle_word, lift)

    def entries(self, points_m: Floats, room: Reals | None = None) -> Iterator[Entry]:
        """Entries of the cells of a block, at (cell, 2) in m; `room` for the responses of at least as many."""
        room = np.empty((len(points_m), self.rows, CHANNELS), np.float32) if room is None else room[: len(points_m)]
        own, beside = map(np.float32, self.lift)
        for response in self.source.entry_responses(points_m, out=room):
            rest, neighbours = response[self.samples :], beside * response[self.samples :]
            rest *= own
            rest[1:] -= neighbours[:-1]
            rest[:-1] -= neighbours[1:]
            yield drive_words(response[: self.samples], self.idle_word), *quantise(response)

    def __call__(self, blocks: Sequence[Floats]) -> list[bytes]:
        """Those of some blocks, each as `read` takes it."""
        return [self._joined(points_m) for points_m in blocks]

    def _joined(self, points_m: Floats) -> bytes:
        words, levels, scales = zip(*self.entries(points_m), strict=True)
        return b"".join((np.stack(words).tobytes(), np.stack(levels).tobytes(), np.array(scales, "<f4").tobytes()))

    def read(self, block: bytes, cells: int) -> Iterator[Entry]:
        """Entries of a block that a worker has sent."""
        words = np.frombuffer(block, WORD, cells * self.samples).reshape(cells, -1)
        levels = np.frombuffer(block, np.int8, cells * self.rows * CHANNELS, words.nbytes).reshape(cells, -1, CHANNELS)
        scales = np.frombuffer(block, "<f4", cells, words.nbytes + levels.nbytes)
        return zip(words, levels, scales.tolist(), strict=True)


def cells_by_workers(request: BankRequest, plan: BankPlan) -> Mapped:
    """All blocks by the position of their first cell, and who computed them; what an interrupted build has kept is taken.

    Raises ConfigError if this process, which collects them, may not take as much memory as the bank has bytes; WorkersError.
    """
    what = f"a bank of {request.board.name!r} that is collected from workers"
    require(BASE_BYTES + plan.header.file_bytes, request.memory_mb, what)
    if plan.design:
        raise ConfigError(f"{request.workers.option}: a compact bank is computed by one process: leave it out")
    parameters = {key: plan.header.parameters[key] for key in DEPEND_ON}
    firsts = [block.start for block in plan.blocks]
    kept = kept_path(request.path, inputs_sha256(plan.board, parameters | {"blocks": firsts}), "cells")
    items = {block.start: plan.points_m[block.start : block.stop] for block in plan.blocks}
    what = f"bank {request.path.name}" if request.progress else ""
    return map_kept(CellEntries.of(plan), items, kept, request.workers, what=what, unit="block")

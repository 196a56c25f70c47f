"""Optimised drive words of many cells: in this process, in processes of this machine, or on other machines.

A cell's words do not depend on where and with which others they are computed (`workshop/bank_builder/methods/exact.py`), so tasks
are small groups of cells, and one whose worker is lost is simply computed again by another. What is done is kept in a file beside
the bank until the bank is there: an interrupted build goes on where it was.
"""

from __future__ import annotations

import contextlib
import fcntl
import glob
import os
import struct
import threading
from collections.abc import Generator, Iterator
from dataclasses import asdict, dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits
from tqdm import tqdm

from controller.device.bank.file_format import creator
from controller.device.bank.packing import WORD
from controller.device.board.board import Board
from controller.device.kernel.crc import intact, sealed
from controller.errors import BankError, UsageError
from controller.regular_file import open_private
from controller.workshop.bank_builder.dask_client import dask_errors, open_client, results_of
from controller.workshop.bank_builder.methods.descent import CELLS_AT_ONCE, Descent, DescentAim
from controller.workshop.physics.responses.impulse_response import ResponseModel

Words = NDArray[np.uint32]

# Raised whenever the words that methods/ finds for a cell change; an optimised bank of another version is optimised again.
# tests/workshop/bank_builder/test_optimised.py has the words of this version.
METHOD_VERSION = 2
TASKS_PER_WORKER = 4  # at least, so that all end at about the same time
CELLS_OF_A_STRANGER = 8  # some seconds of work
ONE_AT_A_TIME = threading.Lock()  # in a process: the response model has one workspace, and a dask worker may have several threads
RECORD = struct.Struct("<I")  # cell; then its words; then the CRC-32 of both


@dataclass(frozen=True)
class Workers:
    """Who optimises."""

    processes: int = 1  # on this machine; 1: the calling process itself
    # of a dask scheduler, whose workers have this package in the same version; takes the place of `processes`
    address: str | None = None


ALONE = Workers()


@dataclass(frozen=True)
class Task:
    """A group of cells, and all that determines their words."""

    board: Board
    highest_hz: float
    aim: DescentAim
    points_m: tuple[tuple[float, float], ...]  # each (x_m, y_m)
    maker: str  # `creator()` of who asks: a worker of another version would compute other words


def reported(board: Board, aim: DescentAim) -> dict[str, Any]:
    """What determines the words besides the board's physics and the cell, for a bank: aim, limit, version of the method."""
    return {**asdict(aim), "max_edge_rate_hz": board.limits.max_edge_rate_hz, "method": METHOD_VERSION}


def compute(task: Task) -> Words:
    """Drive words of a task's cells: (cell, sample)."""
    if task.maker != creator():
        raise BankError(f"a worker has another version than asked for: {creator()}, not {task.maker}: install the same on all")
    with ONE_AT_A_TIME, threadpool_limits(1, "blas"):
        return _method(task.board, task.highest_hz, task.aim).entries(task.points_m)


@lru_cache(maxsize=1)
def _method(board: Board, highest_hz: float, aim: DescentAim) -> Descent:
    return Descent(board, ResponseModel(board, highest_hz), aim)


def kept_path(bank: Path, inputs_sha256: str) -> Path:
    """File that keeps what is done of the bank at `bank`, by the hash of all that determines it."""
    return bank.with_name(f".{bank.name}.{inputs_sha256[:16]}.words")


def remove_kept(bank: Path) -> None:
    """Remove what is kept of any build of the bank at `bank`."""
    for file in bank.parent.glob(f".{glob.escape(bank.name)}.*.words"):
        file.unlink(missing_ok=True)


def optimised_words(whole: Task, cells: NDArray[np.intp], kept: Path, workers: Workers, *, progress: bool = False) -> Words:
    """Optimise the entries of cells, the same bits whoever does it.

    `whole` has all cells as one, `cells` (cell,) are their numbers. What the file `kept` holds is not computed again: the caller
    names it by all that determines the words, and removes it when they are safe. With `progress`, a bar shows the time left on
    stderr if that is a terminal. Returns (cell, sample). Raises BankError if the scheduler is not found, a worker has another
    version, or what is done cannot be kept.
    """
    words: Words = np.zeros((len(cells), whole.board.waveform.samples), WORD)
    with _Kept.open(kept, words.shape[1]) as done:
        missing = []
        for index, cell in enumerate(cells.tolist()):
            if cell in done.words:
                words[index] = done.words[cell]
            else:
                missing.append(index)
        groups = _groups(missing, workers)
        tasks = [replace(whole, points_m=tuple(whole.points_m[index] for index in group)) for group in groups]
        bar = tqdm(
            total=len(cells),
            initial=len(cells) - len(missing),
            unit="cell",
            desc=f"optimised, {whole.aim.name}",
            disable=None if progress else True,
        )
        with bar, contextlib.closing(_computed(tasks, workers)) as results:
            for number, result in results:
                for index, row in zip(groups[number], result, strict=True):
                    words[index] = row
                    done.add(int(cells[index]), row)
                done.flush()
                bar.update(len(result))
    return words


def _groups(indices: list[int], workers: Workers) -> list[list[int]]:
    """Groups of cells, each a task: large enough for fast products, and several for each worker."""
    if workers.address:  # who knows how many there are
        size = CELLS_OF_A_STRANGER
    else:
        size = max(1, min(CELLS_AT_ONCE, -(-len(indices) // (TASKS_PER_WORKER * workers.processes))))
    return [indices[first : first + size] for first in range(0, len(indices), size)]


def _computed(tasks: list[Task], workers: Workers) -> Generator[tuple[int, Words]]:
    """Number of each task and its result, as they come."""
    if not tasks:
        return
    if workers.address is None and workers.processes == 1:
        yield from enumerate(map(compute, tasks))
        return
    with contextlib.ExitStack() as stack:
        where = f"--dask {workers.address}" if workers.address else f"--workers {workers.processes}"
        with dask_errors(where):
            client = stack.enter_context(open_client(workers.address, workers.processes))
            number_of = {future: number for number, future in enumerate(client.map(compute, tasks, pure=False))}
            results = results_of(number_of)
        while True:
            with dask_errors(where):  # of dask, not of who takes the results
                found = next(results, None)
            if found is None:
                return
            yield found


class _Kept:
    """The file of entries that are done: records of cell, words and CRC-32, of which the last may be torn."""

    def __init__(self, file: BinaryIO, samples: int) -> None:
        self._file = file
        self.words: dict[int, Words] = {}
        size = RECORD.size + WORD.itemsize * samples + 4
        whole = 0
        while len(record := file.read(size)) == size and intact(record):
            self.words[RECORD.unpack_from(record)[0]] = np.frombuffer(record, WORD, samples, RECORD.size)
            whole += size
        file.seek(whole)
        file.truncate()

    @classmethod
    @contextlib.contextmanager
    def open(cls, path: Path, samples: int) -> Iterator[_Kept]:
        try:
            with os.fdopen(open_private(path), "r+b") as file:
                try:
                    fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                except BlockingIOError:
                    raise UsageError(
                        f"{path}: another build is at work on the same bank: wait for it, or give another --out"
                    ) from None
                yield cls(file, samples)
        except OSError as error:
            raise BankError(f"{path}: cannot be written ({error.strerror})") from error

    def add(self, cell: int, words: Words) -> None:
        record = RECORD.pack(cell) + np.ascontiguousarray(words, WORD).tobytes()
        self._file.write(sealed(record))

    def flush(self) -> None:
        self._file.flush()

"""Functions of groups of items that other processes import: what `map_kept` is tested with."""

import contextlib
import dataclasses
import os
import signal
import subprocess
from itertools import islice
from pathlib import Path

import numpy as np
from tqdm import tqdm


def cubes(items):
    """The result of each item: bytes of a length of its own."""
    return [np.full(1 + item % 3, item**3, np.int64).tobytes() for item in items]


@dataclasses.dataclass(frozen=True)
class Fatal:
    """Kills whoever computes the item `at` first, as a power cut would.

    With the file of what is kept, all processes of its session too, as soon as there is something in it.
    """

    mark: str
    at: int
    kept: Path | None = None

    def __call__(self, items):
        if self.at in items:
            try:
                os.close(os.open(self.mark, os.O_CREAT | os.O_EXCL))
            except FileExistsError:
                return cubes(items)
            if self.kept:
                kill_session(self.kept)
            os.kill(os.getpid(), signal.SIGKILL)
        return cubes(items)


@dataclasses.dataclass
class Dying:
    """Ends the first worker that `gets` it, `begins` or `ends` a task, as the kernel does for want of memory."""

    mark: str
    step: str
    asks: int = dataclasses.field(default_factory=os.getpid)

    def __setstate__(self, state):
        self.__dict__ = state
        self._reached("gets")

    def _reached(self, step):
        if step == self.step and self.asks not in (os.getpid(), os.getppid()):  # nor the scheduler, which unpickles too
            with contextlib.suppress(FileExistsError):
                os.close(os.open(self.mark, os.O_CREAT | os.O_EXCL))
                os.kill(os.getpid(), signal.SIGKILL)

    def __call__(self, items):
        """As `cubes`."""
        self._reached("begins")
        found = cubes(items)
        self._reached("ends")
        return found


@dataclasses.dataclass
class OutOfTime:
    """Has SLURM end the job that computes the item `at` first, as at its time limit."""

    mark: str
    at: int

    def __call__(self, items):
        """As `cubes`."""
        if self.at in items:
            with contextlib.suppress(FileExistsError):
                os.close(os.open(self.mark, os.O_CREAT | os.O_EXCL))
                subprocess.run(["scancel", os.environ["SLURM_JOB_ID"]], check=True)
                signal.pause()
        return cubes(items)


def kill_session(kept):
    """Kill all processes of the caller's session, as a power cut would, as soon as there is something in the file `kept`."""
    while not kept.stat().st_size:
        os.sched_yield()
    for process in processes_of_session():
        os.kill(process, signal.SIGKILL)
    os.kill(os.getpid(), signal.SIGKILL)


def processes_of_session():
    """Process ids of this session, but for the caller."""
    for name in (found.name for found in Path("/proc").iterdir() if found.name.isdigit()):
        try:
            if os.getsid(int(name)) == os.getsid(0) and int(name) != os.getpid():
                yield int(name)
        except ProcessLookupError:
            continue


def greedy(items):
    """Takes 2 GB, and holds it until it is ended."""
    taken = bytearray(2_000_000_000)
    while taken:
        taken[::4096] = bytes(len(taken[::4096]))
    return cubes(items)


def endless(items):
    """Never ends the item 9; shows a bar as a bank's build does."""
    for item in tqdm(items, disable=True):
        while item == 9:
            signal.pause()
    return cubes(items)


def few_methods(laboratory):
    """One setting of each of three methods of the benchmark, in a process where all words reach one bound: it takes long."""
    from controller.workshop.benchmark import plate_under_test
    from controller.workshop.benchmark.methods import device, modal_bank

    plate_under_test.bound = lambda _unit: 1.0
    of_device, of_modes = device.candidates(laboratory), modal_bank.candidates(laboratory)
    return [*islice(of_device, 3, 4), *islice(of_modes, 4, 5), *plain_methods(laboratory)]


def plain_methods(laboratory):
    """The first of the other designs."""
    from controller.workshop.benchmark.methods import designs

    return islice(designs.candidates(laboratory), 1)

"""Transient simulations with ngspice: a netlist as text in, traces out."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from controller.arrays import Floats
from controller.errors import ControllerError
from controller.programs import CannotStart, ProgramError, last_line, run_program

LIMIT_S = 1800.0  # that a simulation may take


@dataclass(frozen=True)
class Traces:
    """What a transient simulation computed."""

    time_s: Floats  # (n,)
    values: dict[str, Floats]  # (n,) array in V or A for each saved vector, by the name it was asked for

    def __getitem__(self, name: str) -> Floats:
        return self.values[name]

    def crossing_s(self, name: str, level: float, *, rising: bool, after_s: float = 0.0) -> float:
        """Time in s of the first crossing of a level after `after_s`, by interpolation; nan if there is none."""
        value = self.values[name]
        side = value >= level if rising else value <= level
        (found,) = np.nonzero(side[1:] & ~side[:-1] & (self.time_s[1:] > after_s))
        if not found.size:
            return float("nan")
        before, after = found[0], found[0] + 1
        share = (level - value[before]) / (value[after] - value[before])
        return float(self.time_s[before] + share * (self.time_s[after] - self.time_s[before]))

    def at(self, name: str, time_s: float) -> float:
        """Value of a vector at a time in s, by interpolation."""
        return float(np.interp(time_s, self.time_s, self.values[name]))

    def between(self, begin_s: float, end_s: float) -> Traces:
        """Part of the traces, both times in s."""
        part = (self.time_s >= begin_s) & (self.time_s <= end_s)
        return Traces(self.time_s[part], {name: value[part] for name, value in self.values.items()})

    def integral(self, values: Floats) -> float:
        """Integral over the time of these traces of values, one for each of their samples: V or A times s."""
        return float(np.trapezoid(values, self.time_s))


def transient(netlist: str, vectors: Sequence[str], step_s: float, end_s: float) -> Traces:
    """Simulate a netlist from its operating point.

    `netlist` is without its title, analysis and end; `vectors` are such as ``v(out)`` and ``i(v1)``; `step_s` is the longest step.
    Raises ControllerError if there is no ngspice, or it could not simulate this.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        saved = " ".join(vectors)
        text = f"* haptic-panel\n{netlist}\n.save {saved}\n.tran {step_s:g} {end_s:g} 0 {step_s:g}\n.end\n"
        (folder / "deck.cir").write_text(text)
        command = ["ngspice", "-n", "-b", "-r", "traces.raw", "deck.cir"]
        try:
            done = run_program(command, LIMIT_S, package="ngspice", cwd=folder)
        except CannotStart:
            raise
        except ProgramError as error:
            raise ControllerError(f"ngspice did not simulate this: {error}") from error
        raw = folder / "traces.raw"
        try:
            time_s, values = _read(raw.read_bytes()) if raw.exists() else (np.empty(0), {})
        except ValueError as error:
            raise ControllerError(f"ngspice wrote a file that is not understood ({error})") from error
        if not time_s.size or time_s[-1] < end_s * (1 - 1e-9):
            raise ControllerError(f"ngspice did not simulate this to its end: {last_line(done.err) or last_line(done.out)}")
    return Traces(time_s, {vector: values[vector.lower()] for vector in vectors})


def _read(raw: bytes) -> tuple[Floats, dict[str, Floats]]:
    """Time and vectors of a binary raw file: a header as text, then one row of doubles for each time."""
    head, _, rows = raw.partition(b"Binary:\n")
    text = head.decode()
    names = re.findall(r"^\t\d+\t(\S+)\t", text, re.MULTILINE)
    (points,) = map(int, re.findall(r"No\. Points: (\d+)", text))
    table = np.frombuffer(rows, np.float64, points * len(names)).reshape(points, len(names))
    return table[:, 0].copy(), {name: table[:, column].copy() for column, name in enumerate(names)}

"""A row of `haptic-panel benchmark paper`: what the paper says, what the simulation gives, and why they differ."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

SPREAD = (0.05, 0.5, 0.95)
TRIAL = "* not the paper's: of an earlier simulation of its panel, made apart from this one"


@dataclass(frozen=True)
class Row:
    """One figure of the paper beside ours."""

    key: str  # for tests and programs
    quantity: str  # what it is, with its unit
    paper: float | None  # what the paper says; None if it says nothing
    here: tuple[float, float, float]  # (p5, median, p95): over the foci; three times the same for what has no spread
    why: str  # why they differ, or what is computed where the paper is garbled
    trial: bool = False  # whether `paper` is not the paper's, but of an earlier simulation, independent of this one

    @classmethod
    def of(cls, key: str, quantity: str, paper: float | None, here: ArrayLike, why: str, *, trial: bool = False) -> Row:
        """Row of all values found, (n,), or of a single one."""
        low, median, high = np.quantile(np.asarray(here, np.float64).ravel(), SPREAD).tolist()
        return cls(key, quantity, paper, (low, median, high), why, trial)

    @property
    def median(self) -> float:
        """The middle of what was found."""
        return self.here[1]

    def figures(self) -> dict[str, Any]:
        """Plain values for JSON."""
        low, median, high = self.here
        ratio = median / self.paper if self.paper else None
        return {
            "key": self.key,
            "quantity": self.quantity,
            "paper": self.paper,
            "trial": self.trial,
            "here": {"median": median, "p5": low, "p95": high},
            "ratio": ratio,
            "why": self.why,
        }


def paper_table(figures: dict[str, Any]) -> str:
    """The rows as a table of text, the sentence why below each."""
    reported, fitted = figures["environment"], figures["fitted"]
    lines = [
        f"{figures['board']}: {figures['foci']} foci, seed {figures['seed']}, {figures['modes']} modes; {reported['processor']}, "
        f"commit {reported['commit']}",
        f"fitted: {fitted['name']} = {fitted['value']:g}, {fitted['why']}",
        "the paper's own: plate, driver, waveform; it does not give the places of its discs",
        "",
        f"{'quantity':<66}{'paper':>9}{'here':>9}{'5 %':>9}{'95 %':>9}{'ratio':>9}",
    ]
    for row in figures["rows"]:
        here = row["here"]
        spread = [here["p5"], here["p95"]] if here["p5"] != here["p95"] else [None, None]
        shown = "".join(f"{_number(value):>9}" for value in (here["median"], *spread, row["ratio"]))
        lines += [f"{row['quantity']:<66}{_paper(row):>9}{shown}", f"    {row['why']}"]
    lines += ["", TRIAL]
    return "\n".join(lines)


def markdown(figures: dict[str, Any]) -> str:
    """The rows as the README's table."""
    lines = ["| quantity | paper | here (5–95 %) | ratio | why |", "|---|---|---|---|---|"]
    for row in figures["rows"]:
        here = row["here"]
        spread = "" if here["p5"] == here["p95"] else f" ({_number(here['p5'])}–{_number(here['p95'])})"
        shown = f"{_number(here['median'])}{spread}"
        lines.append(f"| {row['quantity']} | {_paper(row)} | {shown} | {_number(row['ratio'])} | {row['why']} |")
    return "\n".join([*lines, "", TRIAL])


def _paper(row: dict[str, Any]) -> str:
    return _number(row["paper"]) + ("*" if row["trial"] else "")


def _number(value: float | None) -> str:
    if value is None:
        return ""
    return f"{value:,.0f}" if abs(value) >= 1000 else f"{value:.3g}"

"""A row of `haptic-panel benchmark paper`: what the paper says, what the simulation gives, and why they differ."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

SPREAD = (0.05, 0.5, 0.95)
TRIAL = "* not the paper's: of an earlier simulation of its panel, made apart from this one"
TABLE: Final[dict[str, dict[str, Any]]] = tomllib.loads(Path(__file__).with_name("paper_rows.toml").read_text(encoding="utf-8"))


@dataclass(frozen=True)
class Row:
    """One figure of the paper beside ours."""

    key: str  # of paper_rows.toml
    here: tuple[float, float, float]  # (p5, median, p95): over the foci; three times the same for what has no spread
    paper: float | None  # what the paper says; None if it says nothing

    @property
    def median(self) -> float:
        """The middle of what was found."""
        return self.here[1]

    def figures(self) -> dict[str, Any]:
        """Plain values for JSON."""
        low, median, high = self.here
        about = TABLE[self.key]
        return {
            "key": self.key,
            "quantity": about["quantity"],
            "paper": self.paper,
            "trial": "trial" in about,
            "here": {"median": median, "p5": low, "p95": high},
            "ratio": median / self.paper if self.paper else None,
            "why": about["why"],
        }


def rows(here: Mapping[str, ArrayLike], expected: Mapping[str, float] | None = None) -> list[Row]:
    """Rows of what was found, by their keys in paper_rows.toml: all values, or a single one.

    `expected` are numbers of the paper that are computed.
    """
    found = []
    for key, values in here.items():
        low, median, high = np.quantile(np.asarray(values, np.float64).ravel(), SPREAD).tolist()
        about = TABLE[key]
        found.append(Row(key, (low, median, high), (expected or {}).get(key, about.get("paper", about.get("trial")))))
    return found


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

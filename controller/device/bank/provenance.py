"""Where the responses of a bank come from, as its header tells it: the build parameter `responses`."""

from __future__ import annotations

import math
from pathlib import PurePosixPath
from typing import Any, Literal, Self

import msgspec

from controller.device.board.digest import sha256

# Of the plate model (physics/) and of what is kept of it, by any way of making words. Raised whenever a response that it computes
# changes by more than rounding; a bank of another version is built again. tests/workshop/physics/test_model_version.py compares
# responses with those of this version. 2: what a slope takes is kept; 3: for each 2 samples; 4: lifted
MODEL_VERSION = 4
MOST_FILES = 8  # of a folder and a kind that a header names one by one
MEASURE_AGAIN = "haptic-panel calibrate bank FOLDER"  # what builds a bank from measurements


class SourceFile(msgspec.Struct, frozen=True):
    """A file that responses were learned from: its name and the SHA-256 of its bytes, in hex."""

    name: str
    sha256: str


class Provenance(msgspec.Struct, frozen=True, omit_defaults=True):
    """Origin of responses, kept in a bank's header."""

    # `modelled`, `measured`, or `completed`: measured, with gaps filled by a model
    kind: Literal["modelled", "measured", "completed"]
    model: str  # plate model in words: theory, edges, damping; of measured responses, what interpolates between points
    files: tuple[SourceFile, ...] = ()  # measurements
    date: str | None = None  # of the measurements, ISO 8601
    temperature_c: float | None = None  # of the plate while it was measured
    points: int | None = None  # number of points that were measured
    # Expected share of the amplitude that drive words from these responses keep on the plate they come from: (median, least)
    # over points left out. Absent for models, which say nothing about a plate
    kept: tuple[float, float] | None = None
    # Logarithm of the amplitude at points left out over that which the others foresee there: (mean, standard deviation)
    foreseen: tuple[float, float] | None = None
    panel: str | None = None  # `panel_identity` of the panel that was measured; None: it is not known which one

    @property
    def from_measurements(self) -> bool:
        """Whether a real plate was measured: such responses cannot be computed again without the measurements."""
        return self.kind != "modelled"

    @property
    def foresees(self) -> bool:
        """Whether it says how well measured points foresee each other."""
        return self.foreseen is not None and all(map(math.isfinite, self.foreseen))

    def condensed(self) -> Self:
        """The same with one entry for many files of a folder and a kind: `records/*.npy (250 files)`, by the hash of their hashes.

        A header has no room for a file for each of thousands of points.
        """
        kinds: dict[PurePosixPath, list[SourceFile]] = {}
        for file in self.files:
            path = PurePosixPath(file.name)
            kinds.setdefault(path.parent / f"*{path.suffix}", []).append(file)
        found: list[SourceFile] = []
        for pattern, files in kinds.items():
            if len(files) <= MOST_FILES:
                found += files
            else:
                every = "".join(f"{file.sha256}  {file.name}\n" for file in files)  # as sha256sum prints them
                found.append(SourceFile(f"{pattern} ({len(files)} files)", sha256(every.encode()).hex()))
        return msgspec.structs.replace(self, files=tuple(found))

    def in_words(self) -> str:
        """One line for people."""
        if not self.from_measurements:
            return f"modelled: {self.model}"
        files = self.condensed().files
        several = [
            f"{self.points} points" if self.points is not None else "",
            ", ".join(file.name for file in files[:4]) + (f" and {len(files) - 4} more" if len(files) > 4 else ""),
            self.date or "",
            f"{self.temperature_c:g} °C" if self.temperature_c is not None else "",
            self.model,
            f"keeps {self.kept[0]:.3g} of the amplitude, {self.kept[1]:.3g} at least" if self.kept else "",
        ]
        return f"{self.kind}: {'; '.join(part for part in several if part)}"


def provenance_of(reported: object) -> Provenance | None:
    """What the build parameter `responses` of a bank tells; None if it tells nothing that is understood.

    Banks from before there were others tell `"modelled"`.
    """
    if reported == "modelled":
        return Provenance("modelled", "a simply supported plate, Kirchhoff's theory")
    try:
        return msgspec.convert(reported, Provenance)
    except msgspec.ValidationError:
        return None


def as_parameter(provenance: Provenance) -> dict[str, Any]:
    """The build parameter of a bank."""
    reported: dict[str, Any] = msgspec.to_builtins(provenance.condensed())
    return reported


def why_unknown(provenance: Provenance | None, panel: str | None) -> str:
    """Why a bank may be of another plate; empty: it is of this one."""
    if provenance is None:
        return "the bank does not say where its responses come from"
    if not provenance.from_measurements:
        return "the bank comes from a model, not from this plate"
    if not provenance.foresees:
        return f"the bank does not say how well its measurements foresee each other: {MEASURE_AGAIN} of the same folder does"
    if provenance.panel is None:
        this_one = "" if panel is None else f' (if it is this one, panel = "{panel}")'
        return f"the measurement does not say which panel it is of: set panel in its measurement.toml{this_one}, {MEASURE_AGAIN}"
    if panel is None:
        return "this computer has no machine-id, by which the bank could be known as measured on it"
    if provenance.panel != panel:
        return f"the bank was measured on another panel ({provenance.panel}, not {panel})"
    return ""

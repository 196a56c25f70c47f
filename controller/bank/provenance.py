"""Where the responses of a bank come from, as its header tells it: the build parameter `responses`."""

from __future__ import annotations

from typing import Any, Literal

import msgspec

MEASURE_AGAIN = "haptic-panel calibrate bank FOLDER"  # what builds a bank from measurements


class SourceFile(msgspec.Struct, frozen=True):
    """A file that responses were learned from: its name and the SHA-256 of its bytes, in hex."""

    name: str
    sha256: str


class Provenance(msgspec.Struct, frozen=True, omit_defaults=True):
    """Origin of responses, kept in a bank's header.

    Attributes
    ----------
    kind
        `modelled`, `measured`, or `completed`: measured, with gaps filled by a model.
    model
        Plate model in words: theory, edges, damping; of measured responses, what interpolates between points.
    files
        Measurements.
    date
        Of the measurements, ISO 8601.
    temperature_c
        Of the plate while it was measured.
    points
        Number of points that were measured.
    kept
        Expected share of the amplitude that drive words from these responses keep on the plate they come from: (median, least)
        over points left out. Absent for models, which say nothing about a plate.
    """

    kind: Literal["modelled", "measured", "completed"]
    model: str
    files: tuple[SourceFile, ...] = ()
    date: str | None = None
    temperature_c: float | None = None
    points: int | None = None
    kept: tuple[float, float] | None = None

    @property
    def from_measurements(self) -> bool:
        """Whether a real plate was measured: such responses cannot be computed again without the measurements."""
        return self.kind != "modelled"

    def in_words(self) -> str:
        """One line for people."""
        if not self.from_measurements:
            return f"modelled: {self.model}"
        several = [
            f"{self.points} points" if self.points is not None else "",
            ", ".join(file.name for file in self.files[:3]) + (f" and {len(self.files) - 3} more" if len(self.files) > 3 else ""),
            self.date or "",
            f"{self.temperature_c:g} °C" if self.temperature_c is not None else "",
            self.model,
            f"keeps {self.kept[0]:.3g} of the amplitude, {self.kept[1]:.3g} at least" if self.kept else "",
        ]
        return f"{self.kind}: {'; '.join(part for part in several if part)}"


def provenance_of(told: object) -> Provenance | None:
    """What the build parameter `responses` of a bank tells; None if it tells nothing that is understood.

    Banks from before there were others tell `"modelled"`.
    """
    if told == "modelled":
        return Provenance("modelled", "a simply supported plate, Kirchhoff's theory")
    try:
        return msgspec.convert(told, Provenance)
    except msgspec.ValidationError:
        return None


def as_parameter(provenance: Provenance) -> dict[str, Any]:
    """The build parameter of a bank."""
    told: dict[str, Any] = msgspec.to_builtins(provenance)
    return told

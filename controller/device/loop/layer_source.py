"""Interface between the event loop and what prepares clients' layers of regions for it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

from controller.device.scene.layers import Placement, RefusedRegion
from controller.device.scene.region_lookup import RegionLookup
from controller.device.scene.scene import Region


class AcceptedLayer(NamedTuple):
    """A layer that was checked.

    Attributes
    ----------
    lookup : RegionLookup
        Of these regions.
    off_plate : int
        How many of them lie off the plate as a whole.
    refused : tuple of RefusedRegion
        Regions that are not among them: the first of all `refused_count`.
    """

    regions: tuple[Region, ...]
    lookup: RegionLookup
    off_plate: int
    refused: tuple[RefusedRegion, ...]
    refused_count: int


@dataclass(frozen=True, slots=True)
class LayerResult:
    """What became of a client's regions.

    Attributes
    ----------
    age_s : float
        Since they were sent.
    accepted : AcceptedLayer or None
        In force; None: refused as a whole, or replaced.
    reason : str
        Why they were refused; empty: a newer layer of the same client has replaced this one before it was prepared.
    """

    age_s: float
    accepted: AcceptedLayer | None = None
    reason: str = ""


class LayerPreparation(Protocol):
    """Prepares one layer at a time in another process."""

    def begin(self, line: bytes, placement: Placement) -> None:
        """Begin to prepare a layer.

        Parameters
        ----------
        line : bytes
            The client's line.
        placement : Placement
            Where the layer will lie.
        """

    def fileno(self) -> int | None:
        """File that becomes readable when it is done; None while nothing is being prepared."""

    def take(self) -> AcceptedLayer | str | None:
        """Take what was prepared, or why it was refused, once for each `begin`; None while it is not done."""

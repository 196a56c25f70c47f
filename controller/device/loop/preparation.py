"""Interfaces between the event loop and what prepares scenes, and clients' layers of regions, for it in other processes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

from controller.device.bank.expectation import Expectation
from controller.device.scene.layers import Placement, RefusedRegion
from controller.device.scene.region_lookup import RegionLookup
from controller.device.scene.scene import Region, Scene
from controller.device.waveforms.selection import Selection


@dataclass(frozen=True, slots=True)
class PreparedScene:
    """A scene that was prepared, or why it was refused."""

    ticket: int  # of the command that asked for it; 0: SIGHUP
    scene: Scene | None  # None: refused
    selection: Selection | None = None  # of another bank, if that was replaced
    reason: str = ""  # why it was refused; empty if it was not
    expected: Expectation | None = None  # of that bank
    saves: bool = False  # it was to be saved only: the scene in force stays


class SceneChange(Protocol):
    """Prepares another scene in another process."""

    @property
    def name(self) -> str:
        """Name of the scene in force."""

    def begin(self, name: str | None, ticket: int) -> None:
        """Begin to prepare the scene of this name; None: the present one, read again; raises ControllerError if it cannot begin."""

    def save(self, name: str, toml: str, ticket: int) -> None:
        """Begin to save a scene under a name; raises ControllerError if it cannot begin."""

    def fileno(self) -> int | None:
        """File that becomes readable when it is done; None while nothing is being prepared."""

    def take(self) -> PreparedScene | None:
        """Take what was prepared; None while it is not done."""


class AcceptedLayer(NamedTuple):
    """A layer that was checked."""

    regions: tuple[Region, ...]
    lookup: RegionLookup  # of these regions
    off_plate: int  # how many of them lie off the plate as a whole
    refused: tuple[RefusedRegion, ...]  # regions that are not among them: the first of all `refused_count`
    refused_count: int


@dataclass(frozen=True, slots=True)
class LayerResult:
    """What became of a client's regions."""

    age_s: float  # since they were sent
    accepted: AcceptedLayer | None = None  # in force; None: refused as a whole, or replaced
    reason: str = ""  # why they were refused; empty: a newer layer of the same client has replaced this one before it was prepared


class LayerPreparation(Protocol):
    """Prepares one layer at a time in another process."""

    def begin(self, line: bytes, placement: Placement) -> None:
        """Begin to prepare a layer of a client's line, which will lie at a placement."""

    def fileno(self) -> int | None:
        """File that becomes readable when it is done; None while nothing is being prepared."""

    def take(self) -> AcceptedLayer | str | None:
        """Take what was prepared, or why it was refused, once for each `begin`; None while it is not done."""

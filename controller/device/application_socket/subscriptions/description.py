"""The panel described: plate, patches, axes, scene, effects, limits, versions, and the last faults."""

from __future__ import annotations

from collections import deque
from typing import Any, Final

from controller import __version__
from controller.device.application_socket.connections.clients import Clients
from controller.device.application_socket.counters import SocketCounters
from controller.device.application_socket.protocol.client_messages import LINE_BYTES, Id
from controller.device.application_socket.protocol.panel_messages import (
    PROTOCOL,
    Axes,
    ClientCounts,
    ClientLimits,
    Description,
    FaultNotice,
    PatchPlace,
    SceneRegion,
)
from controller.device.board.board import Board
from controller.device.board.devices import ApplicationSocket
from controller.device.board.lookup import running_release
from controller.device.board.panel_state import Condition, PanelState
from controller.device.loop.control import PanelControl
from controller.device.scene.scene import Region, Scene
from controller.device.scene.scene_file import Shape
from controller.device.scene.shapes import Circle, Rectangle

MOST_REGIONS: Final = 200  # of a scene that are described; the others are counted
MOST_FAULTS: Final = 50
FAULTS: Final = frozenset({PanelState.FAULTED, PanelState.NO_PERMIT, PanelState.WAITING_FOR_FPGA})
OCCASIONS: Final = ("press", "release", "enter", "leave")


class Faults:
    """The last faults, the oldest first."""

    def __init__(self) -> None:
        self.last: deque[FaultNotice] = deque(maxlen=MOST_FAULTS)
        self._before = Condition(PanelState.DISARMED)

    def changed(self, condition: Condition, now_s: float) -> FaultNotice | None:
        """The fault that a new condition is; None if it is none, or no other than before."""
        before, self._before = self._before, condition
        if condition.state not in FAULTS or not condition.cause:
            return None
        if (condition.state, condition.cause) == (before.state, before.cause):
            return None
        fault = FaultNotice(time_s=now_s, state=condition.state.value, cause=condition.cause)
        self.last.append(fault)
        return fault


class Describer:
    """Describes one panel, with what clients may ask for and its faults so far."""

    def __init__(
        self, board: Board, settings: ApplicationSocket, faults: Faults, clients: Clients, counters: SocketCounters
    ) -> None:
        self._board = board
        release = running_release()
        self._release = "" if release is None else release.name
        self._faults = faults
        self._clients = clients
        self._counters = counters
        self._patches = tuple(PatchPlace(a.channel, a.x_mm, a.y_mm, a.size_mm) for a in board.actuators)
        self._axes = Axes(board.touch.x_mm_from_axes, board.touch.y_mm_from_axes)
        self._limits = ClientLimits(
            max_amplitude=settings.max_amplitude,
            line_bytes=LINE_BYTES,
            commands_per_s=settings.commands_per_s,
            burst=settings.burst,
            layer_regions=settings.layer_regions,
            layer_bytes=settings.layer_bytes,
            layers_per_s=settings.layers_per_s,
        )
        self._scene: Scene | None = None  # of which `_regions` are
        self._regions: tuple[SceneRegion, ...] = ()

    def describe(self, number: Id, control: PanelControl) -> Description:
        """The answer to the request with id `number`, or with None a notification."""
        name, scene = control.scene()
        if scene is not self._scene:
            self._scene = scene
            self._regions = tuple([_described(region) for region in scene.regions[:MOST_REGIONS]])
        return Description(
            id=number,
            protocol=PROTOCOL,
            version=__version__,
            release=self._release,
            board=self._board.name,
            board_digest=self._board.digest().hex(),
            length_mm=self._board.plate.length_mm,
            width_mm=self._board.plate.width_mm,
            emission_ms=round(self._board.waveform.duration_s * 1e3, 6),
            patches=self._patches,
            axes=self._axes,
            scene=name,
            regions=self._regions,
            region_count=len(scene.regions),
            effects=tuple(scene.effects),
            limits=self._limits,
            faults=tuple(self._faults.last),
            clients=ClientCounts(self._clients.connected, self._counters.clients_accepted),
        )


def _described(region: Region) -> SceneRegion:
    felt = [occasion for occasion in OCCASIONS if getattr(region, occasion)]
    more = [name for name, there in (("move", region.spacings), ("always", region.emitter)) if there]
    return SceneRegion(region.name, _shape(region.shape), (*felt, *more))


def _shape(shape: Shape) -> dict[str, Any]:
    """A shape with the keys that it has in a scene.toml."""
    if isinstance(shape, Rectangle):
        place = {"x_mm": shape.x_low, "y_mm": shape.y_low}
        sides = {"width_mm": shape.x_high - shape.x_low, "height_mm": shape.y_high - shape.y_low}
        return {"shape": "rectangle"} | {key: _mm(length_m) for key, length_m in (place | sides).items()}
    if isinstance(shape, Circle):
        return {"shape": "circle", "x_mm": _mm(shape.x_m), "y_mm": _mm(shape.y_m), "radius_mm": _mm(shape.radius_m)}
    return {"shape": "polygon", "corners_mm": [[_mm(x_m), _mm(y_m)] for x_m, y_m in shape.corners]}


def _mm(length_m: float) -> float:
    return round(length_m * 1e3, 6)

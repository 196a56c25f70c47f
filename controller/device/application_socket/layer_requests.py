"""A client's regions: whether it may send them now, handed to the loop, and answered."""

from __future__ import annotations

from controller.device.application_socket.connection import Connection
from controller.device.application_socket.messages import Id, LayerAnswer, MoveRegions, Regions, Transform
from controller.device.board.devices import ApplicationSocket
from controller.device.loop.commands import PanelControl
from controller.device.loop.layer_source import AcceptedLayer
from controller.device.scene.layers import Placement


class LayerRequests:
    """Limits of `regions`, and what is handed to the loop.

    Parameters
    ----------
    settings : ApplicationSocket
        Its `layer_regions` and `layers_per_s`.
    """

    def __init__(self, settings: ApplicationSocket) -> None:
        self._settings = settings

    def why_not(self, client: Connection, request: Regions, now_s: float) -> str:
        """Why a client's regions are refused as a whole, before they are checked; empty: they are not."""
        count, most = len(request.regions), self._settings.layer_regions
        if count > most:
            return f"regions: {count} of them, a client may have {most}"
        return "" if client.layer_rate.take(now_s) else "rate"

    def put(self, client: Connection, ticket: int, request: Regions, line: memoryview, now_s: float, control: PanelControl) -> None:
        """Hand a client's regions to the loop.

        Raises
        ------
        ControllerError
            If this panel takes none.
        """
        control.put_layer(
            ticket, client.serial, bytes(line), None if request.transform is None else placement(request.transform), now_s
        )
        client.layered = True


def layer_answer(number: Id, layer: AcceptedLayer, age_s: float) -> LayerAnswer:
    """Answer to the request with id `number`: its layer is in force."""
    return LayerAnswer(
        id=number,
        regions=len(layer.regions),
        off_plate=layer.off_plate,
        age_ms=round(age_s * 1e3, 3),
        refused=layer.refused,
        refused_count=layer.refused_count,
    )


def placement(transform: Transform | MoveRegions) -> Placement:
    """What a client says of a place, in m."""
    return Placement(transform.x_mm * 1e-3, transform.y_mm * 1e-3, transform.scale)

"""A client's regions: whether it may send them now, and what is handed to the loop."""

from __future__ import annotations

from controller.device.application_socket.connections.connection import Connection
from controller.device.application_socket.protocol.client_messages import MoveRegions, Regions, Transform
from controller.device.application_socket.requests.answers import Answers
from controller.device.board.devices import ApplicationSocket
from controller.device.loop.control import PanelControl
from controller.device.scene.layers import Placement
from controller.errors import ControllerError


class LayerRequests:
    """Takes the layers of one panel's clients."""

    def __init__(self, settings: ApplicationSocket, answers: Answers) -> None:
        self._most_regions = settings.layer_regions
        self._answers = answers

    def put(self, client: Connection, request: Regions, line: memoryview, now_s: float, control: PanelControl) -> None:
        """Hand a client's regions to the loop, unless they are too many or come too soon."""
        count, most = len(request.regions), self._most_regions
        if count > most:
            self._answers.answer(client, request.id, "refused", f"regions: {count} of them, a client may have {most}")
            return
        if not client.layer_rate.take(now_s):
            self._answers.answer(client, request.id, "refused", "rate")
            return
        where = None if request.transform is None else _placement(request.transform)
        client.layered |= self._answers.begin(
            client, request.id, lambda ticket: control.put_layer(ticket, client.serial, bytes(line), where, now_s)
        )

    def move(self, client: Connection, request: MoveRegions, control: PanelControl) -> None:
        """Move a client's regions."""
        try:
            control.move_layer(client.serial, _placement(request))
        except ControllerError as error:
            self._answers.answer(client, request.id, "refused", str(error))
        else:
            self._answers.answer(client, request.id, "done")


def _placement(transform: Transform | MoveRegions) -> Placement:
    """What a client says of a place, in m."""
    return Placement(transform.x_mm * 1e-3, transform.y_mm * 1e-3, transform.scale)

"""What operators ask of the panel, and the one order that every client may give: off."""

from __future__ import annotations

from controller.device.application_socket.connections.connection import Connection
from controller.device.application_socket.connections.peers import Rights
from controller.device.application_socket.protocol.client_messages import (
    Arm,
    ChannelTest,
    Disarm,
    LoadScene,
    SaveScene,
    Stop,
    WriteTrace,
)
from controller.device.application_socket.requests.answers import Answers
from controller.device.application_socket.switched_off import SwitchedOff
from controller.device.board.board import Board
from controller.device.loop.control import PanelControl
from controller.errors import ControllerError
from controller.log import Event, log

OperatorRequest = LoadScene | SaveScene | ChannelTest | WriteTrace


class OperatorRequests:
    """Carries out the orders to one panel."""

    def __init__(self, board: Board, rights: Rights, answers: Answers, switched_off: SwitchedOff) -> None:
        self._board = board
        self._rights = rights
        self._answers = answers
        self._switched_off = switched_off

    def switch(self, client: Connection, request: Arm | Disarm | Stop, control: PanelControl) -> None:
        """Arm the panel or switch it off."""
        on, who = isinstance(request, Arm), self._who(client, request)
        control.switch(on=on, by=who)  # before anything that could take time
        changed = self._switched_off.remember("" if on else who)
        if changed or "operate" in client.rights:  # not each line of whoever asks to stop again and again
            did = "arms" if on else "disarms" if isinstance(request, Disarm) else "stops"
            log(f"{who} {did} the panel", Event.OPERATED)
        self._answers.answer(client, request.id, "done")

    def switch_off(self, client: Connection, request: Stop, control: PanelControl) -> None:
        """Carry out a request to stop before its turn, in which it will be answered."""
        who = self._who(client, request)
        control.switch(on=False, by=who)
        if self._switched_off.remember(who):
            log(f"{who} stops the panel", Event.OPERATED)

    def carry_out(self, client: Connection, request: OperatorRequest, now_s: float, control: PanelControl) -> None:
        """Carry out any other order."""
        match request:
            case LoadScene() | SaveScene():
                self._load_or_save(client, request, control)
            case ChannelTest():
                self._test_channel(client, request, now_s, control)
            case WriteTrace():
                self._write_trace(client, request, control)

    def _who(self, client: Connection, request: Arm | Disarm | Stop) -> str:
        """Who asks: the client's user as the kernel has it, and for whom it says that it does."""
        by = request.by if isinstance(request, Stop) else ""
        return self._rights.called(client.peer) + (f" for {by}" if by else "")

    def _load_or_save(self, client: Connection, request: LoadScene | SaveScene, control: PanelControl) -> None:
        if isinstance(request, SaveScene):
            name, toml, did = request.name, request.toml, "saves"
            begun = self._answers.begin(client, request.id, lambda ticket: control.save_scene(ticket, name, toml))
        else:
            name, did = request.name, "loads"
            begun = self._answers.begin(client, request.id, lambda ticket: control.load_scene(ticket, name))
        if begun:
            log(f"{self._rights.called(client.peer)} {did} the scene {name!r}", Event.OPERATED)

    def _test_channel(self, client: Connection, request: ChannelTest, now_s: float, control: PanelControl) -> None:
        channel, board = request.channel, self._board
        patch = next((actuator for actuator in board.actuators if actuator.channel == channel), None)
        if patch is None:
            self._answers.invalid(client, request.id, f"channel {channel} drives no actuator of board {board.name!r}")
            return
        x_m, y_m = patch.x_mm * 1e-3, patch.y_mm * 1e-3
        self._answers.begin(client, request.id, lambda ticket: control.test_channel(ticket, channel, x_m, y_m, now_s))

    def _write_trace(self, client: Connection, request: WriteTrace, control: PanelControl) -> None:
        try:
            control.write_trace(f"{self._rights.called(client.peer)} asked for it")
        except ControllerError as error:
            self._answers.answer(client, request.id, "refused", str(error))
        else:
            self._answers.answer(client, request.id, "done")

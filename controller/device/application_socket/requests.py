"""Clients' lines: decoded, checked, carried out through a `PanelControl`, and answered."""

from __future__ import annotations

import contextlib
from dataclasses import asdict
from typing import Any

import msgspec

from controller import __version__
from controller.device.application_socket import messages
from controller.device.application_socket.clients import Clients
from controller.device.application_socket.connection import Connection, LineTooLong, MessageTooLong
from controller.device.application_socket.counters import SocketCounters
from controller.device.application_socket.description import Describer
from controller.device.application_socket.layer_requests import LayerRequests, layer_answer, placement
from controller.device.application_socket.messages import LINE_BYTES, AnyRequest, Id, PlayRequest, Right
from controller.device.application_socket.notifications import Notifications
from controller.device.application_socket.pending_commands import PendingCommands
from controller.device.application_socket.switched_off import SwitchedOff
from controller.device.application_socket.tickets import FULL
from controller.device.board.board import Board
from controller.device.board.descriptions import type_info
from controller.device.board.devices import MIN_AMPLITUDE, ApplicationSocket
from controller.device.board.validation import NO_JSON, explain
from controller.device.loop.commands import PanelControl
from controller.device.loop.layer_source import LayerResult
from controller.errors import ControllerError
from controller.log import Event, log

FIGURES_S = 1.0  # for which the same figures are sent: collecting them takes the loop milliseconds
REASON_CHARACTERS = 200
STOP = b'"stop"'


class Requests:
    """Answers each line of each client exactly once.

    Parameters
    ----------
    board : Board
        Its plate limits where effects can be played.
    settings : ApplicationSocket
        What clients may ask for.
    notifications : Notifications
        Holds the panel's condition.
    """

    def __init__(
        self,
        board: Board,
        settings: ApplicationSocket,
        clients: Clients,
        pending: PendingCommands,
        notifications: Notifications,
        switched_off: SwitchedOff,
        counters: SocketCounters,
    ) -> None:
        self._board = board
        self._max_amplitude = settings.max_amplitude
        self._layers = LayerRequests(settings)
        self.describer = Describer(board, settings, notifications.faults, clients, counters)
        self._clients = clients
        self._pending = pending
        self._notifications = notifications
        self._switched_off = switched_off
        self._counters = counters
        self._decoder = messages.request_decoder()
        type_info(AnyRequest)  # made now: it takes a millisecond, and the first invalid line comes between two turns of the loop
        self._ids = msgspec.json.Decoder(messages.Numbered)
        self._answered: Id = None  # id of the request whose ticket was taken back
        self._figures: dict[str, Any] = {}
        self._figures_until_s = -float("inf")

    def serve(self, client: Connection, most: int, now_s: float, control: PanelControl) -> int:
        """Answer at most `most` lines of a client; returns how many there were."""
        for done in range(most):
            if client.leaving_reason:
                return done
            try:
                line = client.next_line()
            except LineTooLong as error:
                self._counters.lines += 1
                client.rate.take(now_s)
                self._refuse_invalid(client, None, str(error))
                continue
            if line is None:
                return done
            self._counters.lines += 1
            client.heard_s = now_s
            if client.rate.take(now_s, -(-(len(line) + 1) // LINE_BYTES)):
                self._answer_line(client, line, now_s, control)
                continue
            self._clients.pause(client, now_s)
            if self._stops(line):
                self._answer_line(client, line, now_s, control)
            else:
                self._counters.over_rate += 1
                self._answer(client, self._id_of(line), "refused", "rate")
        return most

    def answer_ticket(self, ticket: int, outcome: messages.Outcome, *, age_ms: float | None = None, reason: str = "") -> None:
        """Answer the command that took a ticket, and send the answer.

        Parameters
        ----------
        age_ms : float, optional
            From the command to its outcome.
        reason : str
            Of a refusal.
        """
        client = self._take_back(ticket, outcome)
        if client is not None:
            client.put(messages.Answer(id=self._answered, outcome=outcome, age_ms=age_ms, reason=reason))
            self._clients.send(client)

    def _take_back(self, ticket: int, outcome: messages.Outcome) -> Connection | None:
        """Take back a ticket; the client to answer, with the id `_answered`, or None if it has disconnected."""
        found = self._pending.give_back(ticket)
        if found is None:
            self._counters.stray_outcomes += 1
            return None
        self._counters.count(outcome)
        holder, client = found
        self._answered = holder.id
        self._counters.unanswered += client is None
        return client

    def layered(self, ticket: int, result: LayerResult) -> None:
        """Answer a command that replaces a client's regions."""
        layer = result.accepted
        if layer is None:
            self.answer_ticket(ticket, "refused" if result.reason else "merged", reason=result.reason)
            return
        client = self._take_back(ticket, "done")
        if client is not None:
            client.put(layer_answer(self._answered, layer, result.age_s))
            self._clients.send(client)

    def loaded(self, ticket: int, reason: str) -> None:
        """Answer a command to load a scene; an empty reason: the scene is in force."""
        self.answer_ticket(ticket, "refused" if reason else "done", reason=reason)

    def _answer_line(self, client: Connection, line: memoryview, now_s: float, control: PanelControl) -> None:
        try:
            request = self._decoder.decode(line)
        except UnicodeDecodeError:
            self._refuse_invalid(client, self._id_of(line), "not UTF-8")
            return
        except NO_JSON as error:
            self._refuse_invalid(client, self._id_of(line), _why_invalid(line, error)[:REASON_CHARACTERS])
            return
        if isinstance(request, messages.Regions):
            self._put_regions(client, request, line, now_s, control)
        elif len(line) >= LINE_BYTES:
            self._refuse_invalid(
                client, request.id, f"a line of kind {request.__struct_config__.tag} is at most {LINE_BYTES} bytes"
            )
        elif isinstance(request, PlayRequest):
            self._play(client, request, now_s, control)
        else:
            self._do(client, request, now_s, control)

    def _play(self, client: Connection, play: PlayRequest, now_s: float, control: PanelControl) -> None:
        if "play" not in client.rights:
            self._not_allowed(client, play.id, "play")
            return
        amplitude = self._max_amplitude if play.amplitude is None else play.amplitude
        reason = self._why_not(play, amplitude)
        if reason:
            self._refuse_invalid(client, play.id, reason)
            return
        ticket = self._ticket(client, play.id)
        if ticket == FULL:
            return
        x_m, y_m = (play.x_mm or 0.0) * 1e-3, (play.y_mm or 0.0) * 1e-3
        try:
            control.play(ticket, play.effect, x_m, y_m, play.finger, amplitude, now_s)
        except ControllerError as error:
            self.answer_ticket(ticket, "refused", reason=str(error))

    def _put_regions(
        self, client: Connection, request: messages.Regions, line: memoryview, now_s: float, control: PanelControl
    ) -> None:
        if "regions" not in client.rights:
            self._not_allowed(client, request.id, "regions")
            return
        reason = self._layers.why_not(client, request, now_s)
        if reason:
            self._answer(client, request.id, "refused", reason)
            return
        ticket = self._ticket(client, request.id)
        if ticket == FULL:
            return
        try:
            self._layers.put(client, ticket, request, line, now_s, control)
        except ControllerError as error:
            self.answer_ticket(ticket, "refused", reason=str(error))

    def _move_regions(self, client: Connection, request: messages.MoveRegions, control: PanelControl) -> None:
        if "regions" not in client.rights:
            self._not_allowed(client, request.id, "regions")
            return
        try:
            control.move_layer(client.serial, placement(request))
        except ControllerError as error:
            self._answer(client, request.id, "refused", str(error))
        else:
            self._answer(client, request.id, "done")

    def _why_not(self, play: PlayRequest, amplitude: float) -> str:
        """What is wrong with a command to play; empty if nothing is."""
        if not MIN_AMPLITUDE <= amplitude <= self._max_amplitude:
            return f"amplitude = {amplitude:g} is not {MIN_AMPLITUDE:g} to {self._max_amplitude:g}"
        if play.finger is not None:
            return "" if play.x_mm is None and play.y_mm is None else "either x_mm and y_mm, or finger"
        if play.x_mm is None or play.y_mm is None:
            return "either x_mm and y_mm, or finger"
        plate = self._board.plate
        if not 0.0 <= play.x_mm <= plate.length_mm:
            return f"x_mm = {play.x_mm:g} is off the plate (0 to {plate.length_mm:g})"
        if not 0.0 <= play.y_mm <= plate.width_mm:
            return f"y_mm = {play.y_mm:g} is off the plate (0 to {plate.width_mm:g})"
        return ""

    def _do(self, client: Connection, request: AnyRequest, now_s: float, control: PanelControl) -> None:
        """Carry out a request other than `PlayRequest`."""
        rights = self._clients.rights
        match request:
            case messages.Arm() | messages.Disarm() | messages.LoadScene() if "operate" not in client.rights:
                self._not_allowed(client, request.id, "operate")
            case messages.Subscribe(to=to) if "touches" in to and "play" not in client.rights:
                self._not_allowed(client, request.id, "play")
            case messages.Arm() | messages.Disarm() | messages.Stop():
                on, who = isinstance(request, messages.Arm), rights.called(client.peer)
                control.switch(on=on, by=who)  # before anything that could take time
                changed = self._switched_off.remember("" if on else who)
                if changed or "operate" in client.rights:  # not each line of whoever asks to stop again and again
                    did = "arms" if on else "disarms" if isinstance(request, messages.Disarm) else "stops"
                    log(f"{who} {did} the panel", Event.OPERATED)
                self._answer(client, request.id, "done")
            case messages.MoveRegions():
                self._move_regions(client, request, control)
            case messages.AskState(id=number):
                self._reply(client, self._notifications.state(number))
            case messages.LoadScene(id=number, name=name):
                self._load_scene(client, number, name, control)
            case messages.AskFigures(id=number):
                self._reply(client, messages.FiguresAnswer(id=number, figures=self._all_figures(now_s, control)))
            case messages.Describe(id=number):
                self._reply(client, self.describer.describe(number, control))
            case messages.Hello(id=number):
                self._reply(client, self._greeting(client, number, control))
            case messages.Subscribe(to=to):
                self._clients.subscribe(client, touches=client.subscribed or "touches" in to)
                self._answer(client, request.id, "done")
                if "state" in to:
                    client.informed = True
                    client.put(self._notifications.state())
                client.warned |= "faults" in to
                if "description" in to:
                    client.described = True
                    self.describe_to(client, control)
            case messages.Unsubscribe():
                self._clients.unsubscribe(client)
                self._answer(client, request.id, "done")

    def describe_to(self, client: Connection, control: PanelControl) -> None:
        """Send a client the panel's description, unless it is too long for its buffer."""
        with contextlib.suppress(MessageTooLong):
            client.put(self.describer.describe(None, control))

    def _not_allowed(self, client: Connection, number: Id, right: Right) -> None:
        self._counters.not_allowed += 1
        self._answer(client, number, "refused", self._clients.rights.why_not(client.peer, right))

    def _load_scene(self, client: Connection, number: Id, name: str, control: PanelControl) -> None:
        ticket = self._ticket(client, number)
        if ticket == FULL:
            return
        try:
            control.load_scene(ticket, name)
        except ControllerError as error:
            self.loaded(ticket, str(error))
        else:
            log(f"{self._clients.rights.called(client.peer)} loads the scene {name!r}", Event.OPERATED)

    def _all_figures(self, now_s: float, control: PanelControl) -> dict[str, Any]:
        if now_s >= self._figures_until_s:
            self._figures, self._figures_until_s = control.figures(), now_s + FIGURES_S
        condition = self._notifications.condition
        return self._figures | {
            "state": condition.state.value,
            "cause": condition.cause,
            "temperature_c": condition.temperature_c,
            "application_socket": {"clients_connected": self._clients.connected} | asdict(self._counters),
        }

    def _greeting(self, client: Connection, number: Id, control: PanelControl) -> messages.Greeting:
        return messages.Greeting(
            id=number,
            version=__version__,
            board=self._board.name,
            length_mm=self._board.plate.length_mm,
            width_mm=self._board.plate.width_mm,
            max_amplitude=self._max_amplitude,
            effects=control.effects(),
            rights=client.rights,
        )

    def _ticket(self, client: Connection, number: Id) -> int:
        """A ticket for a command; FULL if the command was refused because too many are pending."""
        ticket = self._pending.take(client, number)
        if ticket == FULL:
            most = max(client.waiting, self._pending.of_user[client.peer.uid])
            self._answer(client, number, "refused", f"{most} commands wait for their outcome already")
        return ticket

    def _reply(self, client: Connection, message: messages.Data) -> None:
        """Answer with data; a message that is too long for the client's buffer is refused."""
        try:
            client.put(message)
        except MessageTooLong as error:
            self._answer(client, message.id, "refused", str(error))
        else:
            self._counters.count("done")

    def _refuse_invalid(self, client: Connection, number: Id, reason: str) -> None:
        self._counters.not_valid += 1
        self._answer(client, number, "refused", reason)

    def _answer(self, client: Connection, number: Id, outcome: messages.Outcome, reason: str = "") -> None:
        self._counters.count(outcome)
        client.put(messages.Answer(id=number, outcome=outcome, reason=reason))

    def _stops(self, line: memoryview) -> bool:
        """Whether a line is the one request that no rate refuses."""
        if STOP not in bytes(line):
            return False
        try:
            return isinstance(self._decoder.decode(line), messages.Stop)
        except (*NO_JSON, UnicodeDecodeError):
            return False

    def _id_of(self, line: memoryview) -> Id:
        """Id of a line that is refused; None if it has none that can be read."""
        try:
            return self._ids.decode(line).id
        except NO_JSON:
            return None


def _why_invalid(line: memoryview, error: Exception) -> str:
    """What is wrong with a line that is no request."""
    try:
        value = msgspec.json.decode(line)  # also what follows the place at which the typed decoder stopped
    except NO_JSON as malformed:
        return f"not valid JSON: {malformed}"
    return explain(str(error), value, AnyRequest) if isinstance(value, dict) else "must be a JSON object"

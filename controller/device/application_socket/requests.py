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
from controller.device.application_socket.emission_notices import EmissionNotices
from controller.device.application_socket.layer_requests import LayerRequests, layer_answer, placement
from controller.device.application_socket.messages import LINE_BYTES, AnyRequest, Clip, Id, PlayRequest, Right
from controller.device.application_socket.notifications import Notifications
from controller.device.application_socket.pending_commands import PendingCommands
from controller.device.application_socket.play_requests import CLIP_LINES, Aim, PlayRequests
from controller.device.application_socket.switched_off import SwitchedOff
from controller.device.application_socket.tickets import FULL
from controller.device.board.board import Board
from controller.device.board.descriptions import type_info
from controller.device.board.devices import ApplicationSocket
from controller.device.board.validation import NO_JSON, explain
from controller.device.loop.commands import PanelControl
from controller.device.loop.layer_source import LayerResult
from controller.device.scene import clips
from controller.errors import ConfigError, ControllerError
from controller.log import Event, log

FIGURES_S = 1.0  # for which the same figures are sent: collecting them takes the loop milliseconds
REASON_CHARACTERS = 250
STOP = b'"stop"'


class Requests:
    """Answers each line of each client exactly once.

    Parameters
    ----------
    board : Board
        What effects can be played on it, and where.
    settings : ApplicationSocket
        What clients may ask for.
    notifications : Notifications
        Holds the panel's condition.
    emissions : EmissionNotices
        Sends what is played to the clients that ask for it.
    """

    def __init__(
        self,
        board: Board,
        settings: ApplicationSocket,
        clients: Clients,
        pending: PendingCommands,
        notifications: Notifications,
        emissions: EmissionNotices,
        switched_off: SwitchedOff,
        counters: SocketCounters,
    ) -> None:
        self._board = board
        self._max_amplitude = settings.max_amplitude
        self._plays = PlayRequests(board, settings)
        self._layers = LayerRequests(settings)
        self.describer = Describer(board, settings, notifications.faults, clients, counters)
        self._clients = clients
        self._pending = pending
        self._notifications = notifications
        self._emissions = emissions
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
        """Answer a command to load or save a scene; an empty reason: the scene is in force, or saved."""
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
        elif len(line) >= LINE_BYTES and not isinstance(request, messages.LONG):
            self._refuse_invalid(
                client, request.id, f"a line of kind {request.__struct_config__.tag} is at most {LINE_BYTES} bytes"
            )
        elif isinstance(request, PlayRequest | Clip):
            self._play(client, request, now_s, control)
        else:
            self._do(client, request, now_s, control)

    def _play(self, client: Connection, request: PlayRequest | Clip, now_s: float, control: PanelControl) -> None:
        if "play" not in client.rights:
            self._not_allowed(client, request.id, "play")
            return
        if isinstance(request, Clip) and not client.rate.take(now_s, CLIP_LINES - 1):
            self._counters.over_rate += 1
            self._answer(client, request.id, "refused", "rate")
            return
        try:
            aim = self._plays.aim(client, request, control)
            effect = self._plays.effect(client, request)
        except ConfigError as error:
            self._refuse_invalid(client, request.id, str(error)[:REASON_CHARACTERS])
            return
        if aim is None:
            self._answer(client, request.id, "done")
        elif aim.fingers == ():
            self._answer(client, request.id, "skipped", f"no finger is in region {request.region!r}")
        else:
            self._start(client, request.id, effect, aim, now_s, control)

    def _start(
        self, client: Connection, number: Id, effect: str | clips.Clip, aim: Aim, now_s: float, control: PanelControl
    ) -> None:
        """Play at a point or at fingers; the outcome is that at the first of them."""
        ticket = self._ticket(client, number)
        if ticket == FULL:
            return
        try:
            for finger in aim.fingers or (None,):
                control.play(ticket, effect, aim.x_m, aim.y_m, finger, aim.amplitude, now_s)
                ticket = FULL  # nobody waits for the others
        except ControllerError as error:
            if ticket != FULL:
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

    def _do(self, client: Connection, request: AnyRequest, now_s: float, control: PanelControl) -> None:
        """Carry out a request that plays nothing and lays no regions."""
        rights = self._clients.rights
        match request:
            case _ if isinstance(request, messages.OPERATIONS) and "operate" not in client.rights:
                self._not_allowed(client, request.id, "operate")
            case messages.Subscribe(to=to) if "log" in to and "operate" not in client.rights:
                self._not_allowed(client, request.id, "operate")
            case messages.Subscribe(to=to) if {"touches", "emissions"} & set(to) and "play" not in client.rights:
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
            case messages.ChannelTest(id=number, channel=channel):
                self._test_channel(client, number, channel, now_s, control)
            case messages.WriteTrace():
                self._write_trace(client, request.id, control)
            case messages.AskState(id=number):
                self._reply(client, self._notifications.state(number))
            case messages.LoadScene() | messages.SaveScene():
                self._load_or_save(client, request, control)
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
                if "log" in to:
                    self._notifications.log_to(client)
                if "emissions" in to:
                    client.shown_emissions = True
                    self._emissions.begin(control)
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

    def _load_or_save(self, client: Connection, request: messages.LoadScene | messages.SaveScene, control: PanelControl) -> None:
        ticket = self._ticket(client, request.id)
        if ticket == FULL:
            return
        did = "saves" if isinstance(request, messages.SaveScene) else "loads"
        try:
            if isinstance(request, messages.SaveScene):
                control.save_scene(ticket, request.name, request.toml)
            else:
                control.load_scene(ticket, request.name)
        except ControllerError as error:
            self.loaded(ticket, str(error))
        else:
            log(f"{self._clients.rights.called(client.peer)} {did} the scene {request.name!r}", Event.OPERATED)

    def _test_channel(self, client: Connection, number: Id, channel: int, now_s: float, control: PanelControl) -> None:
        patch = next((actuator for actuator in self._board.actuators if actuator.channel == channel), None)
        if patch is None:
            self._refuse_invalid(client, number, f"channel {channel} drives no actuator of board {self._board.name!r}")
            return
        ticket = self._ticket(client, number)
        if ticket == FULL:
            return
        try:
            control.test_channel(ticket, channel, patch.x_mm * 1e-3, patch.y_mm * 1e-3, now_s)
        except ControllerError as error:
            self.answer_ticket(ticket, "refused", reason=str(error))

    def _write_trace(self, client: Connection, number: Id, control: PanelControl) -> None:
        try:
            control.write_trace(f"{self._clients.rights.called(client.peer)} asked for it")
        except ControllerError as error:
            self._answer(client, number, "refused", str(error))
        else:
            self._answer(client, number, "done")

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

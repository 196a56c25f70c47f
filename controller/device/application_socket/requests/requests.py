"""Clients' lines: decoded, checked against rate and rights, and handed to what carries them out."""

from __future__ import annotations

import msgspec

from controller.device.application_socket.connections.clients import Clients
from controller.device.application_socket.connections.connection import Connection, LineTooLong
from controller.device.application_socket.protocol import client_messages
from controller.device.application_socket.protocol.client_messages import LINE_BYTES, AnyRequest, Id, Right
from controller.device.application_socket.requests.answers import Answers
from controller.device.application_socket.requests.layer_requests import LayerRequests
from controller.device.application_socket.requests.operator_requests import OperatorRequests
from controller.device.application_socket.requests.play_requests import PlayRequests
from controller.device.application_socket.requests.questions import Questions
from controller.device.application_socket.requests.stop_ahead import AHEAD_BYTES, STOP, stop_ahead
from controller.device.board.descriptions import type_info
from controller.device.board.validation import NO_JSON, explain
from controller.device.loop.control import PanelControl


class Requests:
    """Answers each line of each client exactly once."""

    def __init__(
        self,
        clients: Clients,
        answers: Answers,
        plays: PlayRequests,
        layers: LayerRequests,
        operators: OperatorRequests,
        questions: Questions,
    ) -> None:
        self._clients = clients
        self._answers = answers
        self._plays = plays
        self._layers = layers
        self._operators = operators
        self._questions = questions
        self._decoder = client_messages.request_decoder()
        type_info(AnyRequest)  # made now: it takes a millisecond, and the first invalid line comes between two turns of the loop
        self._ids = msgspec.json.Decoder(client_messages.Numbered)
        self._ahead = bytearray(AHEAD_BYTES)

    def serve(self, client: Connection, most: int, now_s: float, control: PanelControl) -> int:
        """Answer at most `most` lines of a client; returns how many there were.

        A client over its rate is read slowly from then on; if it has sent a request to stop, that takes effect now.
        """
        done = self._serve_lines(client, most, now_s, control)
        if client.resume_s > now_s:
            stop = stop_ahead(self._ahead, client.peek(self._ahead), self._stop_of)
            if stop is not None:
                self._operators.switch_off(client, stop, control)
        return done

    def _serve_lines(self, client: Connection, most: int, now_s: float, control: PanelControl) -> int:
        counters = self._answers.counters
        for done in range(most):
            if client.leaving_reason:
                return done
            try:
                line = client.next_line()
            except LineTooLong as error:
                counters.lines += 1
                client.rate.take(now_s)
                self._answers.invalid(client, None, str(error))
                continue
            if line is None:
                return done
            counters.lines += 1
            client.heard_s = now_s
            if client.rate.take(now_s, -(-(len(line) + 1) // LINE_BYTES)):
                self._answer_line(client, line, now_s, control)
                continue
            self._clients.pause(client, now_s)
            if self._stop_of(line) is not None:
                self._answer_line(client, line, now_s, control)
            else:
                self._answers.over_rate(client, self._id_of(line))
        return most

    def _answer_line(self, client: Connection, line: memoryview, now_s: float, control: PanelControl) -> None:
        try:
            request = self._decoder.decode(line)
        except UnicodeDecodeError:
            self._answers.invalid(client, self._id_of(line), "not UTF-8")
            return
        except NO_JSON as error:
            self._answers.invalid(client, self._id_of(line), _why_invalid(line, error))
            return
        if len(line) >= LINE_BYTES and not isinstance(request, client_messages.LONG):
            kind = request.__struct_config__.tag
            self._answers.invalid(client, request.id, f"a line of kind {kind} is at most {LINE_BYTES} bytes")
            return
        lacking = _lacking(client, request)
        if lacking is not None:
            self._answers.not_allowed(client, request.id, lacking)
            return
        match request:
            case client_messages.Arm() | client_messages.Disarm() | client_messages.Stop():
                self._operators.switch(client, request, control)
            case client_messages.PlayRequest() | client_messages.Clip():
                self._plays.play(client, request, now_s, control)
            case client_messages.Regions():
                self._layers.put(client, request, line, now_s, control)
            case client_messages.MoveRegions():
                self._layers.move(client, request, control)
            case (
                client_messages.LoadScene()
                | client_messages.SaveScene()
                | client_messages.ChannelTest()
                | client_messages.WriteTrace()
            ):
                self._operators.carry_out(client, request, now_s, control)
            case _:
                self._questions.answer(client, request, now_s, control)

    def _stop_of(self, line: memoryview) -> client_messages.Stop | None:
        """A line that is the one request that no rate refuses."""
        if STOP not in bytes(line):
            return None
        try:
            request = self._decoder.decode(line)
        except (*NO_JSON, UnicodeDecodeError):
            return None
        return request if isinstance(request, client_messages.Stop) else None

    def _id_of(self, line: memoryview) -> Id:
        """Id of a line that is refused; None if it has none that can be read."""
        try:
            return self._ids.decode(line).id
        except NO_JSON:
            return None


def _lacking(client: Connection, request: AnyRequest) -> Right | None:
    """A right that the request needs and its client does not have."""
    if isinstance(request, client_messages.Subscribe):
        needed = [right for topic, right in client_messages.RIGHTS_TO_FOLLOW.items() if topic in request.to]
        return next((right for right in needed if right not in client.rights), None)
    right = client_messages.RIGHTS[type(request)]
    return None if right == "look" or right in client.rights else right


def _why_invalid(line: memoryview, error: Exception) -> str:
    """What is wrong with a line that is no request."""
    try:
        value = msgspec.json.decode(line)  # also what follows the place at which the typed decoder stopped
    except NO_JSON as malformed:
        return f"not valid JSON: {malformed}"
    return explain(str(error), value, AnyRequest) if isinstance(value, dict) else "must be a JSON object"

"""What clients ask for: what the panel is, its state and figures, now or at each change."""

from __future__ import annotations

import contextlib
from dataclasses import asdict
from typing import Any, Final

from controller import __version__
from controller.device.application_socket.connections.clients import Clients
from controller.device.application_socket.connections.connection import Connection, MessageTooLong
from controller.device.application_socket.protocol.client_messages import (
    AnyQuestion,
    AskFigures,
    AskState,
    Describe,
    Hello,
    Subscribe,
    Unsubscribe,
)
from controller.device.application_socket.protocol.panel_messages import FiguresAnswer, Greeting
from controller.device.application_socket.requests.answers import Answers
from controller.device.application_socket.subscriptions.description import Describer
from controller.device.application_socket.subscriptions.emission_notices import EmissionNotices
from controller.device.application_socket.subscriptions.notifications import Notifications
from controller.device.board.board import Board
from controller.device.board.devices import ApplicationSocket
from controller.device.loop.control import PanelControl

FIGURES_S: Final = 1.0  # for which the same figures are sent: collecting them takes the loop milliseconds


class Questions:
    """Answers questions of one panel's clients."""

    def __init__(
        self,
        board: Board,
        settings: ApplicationSocket,
        clients: Clients,
        answers: Answers,
        notifications: Notifications,
        emissions: EmissionNotices,
    ) -> None:
        self._board = board
        self._max_amplitude = settings.max_amplitude
        self._describer = Describer(board, settings, notifications.faults, clients, answers.counters)
        self._clients = clients
        self._answers = answers
        self._notifications = notifications
        self._emissions = emissions
        self._figures: dict[str, Any] = {}
        self._figures_until_s = -float("inf")

    def answer(self, client: Connection, request: AnyQuestion, now_s: float, control: PanelControl) -> None:
        """Answer a question."""
        match request:
            case AskState(id=number):
                self._answers.data(client, self._notifications.state(number))
            case AskFigures(id=number):
                self._answers.data(client, FiguresAnswer(id=number, figures=self._all_figures(now_s, control)))
            case Describe(id=number):
                self._answers.data(client, self._describer.describe(number, control))
            case Hello():
                self._answers.data(client, self._greeting(client, request, control))
            case Subscribe():
                self._subscribe(client, request, control)
            case Unsubscribe(id=number):
                self._clients.unsubscribe(client)
                self._answers.answer(client, number, "done")

    def describe_to(self, client: Connection, control: PanelControl) -> None:
        """Send a client the panel's description, unless it is too long for its buffer."""
        with contextlib.suppress(MessageTooLong):
            client.put(self._describer.describe(None, control))

    def _subscribe(self, client: Connection, request: Subscribe, control: PanelControl) -> None:
        to = request.to
        if "log" in to and "log" not in client.topics:
            self._notifications.log_to(client)
        self._clients.subscribe(client, to)
        self._answers.answer(client, request.id, "done")
        if "state" in to:
            client.put(self._notifications.state())
        if "contacts" in to:
            self._notifications.hear_contacts(control)
        if "emissions" in to:
            self._emissions.begin(control)
        if "description" in to:
            self.describe_to(client, control)

    def _all_figures(self, now_s: float, control: PanelControl) -> dict[str, Any]:
        if now_s >= self._figures_until_s:
            self._figures, self._figures_until_s = control.figures(), now_s + FIGURES_S
        condition = self._notifications.condition
        return self._figures | {
            "state": condition.state.value,
            "cause": condition.cause,
            "temperature_c": condition.temperature_c,
            "application_socket": {"clients_connected": self._clients.connected} | asdict(self._answers.counters),
        }

    def _greeting(self, client: Connection, request: Hello, control: PanelControl) -> Greeting:
        return Greeting(
            id=request.id,
            version=__version__,
            board=self._board.name,
            length_mm=self._board.plate.length_mm,
            width_mm=self._board.plate.width_mm,
            max_amplitude=self._max_amplitude,
            effects=control.effects(),
            rights=client.rights,
        )

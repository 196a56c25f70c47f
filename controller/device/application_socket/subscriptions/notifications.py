"""What clients are sent without a request, once subscribed: touches, and the panel's condition."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite

from controller.device.application_socket.connections.clients import Clients
from controller.device.application_socket.connections.connection import Connection
from controller.device.application_socket.protocol import client_messages, panel_messages
from controller.device.application_socket.subscriptions.description import Faults
from controller.device.board.panel_state import Condition
from controller.device.loop.control import PanelControl
from controller.device.touch.source import TouchSample
from controller.log import LAST_LINES, LOG

NO_LINES = -1  # of the log have been sent


class Notifications:
    """Sends touches and conditions to the clients that subscribed to them."""

    def __init__(self, clients: Clients) -> None:
        self.condition = Condition()  # as last reported
        self.faults = Faults()
        self._clients = clients
        self._lines_sent = NO_LINES
        self._control: PanelControl | None = None  # whose contacts are heard
        self._logged_to = False  # whether anybody has subscribed to the log

    def touches(self, samples: Sequence[TouchSample]) -> None:
        """Send the touch samples of one report, lengths in mm."""
        if not self._clients.touch_subscribers:
            return
        for client in self._clients.subscribers("touches"):
            self._send(client, samples, panel_messages.Touch)

    def hear_contacts(self, control: PanelControl) -> None:
        """Have the contacts of each report sent to those who have subscribed to them."""
        self._control = control
        control.hear(self._contacts)

    def _contacts(self, samples: Sequence[TouchSample]) -> None:
        """Send the contacts of one report, until the last client that wanted them has gone."""
        subscribers = self._clients.subscribers("contacts")
        for client in subscribers:
            self._send(client, samples, panel_messages.ContactNotice)
        if not subscribers and self._control is not None:
            self._control.hear(None)

    def _send(self, client: Connection, samples: Sequence[TouchSample], kind: type[panel_messages.Touch]) -> None:
        for finger, x_m, y_m, time_s, contact, size_m in samples:
            client.put(
                kind(
                    finger=finger,
                    x_mm=round(x_m * 1e3, 3),
                    y_mm=round(y_m * 1e3, 3),
                    time_s=time_s,
                    contact=contact,
                    size_mm=round(size_m * 1e3, 3) if isfinite(size_m) else 0.0,
                )
            )
        self._clients.send(client)

    def changed(self, condition: Condition, now_s: float) -> None:
        """Keep the panel's new condition, of host time `now_s`, and send it, and the fault if it is one."""
        self.condition = condition
        fault = self.faults.changed(condition, now_s)
        if fault is not None:
            for client in self._clients.subscribers("faults"):
                client.put(fault)
                self._clients.send(client)
        for client in self._clients.subscribers("state"):
            client.put(self.state())
            self._clients.send(client)

    def lines(self) -> None:
        """Send lines of the log to the clients that subscribed to them."""
        if not self.has_lines:
            return
        self._logged_to = False
        for client in self._clients.subscribers("log"):
            self._logged_to = True
            for line in list(LOG.last)[client.lines_sent - LOG.count :] if client.lines_sent < LOG.count else ():
                client.put(panel_messages.LogLine(time_s=line.time_s, priority=int(line.priority), text=line.text))
                self._clients.send(client)  # each at once: all of them may be more than the queue takes
            client.lines_sent = LOG.count
        self._lines_sent = LOG.count

    @property
    def has_lines(self) -> bool:
        """Whether there are lines to send: where nobody has subscribed to them, the loop is not woken for any."""
        return self._logged_to and self._lines_sent != LOG.count

    def log_to(self, client: Connection) -> None:
        """Have a new subscriber receive the last lines of the log, too."""
        client.lines_sent = max(LOG.count - LAST_LINES, 0)
        self._logged_to, self._lines_sent = True, NO_LINES

    def state(self, number: client_messages.Id = None) -> panel_messages.StateAnswer:
        """The condition as a message: the answer to the request with id `number`, or with None a notification."""
        now = self.condition
        return panel_messages.StateAnswer(
            id=number,
            state=now.state.value,
            cause=now.cause,
            outputs_on=now.outputs_on,
            panel_present=now.panel_present,
            temperature_c=now.temperature_c,
        )

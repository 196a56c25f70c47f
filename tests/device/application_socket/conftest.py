"""A panel's socket without a panel: turns of a loop on a clock of the test's own, real sockets, and a control that writes down."""

import contextlib
import json
import math
import os
import select
import shutil
import socket
import tempfile
from collections import deque
from pathlib import Path

import msgspec
import pytest

from controller.device.application_socket.command_socket import CommandSocket
from controller.device.application_socket.connections import peers
from controller.device.board.devices import ApplicationSocket
from controller.device.loop.rings.emission_ring import EmissionRing
from controller.device.scene.scene import Scene
from controller.errors import ConfigError, ControllerError
from controller.metrics import Skipped

EFFECTS = ("click", "buzz")


class WritesDown:
    """A `PanelControl` that knows two effects and plays nothing."""

    def __init__(self):
        self.emissions = EmissionRing()
        self.skipped = Skipped()
        self.plays = []
        self.scenes = []
        self.saved = []
        self.traces = []
        self.tests = []
        self.switched = []
        self.layers = []
        self.scene_in_force = "drums", Scene(())
        self.moves = []
        self.fingers = {"ok": (3, 7), "nobody's": ()}  # by the region that they are in
        self.dropped = []
        self.heard = None
        self.times_reported = 0

    def play(self, ticket, effect, x_m, y_m, finger, amplitude, now_s):  # noqa: ARG002
        if isinstance(effect, str) and effect not in EFFECTS:
            raise ControllerError(f"effect {effect!r} is unknown")
        self.plays.append((ticket, effect, x_m, y_m, finger, amplitude))

    def fingers_in(self, owner, region):  # noqa: ARG002
        if region not in self.fingers:
            raise ConfigError(f"no region {region!r}: neither of this client nor of the scene")
        return self.fingers[region]

    def fingers_down(self):
        return 1

    def switch(self, *, on, by):
        self.switched.append(on)
        self.switched_by = by

    def test_channel(self, ticket, channel, x_m, y_m, now_s):  # noqa: ARG002
        self.tests.append((ticket, channel, x_m, y_m))

    def hear(self, heard):
        self.heard = heard

    def write_trace(self, reason):
        self.traces.append(reason)

    def load_scene(self, ticket, name):
        if name == "broken":
            raise ControllerError("broken.toml: not valid TOML")
        self.scenes.append((ticket, name))

    def save_scene(self, ticket, name, toml):
        self.scenes.append((ticket, name))
        self.saved.append((name, toml))

    def put_layer(self, ticket, owner, line, placement, now_s):  # noqa: ARG002
        self.layers.append((ticket, owner, line, placement))

    def move_layer(self, owner, placement):
        if owner not in {owner for _, owner, *_ in self.layers}:
            raise ControllerError("there is nothing to move: this client has sent no regions")
        self.moves.append((owner, placement))

    def drop_layer(self, owner, now_s):  # noqa: ARG002
        self.dropped.append(owner)

    def scene(self):
        return self.scene_in_force

    def figures(self):
        self.times_reported += 1
        return {"emissions": 7, "nothing": math.nan}

    def effects(self):
        return EFFECTS


class Panel:
    """The part of the event loop that the socket sees."""

    def __init__(self, board, settings):
        self.settings = settings
        self.peers = deque()  # of those who connect, in their order; None: as the kernel says
        self.socket = CommandSocket(board, settings, self.peer_of)
        self.control = WritesDown()
        self.now_s = 100.0
        self.answered = 0  # layers
        self.clients = []

    def turn(self):
        """One turn; False if the loop would have slept for ever."""
        readable = select.select([self.socket.fileno()], [], [], 0)[0]
        if not readable and self.socket.next_time_s() == math.inf:
            return False
        if not readable:
            self.now_s = max(self.now_s, self.socket.next_time_s())
        self.socket.serve(self.now_s, self.control)
        return True

    def settle(self, most=10_000):
        """Turns until there is nothing to do; how many it took. Time passes as it would while the loop sleeps."""
        for turns in range(most):
            if not self.turn():
                return turns
        raise AssertionError(f"still busy after {most} turns")

    def peer_of(self, client):
        given = self.peers.popleft() if self.peers else None
        return peers.peer_of(client) if given is None else given

    def connect(self, peer=None):
        self.peers.append(peer)
        client = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        client.connect(self.settings.path)
        client.setblocking(False)
        self.clients.append(client)
        return client

    def send(self, client, text):
        """Send all of it; the loop turns where the kernel takes no more."""
        while text:
            try:
                text = text[client.send(text) :]
            except BlockingIOError:
                assert self.turn()

    def ask(self, client, *lines):
        """Send lines (objects, or bytes as they are), let the loop run, and read the answers."""
        for line in lines:
            self.send(client, line if isinstance(line, bytes) else json.dumps(line).encode() + b"\n")
        self.settle()
        return read(client)

    def close(self):
        for client in self.clients:
            client.close()
        self.socket.close()


def read(client):
    """All messages that a client has to read now."""
    text = bytearray()
    while True:
        try:
            more = client.recv(1 << 16)
        except (BlockingIOError, ConnectionResetError):
            break
        if not more:
            break
        text += more
    assert not text or text.endswith(b"\n")
    return [json.loads(line) for line in text.splitlines()]


@contextlib.contextmanager
def another_process(does, uid=None, groups=()):
    """A process of another user, as far as this one may make one: it calls `does(says, hears)` while the test goes on.

    Parameters
    ----------
    does : callable
        Given two binary files: what it writes to the first is read from the second of this side, and the other way round.
    """
    to_child, from_child = os.pipe(), os.pipe()
    pid = os.fork()
    if pid == 0:
        code = 1
        try:
            os.close(to_child[1])
            os.close(from_child[0])
            if uid is not None and os.geteuid() == 0:
                os.setgroups(groups)
                os.setgid(uid)
                os.setuid(uid)
            does(os.fdopen(from_child[1], "wb", 0), os.fdopen(to_child[0], "rb", 0))
            code = 0
        finally:
            os._exit(code)
    os.close(to_child[0])
    os.close(from_child[1])
    with os.fdopen(to_child[1], "wb", 0) as says, os.fdopen(from_child[0], "rb", 0) as hears:
        yield says, hears
    _, status = os.waitpid(pid, 0)
    assert status == 0, "the other process failed"


@pytest.fixture
def another():
    return another_process


@pytest.fixture
def folder():
    """A folder with a short name: a socket's path has at most 107 bytes."""
    path = Path(tempfile.mkdtemp(prefix="hp"))
    yield path
    shutil.rmtree(path)


@pytest.fixture
def panel_with(board, folder):
    """A panel with the given settings of its socket."""
    panels = []

    def make(**settings):
        panels.append(Panel(board, ApplicationSocket(path=str(folder / f"{len(panels)}.sock"), **settings)))
        return panels[-1]

    yield make
    for panel in panels:
        panel.close()


@pytest.fixture
def panel(panel_with):
    return panel_with()


@pytest.fixture
def settings(folder):
    return ApplicationSocket(path=str(folder / "panel.sock"))


@pytest.fixture
def changed():
    return msgspec.structs.replace


@pytest.fixture
def read_all():
    return read

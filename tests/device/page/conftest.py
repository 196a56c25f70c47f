"""A simulated panel and a bridge, each the real program; pages of a test's own."""

import contextlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from patience import wait_for
from websockets.sync.client import connect

from controller.device.application_socket.client import PanelClient

PATIENCE_S = 60.0
PLAYS = ("armed", "playing")


class Served:
    """A panel of `haptic-panel serve`, which can die and come back."""

    def __init__(self, folder, *options):
        self.socket = str(folder / "panel.sock")
        self.state = folder / "panel-state"
        self._options = options or ("--fingers", "4")

    def begin(self):
        """Return once it plays."""
        command = [sys.executable, "-m", "controller", "serve", "--background", *self._options]
        command += ["--commands-per-s", "5000", self.socket]
        environment = os.environ | {"STATE_DIRECTORY": str(self.state), "RUNTIME_DIRECTORY": str(Path(self.socket).parent)}
        done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
        assert done.returncode == 0, done.stderr
        self._pid = int(re.search(r"`kill (\d+)`", done.stderr)[1])

    def end(self, by=signal.SIGTERM):
        """Return once it has ended."""
        with contextlib.suppress(ProcessLookupError):
            os.kill(self._pid, by)
        stat = Path(f"/proc/{self._pid}/stat")
        wait_for("the panel's end", lambda: not stat.exists() or stat.read_text().rpartition(")")[2].split()[0] == "Z")


class Bridge:
    """A process of `haptic-panel page`."""

    def __init__(self, folder, socket, text="", www=None, port=0):
        self.ends_with = 0
        self.settings = folder / "page.toml"
        self.settings.write_text(text)
        self._said = tempfile.TemporaryFile("w+")  # noqa: SIM115
        command = [sys.executable, "-m", "controller", "page", "--settings", str(self.settings), "--port", str(port)]
        self.process = subprocess.Popen(
            [*command, "--socket", socket, *(["--www", str(www)] if www else [])],
            stdout=subprocess.PIPE,
            stderr=self._said,
            text=True,
            env=os.environ | {"STATE_DIRECTORY": str(folder / "state")},
        )
        self.address = self.process.stdout.readline().strip()
        assert self.address, self.said()
        self.port = int(re.search(r":(\d+)/", self.address)[1])
        self.origin = self.address.rstrip("/")

    def said(self):
        """All that it wrote to standard error."""
        self._said.seek(0)
        return self._said.read()

    def open(self, origin=None, **options):
        """A page's socket."""
        url = f"ws://127.0.0.1:{self.port}/panel"
        return connect(url, origin=origin or self.origin, compression=None, open_timeout=PATIENCE_S, **options)

    def end(self):
        """Its exit code."""
        if self.process.returncode is None:
            self.process.terminate()
            self.close()
        return self.process.wait()

    def close(self):
        """Read no more of what it says."""
        self.process.stdout.close()
        self._said.close()


def ask(page, **message):
    """The answer to a message; what comes between is left out."""
    page.send(json.dumps(message | {"id": "test"}))
    while (answer := json.loads(page.recv(PATIENCE_S))).get("id") != "test":
        pass
    return answer


@pytest.fixture(scope="session")
def asks():
    return ask


@pytest.fixture(scope="module")
def folder():
    """With a short name: a socket's path has at most 107 bytes."""
    path = Path(tempfile.mkdtemp(prefix="hp"))
    yield path
    shutil.rmtree(path, ignore_errors=True)


@pytest.fixture(scope="module")
def served(folder):
    """It takes a tenth of a processor, and ends with the tests that need it."""
    panel = Served(folder)
    panel.begin()
    yield panel
    panel.end()


@pytest.fixture
def another_panel(folder):
    """One that does not run yet."""
    (folder / "own").mkdir()
    panel = Served(folder / "own")
    yield panel
    panel.end()


@pytest.fixture
def panel_of(folder):
    """Makes one with fingers of its own: by options of `haptic-panel serve`."""
    panels = []

    def make(*fingers):
        panels.append(Served(Path(tempfile.mkdtemp(dir=folder)), *fingers))
        panels[-1].begin()
        return panels[-1]

    yield make
    for panel in panels:
        panel.end()


@pytest.fixture
def bridge_with(served, tmp_path):
    """A bridge with the given settings, to a panel that plays, whatever the test before has left."""
    bridges = []
    with PanelClient(served.socket, timeout_s=PATIENCE_S) as panel:
        if panel.state().state not in PLAYS:
            panel.arm()
            next(state for state in panel.states() if state.state in PLAYS)

    def make(text="", www=None, socket=served.socket):
        bridges.append(Bridge(tmp_path, socket, text, www))
        return bridges[-1]

    yield make
    assert [bridge.end() for bridge in bridges] == [bridge.ends_with for bridge in bridges]


@pytest.fixture
def bridge_at(served, tmp_path):
    """Bridges that a test kills, each at a port of its choice."""
    bridges = []

    def make(www, port):
        bridges.append(Bridge(tmp_path, served.socket, "messages_per_s = 1000\nburst = 1000", www, port))
        return bridges[-1]

    yield make
    for bridge in bridges:
        bridge.process.kill()
        bridge.process.wait()
        bridge.close()


@pytest.fixture
def bridge(bridge_with):
    return bridge_with()

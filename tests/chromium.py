"""A real browser, without window, driven over its debugging protocol."""

import base64
import contextlib
import json
import re
import shutil
import subprocess
import tempfile
import urllib.request
from pathlib import Path

from patience import wait_for
from websockets.sync.client import connect

PROGRAM = shutil.which("chromium") or shutil.which("chromium-browser")
OPTIONS = (
    "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run", "--disable-extensions",
    "--disable-background-networking", "--remote-debugging-port=0", "--disable-dev-shm-usage",
)  # fmt: skip


class Page:
    """One tab.

    Attributes
    ----------
    said : list of str
        What the page wrote to its console, and what it failed with: a test expects nothing.
    """

    def __init__(self, socket):
        self._socket = socket
        self._id = 0
        self.said = []
        for domain in ("Page", "Runtime", "Log"):
            self.call(f"{domain}.enable")

    def call(self, method, **params):
        """Result of a command of the protocol."""
        self._id += 1
        self._socket.send(json.dumps({"id": self._id, "method": method, "params": params}))
        while True:
            message = json.loads(self._socket.recv())
            if message.get("id") == self._id:
                assert "error" not in message, message
                return message["result"]
            if message.get("method") in {"Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded"}:
                self.said.append(json.dumps(message["params"])[:500])

    def value(self, expression):
        """What JavaScript gives, also of a promise."""
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in result, result
        return result["result"].get("value")

    def open(self, address):
        """Load a page."""
        self.call("Page.navigate", url=address)
        wait_for(address, lambda: self.value("location.href !== 'about:blank' && document.readyState === 'complete'"))

    def leave(self):
        """Leave the page and forget what it said: one whose bridge has ended complains."""
        self.call("Page.navigate", url="about:blank")
        self.until("location.href === 'about:blank'")
        self.said.clear()

    def size(self, width, height, scale=1, *, mobile=False):
        """Give the window a size in CSS pixels."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=mobile)

    def dark(self, scheme="dark"):
        """Prefer a colour scheme."""
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def picture(self, file):
        """Store what is seen."""
        file.write_bytes(base64.b64decode(self.call("Page.captureScreenshot")["data"]))

    def until(self, expression, what=None):
        """Wait until JavaScript gives something true, and return it."""
        return wait_for(what or expression, lambda: self.value(expression), said=lambda: "\n".join(self.said))


@contextlib.contextmanager
def browser():
    """A tab of a browser that ends with it."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile, tempfile.TemporaryFile("w+") as said:
        process = subprocess.Popen([PROGRAM, *OPTIONS, f"--user-data-dir={profile}", "about:blank"], stderr=said, stdout=said)
        try:
            port_file = Path(profile) / "DevToolsActivePort"
            wait_for("the browser", lambda: port_file.exists() and "\n" in port_file.read_text())
            port = int(port_file.read_text().split()[0])
            with urllib.request.urlopen(f"http://127.0.0.1:{port}/json/list") as answer:
                (tab,) = [one for one in json.load(answer) if one["type"] == "page"]
            with connect(re.sub("localhost", "127.0.0.1", tab["webSocketDebuggerUrl"]), max_size=None) as socket:
                yield Page(socket)
        finally:
            process.terminate()
            process.wait()

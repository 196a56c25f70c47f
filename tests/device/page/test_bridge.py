"""The bridge as a process, before the simulated panel: who is refused, who gets through, what happens when a side fails."""

import json
import random
import re
import signal
import socket
import subprocess
import sys
import urllib.error
import urllib.request
from pathlib import Path

import pytest
from device.page.conftest import PLAYS
from device.page.test_screen import PLACE, SCREEN
from patience import wait_for
from tables import each_row
from websockets.exceptions import ConnectionClosed, InvalidStatus

from controller.device.application_socket.client import PanelClient

PATIENCE_S = 60.0
RANDOM_FRAMES, AT_ONCE = 10_000, 50
REGION = {"name": "a", "shape": "rectangle", "x_mm": 20, "y_mm": 30, "width_mm": 40, "height_mm": 12, "effects": ["click"]}


def get(bridge, path="/", host=None, **fields):
    """Status, header fields and text of a GET that follows no redirection."""
    connection = socket.create_connection(("127.0.0.1", bridge.port), PATIENCE_S)
    with connection, connection.makefile("rb") as answer:
        named = fields | {"Host": host or f"127.0.0.1:{bridge.port}"}
        head = "".join(f"{name}: {value}\r\n" for name, value in named.items())
        connection.sendall(f"GET {path} HTTP/1.1\r\n{head}\r\n".encode("latin-1"))
        head, _, body = answer.read().partition(b"\r\n\r\n")
    lines = head.decode().split("\r\n")
    return int(lines[0].split()[1]), dict(line.split(": ", 1) for line in lines[1:]), body.decode(errors="replace")


def closing(page):
    """Code and reason with which the bridge ends a connection."""
    try:
        while True:
            page.recv(PATIENCE_S)
    except ConnectionClosed as closed:
        return closed.rcvd.code, closed.rcvd.reason


def test_a_page_plays_lays_regions_hears_touches_and_stops_nobody_else(bridge, asks):
    with bridge.open() as page:
        greeting = json.loads(page.recv(PATIENCE_S))
        assert greeting.pop("names")["EFFECT_TICK"] == ["click", 0.3]
        assert greeting == {
            "kind": "page", "rights": ["look", "play", "regions"], "x_mm_from_pixels": None, "y_mm_from_pixels": None
        }  # fmt: skip
        assert asks(page, kind="hello")["board"] == "simulated"
        assert asks(page, kind="play", effect="click", x_mm=100, y_mm=70)["outcome"] == "played"
        assert asks(page, kind="regions", regions=[REGION])["regions"] == 1
        assert asks(page, kind="transform", x_mm=1, y_mm=0, scale=1)["outcome"] == "done"
        assert (
            asks(page, kind="arm")["reason"]
            == "this page's origin may not arm: the bridge's settings do not give it the right 'operate'"
        )
        assert asks(page, kind="subscribe")["outcome"] == "done"
        while json.loads(page.recv(PATIENCE_S))["kind"] != "touch":
            pass


def test_a_page_that_may_only_look_may_stop(bridge_with, asks):
    bridge = bridge_with('[origins]\nself = ["operate"]\n"http://looks.example" = []')
    with bridge.open("http://looks.example") as page, bridge.open() as operator:
        assert asks(page, kind="stop")["outcome"] == "done"
        assert asks(page, kind="play", effect="click", x_mm=100, y_mm=70)["outcome"] == "refused"
        assert asks(operator, kind="arm")["outcome"] == "done"
        wait_for("the outputs", lambda: asks(operator, kind="state")["outputs_on"])


@pytest.mark.parametrize(
    "origin", ["http://evil.com", "null", "http://127.0.0.1:1", "https://127.0.0.1:{port}", "http://localhost:{port}"]
)
def test_pages_of_others_are_refused_and_the_log_says_which_line_allows_them(bridge, origin):
    origin = origin.format(port=bridge.port)
    with pytest.raises(InvalidStatus) as refused:
        bridge.open(origin)
    assert refused.value.response.status_code == 403
    said = refused.value.response.body.decode()
    assert repr(origin) in said
    assert str(bridge.settings) in said
    assert said.strip() in bridge.said()


def test_a_rebound_name_gets_nothing_at_all(bridge):
    for path in ("/", "/panel", "/haptic.js", "/live/"):
        status, _, text = get(bridge, path, host="evil.com", Origin="http://evil.com", Upgrade="websocket", Connection="Upgrade")
        assert (status, "hosts" in text) == (421, True)


def test_the_file_of_the_field_view_is_served_from_where_it_lies(bridge_with, tmp_path):
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere/a.field").write_text("modes")
    (tmp_path / "elsewhere/b").write_text("secret")
    (tmp_path / "link.field").symlink_to(tmp_path / "elsewhere/a.field")
    bridge = bridge_with(f'field = "{tmp_path / "link.field"}"')
    status, headers, text = get(bridge, "/live/plate.field")
    assert (status, headers["Content-Type"], text) == (200, "application/octet-stream", "modes")
    for path in ("/live/a.field", "/live/b", "/live/plate.field/b", "/live/plate.field/../b", "/plate.field"):
        assert get(bridge, path)[0] == 404
    assert get(bridge_with(), "/live/plate.field")[0] == 404


def test_files_come_with_a_strict_policy_and_nothing_from_outside_the_folder(bridge_with, tmp_path):
    www = tmp_path / "www"
    (www / "sub").mkdir(parents=True)
    (www / "index.html").write_text("<p>mine")
    (www / "sub" / "index.html").write_text("<p>deeper")
    (www / ".secret").write_text("s")
    (www / "live").mkdir()
    (tmp_path / "outside.txt").write_text("secret")
    (www / "link.txt").symlink_to(tmp_path / "outside.txt")
    (www / "circle").symlink_to("circle")
    bridge = bridge_with(www=www)
    status, fields, text = get(bridge, "/")
    assert (status, text, fields["Content-Type"]) == (200, "<p>mine", "text/html; charset=utf-8")
    assert fields["Content-Security-Policy"].startswith("default-src 'self'")
    assert fields["X-Content-Type-Options"] == "nosniff"
    assert get(bridge, "/sub")[1]["Location"] == "/sub/"
    assert get(bridge, "/sub/?x=1")[2] == "<p>deeper"
    assert "HapticPanel" in get(bridge, "/haptic.js")[2]
    assert "STOP" in get(bridge, "/live/")[2]
    for path in (
        "/../outside.txt",
        "/%2e%2e/outside.txt",
        "/link.txt",
        "/.secret",
        "/circle",
        "/%00",
        "/sub%5c..",
        "/none",
        "//evil.com",
        "/" + "a" * 3000,
    ):
        assert get(bridge, path)[0] == 404, path


@pytest.mark.parametrize(
    ("frame", "code"),
    [(b"{}", 1003), ("x" * 70_000, 1009)],
)
def test_frames_that_are_not_text_or_too_long_end_the_connection(bridge, frame, code):
    with bridge.open(max_size=None) as page:
        page.send(frame)
        assert closing(page)[0] == code
    with bridge.open() as page:
        assert json.loads(page.recv(PATIENCE_S))["kind"] == "page"


def test_random_frames_get_an_answer_each_and_the_panel_plays_on(bridge_with, asks):
    bridge = bridge_with("messages_per_s = 10000\nburst = 1000")
    source = random.Random(28)
    words = [
        '{"kind":',
        '"play"',
        '"regions"',
        "[",
        "]",
        "{",
        "}",
        ":",
        ",",
        "1e999",
        "-0",
        '"x_mm"',
        "null",
        "NaN",
        '"\\ud800"',
        " ",
        "\n",
        '"id":1',
    ]
    with bridge.open() as page:
        page.recv(PATIENCE_S)
        for _ in range(RANDOM_FRAMES // AT_ONCE):
            for _ in range(AT_ONCE):
                page.send("".join(source.choices(words, k=source.randint(0, 12))))
            assert [json.loads(page.recv(PATIENCE_S))["outcome"] for _ in range(AT_ONCE)] == ["refused"] * AT_ONCE
        assert asks(page, kind="play", effect="click", x_mm=100, y_mm=70)["outcome"] == "played"


def test_a_page_that_floods_is_refused_by_its_rate_and_others_are_served(bridge, asks):
    with bridge.open() as flood, bridge.open() as other:
        flood.recv(PATIENCE_S)
        for number in range(300):
            flood.send(json.dumps({"kind": "state", "id": number}))
        assert asks(other, kind="play", effect="click", x_mm=60, y_mm=70)["outcome"] == "played"
        answers = [json.loads(flood.recv(PATIENCE_S)) for _ in range(300)]
        assert sum(answer.get("reason") == "rate" for answer in answers) > 50
        assert asks(flood, kind="stop")["outcome"] == "done"
    with bridge.open() as page:
        assert asks(page, kind="state")["state"] != "armed"


def test_places_are_bounded_and_free_again(bridge_with):
    bridge = bridge_with("max_pages = 2")

    def opened():
        """A page's socket; None: there is no place, or one that was given up is still being cleared."""
        try:
            return bridge.open()
        except InvalidStatus as refused:
            if refused.response.status_code != 503:
                raise
            return None

    with bridge.open():
        with bridge.open():
            assert opened() is None
        with wait_for("the place that is free again", opened):
            assert opened() is None


def test_half_open_connections_and_noise_take_no_page_its_place(bridge, asks):
    """More than the bridge accepts; the first hold their places without saying anything."""
    idle = [socket.create_connection(("127.0.0.1", bridge.port), PATIENCE_S) for _ in range(50)]
    for noise in (
        b"\0" * 1000,
        b"GET /",
        b"POST / HTTP/1.1\r\n\r\n",
        b"GET / HTTP/1.1\r\n" + b"a: b\r\n" * 1000,
        b"\x16\x03\x01\x02\x00",
    ):
        with socket.create_connection(("127.0.0.1", bridge.port), PATIENCE_S) as one:
            one.sendall(noise)
    with bridge.open() as page:
        assert asks(page, kind="hello")["board"] == "simulated"
    for one in idle:
        one.close()
    assert "Traceback" not in bridge.said()


def test_a_page_that_does_not_read_is_dropped(bridge_with):
    """Figures have some 10 kB: what waits for the page grows beyond its bounds."""
    bridge = bridge_with("messages_per_s = 10000\nburst = 1000")
    page = socket.create_connection(("127.0.0.1", bridge.port), PATIENCE_S)
    page.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    fields = f"Host: 127.0.0.1:{bridge.port}\r\nOrigin: {bridge.origin}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    page.sendall(f"GET /panel HTTP/1.1\r\n{fields}Sec-WebSocket-Key: {'A' * 22}==\r\nSec-WebSocket-Version: 13\r\n\r\n".encode())
    text = b'{"kind":"figures","id":1}'
    frame = bytes([0x81, 0x80 | len(text), 0, 0, 0, 0]) + text
    page.settimeout(0.05)

    def dropped():
        try:
            page.sendall(frame * 20)
        except TimeoutError:
            return False
        except OSError:
            return True
        return False

    wait_for("the end", dropped)
    page.close()


@pytest.mark.slow  # two panels begin
def test_a_panel_that_dies_ends_its_pages_and_one_that_comes_back_is_found(bridge_with, another_panel, asks):
    own = another_panel
    bridge = bridge_with(socket=own.socket)
    with bridge.open() as page:
        assert closing(page) == (1013, f"no panel at {own.socket} (No such file or directory)")
    own.begin()
    with bridge.open() as page:
        assert asks(page, kind="hello")["board"] == "simulated"
        own.end(signal.SIGKILL)
        assert closing(page)[0] == 1012
    own.begin()
    with bridge.open() as page:
        assert asks(page, kind="hello")["board"] == "simulated"
        own.end()
        assert closing(page)[0] == 1012


def test_a_layer_is_gone_with_its_page(bridge, asks):
    with bridge.open() as page:
        assert asks(page, kind="regions", regions=[REGION])["regions"] == 1
        assert asks(page, kind="figures")["figures"]["application_socket"]["clients_connected"] == 1
    with bridge.open() as page:
        wait_for("its end", lambda: asks(page, kind="figures")["figures"]["application_socket"]["clients_connected"] == 1)


def test_a_bridge_that_is_killed_takes_its_layers_along_and_another_one_serves(bridge_with, asks, served):
    bridge = bridge_with()
    bridge.ends_with = -signal.SIGKILL
    with PanelClient(served.socket, timeout_s=PATIENCE_S) as panel, bridge.open() as page:
        assert asks(page, kind="regions", regions=[REGION])["regions"] == 1
        page.send(json.dumps({"kind": "regions", "regions": [REGION | {"name": f"r{n}", "x_mm": n} for n in range(150)]}))
        bridge.process.kill()
        wait_for("its end", lambda: panel.describe().clients.connected == 1)
        assert panel.state().state in PLAYS
    with bridge_with().open() as page:
        assert asks(page, kind="regions", regions=[REGION])["regions"] == 1


def test_beyond_this_machine_only_with_tls_and_token(bridge_with, tmp_path):
    key, certificate = tmp_path / "key.pem", tmp_path / "certificate.pem"
    subject = ["-subj", "/CN=localhost", "-keyout", key, "-out", certificate]
    subprocess.run(
        ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", *subject], check=True, capture_output=True
    )
    (tmp_path / "token").write_text("correct-horse-battery\n")
    bridge = bridge_with(
        f'listen = ["127.0.0.1", "127.0.0.2"]\n'
        f'tls_certificate = "{certificate}"\ntls_key = "{key}"\ntoken_file = "{tmp_path / "token"}"'
    )
    import ssl

    trusts = ssl.create_default_context(cafile=str(certificate))
    trusts.check_hostname = False

    def status(path, **fields):
        asked = urllib.request.Request(f"https://127.0.0.1:{bridge.port}{path}", headers=fields)
        opener = urllib.request.build_opener(urllib.request.HTTPSHandler(context=trusts), NoRedirect())
        try:
            with opener.open(asked) as answer:
                return answer.status, answer.headers
        except urllib.error.HTTPError as error:
            return error.code, error.headers

    assert status("/live/")[0] == 401
    assert status("/live/?token=wrong")[0] == 401
    assert status("/live/", Cookie="haptic-panel-token=wrong; x")[0] == 401
    code, headers = status("/live/?token=correct-horse-battery")
    assert (code, headers["Location"]) == (302, "/live/")
    assert all(word in headers["Set-Cookie"] for word in ("HttpOnly", "SameSite=Strict", "Secure"))
    assert status("/live/", Cookie=headers["Set-Cookie"].partition(";")[0])[0] == 200


class NoRedirect(urllib.request.HTTPRedirectHandler):
    def redirect_request(self, *_):
        return None


@each_row(
    ("options", "code", "said"),
    [
        (["--settings", "/none.toml"], 78, "/none.toml: cannot be read"),
        (["--www", "/none"], 78, "www = '/none': there is no such folder"),
        (["--settings", "{field}"], 78, "field = '/none': there is no such file; `haptic-panel focus --field-out FILE` makes one"),
        (["--port", "70000"], 78, "port = 70000"),
        (["--demo", "--socket", "/x"], 2, "--demo: has a panel and socket of its own"),
        (["--port", "x"], 2, "--port"),
    ],
)
def test_what_cannot_begin_ends_with_one_line(options, code, said, tmp_path):
    (tmp_path / "page.toml").write_text('field = "/none"\n')
    options = [option.format(field=tmp_path / "page.toml") for option in options]
    done = subprocess.run([sys.executable, "-m", "controller", "page", *options], capture_output=True, text=True, check=False)
    assert done.returncode == code
    assert said in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.slow  # a panel begins
def test_the_demo_shows_a_page_and_ends_with_its_panel():
    """The line of the README."""
    command = [sys.executable, "-m", "controller", "page", "--demo", "--port", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as demo:
        address = demo.stdout.readline().strip()
        with urllib.request.urlopen(f"{address}live/", timeout=PATIENCE_S) as answer:
            assert "STOP" in answer.read().decode()
        with urllib.request.urlopen(f"{address}live/plate.field", timeout=PATIENCE_S) as answer:
            assert answer.read(8) == b"HPfield1"
        demo.terminate()
        _, said = demo.communicate()
    assert demo.returncode == 0, said
    panel = Path(f"/proc/{re.search(r'`kill (.+?)`', said)[1]}")
    wait_for("the panel's end", lambda: not panel.exists())


def test_a_port_that_is_taken_is_one_line(bridge):
    done = subprocess.run(
        [sys.executable, "-m", "controller", "page", "--port", str(bridge.port)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert f"port {bridge.port}" in done.stderr


def test_pages_are_greeted_with_where_the_screen_lies_and_again_when_that_changes(bridge_with, asks):
    bridge = bridge_with('[origins]\nself = ["screen"]\n"https://app.example" = ["play"]')
    with bridge.open() as page, bridge.open(origin="https://app.example") as other:
        assert json.loads(other.recv())["x_mm_from_pixels"] is None
        assert "right 'screen'" in asks(other, **SCREEN)["reason"]
        assert asks(page, **SCREEN) == {"kind": "answer", "id": "test", "outcome": "done"}
        greeting = json.loads(other.recv())
        assert (greeting["kind"], greeting["x_mm_from_pixels"]) == ("page", PLACE["x_mm_from_pixels"])
    with bridge.open() as page:
        assert json.loads(page.recv())["y_mm_from_pixels"] == PLACE["y_mm_from_pixels"]

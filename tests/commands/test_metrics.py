"""`haptic-panel metrics`: what Prometheus, or its textfile collector, gets."""

import signal
import socket
import subprocess
import sys
import urllib.request

from patience import wait_for
from tables import each_row

from controller.cli import main


def test_a_panel_that_does_not_answer_is_down(tmp_path, capsys):
    assert main(["metrics", "--socket", str(tmp_path / "nobody.sock")]) == 0
    assert "haptic_panel_up 0.0" in capsys.readouterr().out.splitlines()
    file = tmp_path / "panel.prom"
    assert main(["metrics", "--socket", str(tmp_path / "nobody.sock"), "--textfile", str(file)]) == 0
    assert "haptic_panel_up 0.0" in file.read_text().splitlines()
    assert [path.name for path in tmp_path.iterdir()] == ["panel.prom"]


def test_releases_are_reported_whether_or_not_a_panel_answers(tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("HAPTIC_PANEL_ROOT", str(tmp_path))
    (tmp_path / "state").mkdir()
    for name, words in (("current", "1.0"), ("trial", "2.0"), ("tries", "2"), ("failed", "0.8\n0.9")):
        (tmp_path / "state" / name).write_text(f"{words}\n")
    assert main(["metrics", "--socket", str(tmp_path / "nobody.sock")]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert 'haptic_panel_update_info{in_use="",previous="",stays="1.0",trial="2.0"} 1.0' in lines
    reported = {"trial": 1.0, "tries": 2.0, "failed_releases": 2.0, "requests": 0.0, "problems": 1.0}
    assert {f"haptic_panel_update_{name} {value}" for name, value in reported.items()} <= set(lines)


@each_row(
    ("options", "code", "said"),
    [
        (["--textfile", "{}/panel.txt"], 2, "node_exporter reads only files whose names end with .prom"),
        (["--textfile", "{}/absent/panel.prom"], 1, "cannot be written (No such file or directory)"),
        (["--listen", "9750"], 2, "give HOST:PORT, such as 127.0.0.1:9750"),
        (["--listen", "127.0.0.1:99999"], 2, "give HOST:PORT, such as 127.0.0.1:9750"),
        (["--listen", "127.0.0.1:{port}"], 1, "cannot listen there (Address already in use)"),
    ],
)
def test_what_cannot_be_done_is_said_in_one_line(tmp_path, capsys, options, code, said):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        given = [option.format(tmp_path, port=taken.getsockname()[1]) for option in options]
        assert main(["metrics", *given]) == code
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line


def test_it_is_served_until_it_is_asked_to_end(tmp_path):
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    command = [
        sys.executable,
        "-m",
        "controller",
        "metrics",
        "--socket",
        str(tmp_path / "nobody.sock"),
        "--listen",
        f"127.0.0.1:{port}",
    ]

    def text():
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{port}/metrics") as answer:
                return answer.read().decode()
        except OSError:
            return ""

    with subprocess.Popen(command) as server:
        try:
            assert "haptic_panel_up 0.0" in wait_for("an answer", text)
        finally:
            server.send_signal(signal.SIGTERM)
        assert server.wait() == 0

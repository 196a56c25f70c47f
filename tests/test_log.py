"""The log never keeps anybody waiting, says what it has missed, and gives the journal its priorities."""

import contextlib
import os
import re
import socket
import subprocess
import sys
from pathlib import Path

import pytest
from tables import each_row

from controller import log as log_module
from controller.log import MAX_LINE_BYTES, Event, Log, Priority, line


class Pipe:
    """Standard error as a pipe, which may be read and filled."""

    def __init__(self):
        reads, writes = os.pipe()
        os.set_blocking(reads, False)
        self.far = open(reads, "rb", buffering=0)  # noqa: PTH123, SIM115
        self.near = open(writes, "w")  # noqa: PTH123, SIM115

    def fill(self):
        """Without a change to the flags of the end that the log writes to."""
        own = os.open(f"/proc/self/fd/{self.near.fileno()}", os.O_WRONLY | os.O_NONBLOCK)
        with contextlib.suppress(BlockingIOError):
            while True:
                os.write(own, b"x" * 4096)
        os.close(own)

    def read(self):
        return self.far.read(1 << 20) or b""


@pytest.fixture
def pipe():
    pipe = Pipe()
    yield pipe
    pipe.far.close()
    pipe.near.close()


def test_a_log_that_is_full_loses_lines_and_is_informed_how_many(pipe):
    log = Log()
    pipe.fill()
    with contextlib.redirect_stderr(pipe.near):
        log.write("one")
        log.write("two", Priority.WARNING)
        assert log.lost == 2
        assert not pipe.read().strip(b"x")
        log.write("three")
        log.write("four")
    assert log.lost == 2
    assert pipe.read().decode().splitlines() == [
        "haptic-panel: 2 lines before this one were lost: the log was full",
        "haptic-panel: three",
        "haptic-panel: four",
    ]


def test_a_log_that_is_gone_is_no_reason_to_stop(pipe):
    log = Log()
    pipe.far.close()
    for stderr in (pipe.near, None):
        with contextlib.redirect_stderr(stderr):
            log.write("one")
    assert log.lost == 2


@each_row("priority", list(Priority))
def test_only_the_journal_is_given_priorities(tmp_path, monkeypatch, priority):
    with (tmp_path / "log").open("w+") as file, contextlib.redirect_stderr(file):
        at = os.fstat(file.fileno())
        for stream, before in ((f"{at.st_dev}:{at.st_ino}", f"<{int(priority)}>"), (f"{at.st_dev}:{at.st_ino + 1}", ""), ("", "")):
            monkeypatch.setenv("JOURNAL_STREAM", stream)
            assert line("outputs off", priority) == f"{before}haptic-panel: outputs off"
        monkeypatch.delenv("JOURNAL_STREAM")
        assert line("outputs off", priority) == "haptic-panel: outputs off"


def test_one_sentence_is_one_line_however_it_is_written_and_however_long(pipe):
    with contextlib.redirect_stderr(pipe.near):
        Log().write("scene\n<0>haptic-panel: not really\r\n" + "é" * MAX_LINE_BYTES)
    said = pipe.read()
    assert said.count(b"\n") == 1
    assert said.endswith(b"\n")
    assert len(said) <= MAX_LINE_BYTES
    assert said.startswith(b"haptic-panel: scene <0>haptic-panel: not really")


@contextlib.contextmanager
def connected(pipe, tmp_path, monkeypatch):
    """Standard error connected to a journal, whose socket is returned."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as listening:
        listening.bind(str(tmp_path / "journal"))
        listening.setblocking(False)
        monkeypatch.setattr(log_module, "JOURNAL", tmp_path / "journal")
        at = os.fstat(pipe.near.fileno())
        monkeypatch.setenv("JOURNAL_STREAM", f"{at.st_dev}:{at.st_ino}")
        with contextlib.redirect_stderr(pipe.near):
            yield listening


def test_the_journal_gets_events_by_their_identifiers(pipe, tmp_path, monkeypatch):
    with connected(pipe, tmp_path, monkeypatch) as journal:
        log = Log()
        log.write("outputs off: no permit", Event.NO_PERMIT)
        log.write("board 'panel'\nMESSAGE_ID=0")
        assert journal.recv(4096).decode().splitlines() == [
            "MESSAGE=haptic-panel: outputs off: no permit",
            "PRIORITY=4",
            "SYSLOG_IDENTIFIER=haptic-panel",
            "MESSAGE_ID=f9c85debb3c84917bfaadefcba88d64c",
        ]
        assert journal.recv(4096).decode().splitlines() == [
            "MESSAGE=haptic-panel: board 'panel' MESSAGE_ID=0",
            "PRIORITY=6",
            "SYSLOG_IDENTIFIER=haptic-panel",
        ]
        assert (log.lost, pipe.read()) == (0, b"")


def test_a_journal_that_reads_nothing_keeps_nobody_waiting(pipe, tmp_path, monkeypatch):
    with connected(pipe, tmp_path, monkeypatch) as journal:
        log = Log()
        for _ in range(10_000):  # more than any queue holds
            log.write("line")
        dropped = log.lost
        assert dropped
        with contextlib.suppress(BlockingIOError):
            while True:
                journal.recv(4096)
        log.write("another", Event.STARTED)
        said = [journal.recv(4096).decode().splitlines() for _ in range(2)]
        assert said[0][0] == f"MESSAGE=haptic-panel: {dropped} lines before this one were lost: the log was full"
        assert said[0][3] == f"MESSAGE_ID={Event.LINES_LOST.message_id}"
        assert said[1][0] == "MESSAGE=haptic-panel: another"


def test_without_the_journals_socket_lines_go_to_its_stream(pipe, tmp_path, monkeypatch):
    with connected(pipe, tmp_path, monkeypatch):
        monkeypatch.setattr(log_module, "JOURNAL", tmp_path / "nobody")
        Log().write("the outputs are on", Event.OUTPUTS_ON)
        assert pipe.read() == b"<6>haptic-panel: the outputs are on\n"


def test_the_catalogue_explains_every_event_once():
    text = (Path(__file__).parents[1] / "systemd/haptic-panel.catalog").read_text()
    entries = re.findall(r"^-- ([0-9a-f]{32})\nSubject: (\S.*)\nDefined-By: haptic-panel\n\n(\S.*\n)+", text, re.MULTILINE)
    explained = [message_id for message_id, *_ in entries]
    assert len(explained) == len(set(explained)) == text.count("\n-- ")
    assert len({event.message_id for event in Event}) == len(Event)
    script = (Path(__file__).parents[1] / "systemd/fall-back").read_text()
    of_script = re.findall(r"^[A-Z_]+=([0-9a-f]{32})$", script, re.MULTILINE)
    assert len(of_script) > 5
    assert sorted([*(event.message_id for event in Event), *of_script]) == sorted(explained)


@each_row("before", range(4))
def test_a_line_that_is_too_long_is_cut_between_two_characters(before):
    code = f"from controller.log import log; log('x' * {before} + '\\N{{GRINNING FACE}}' * 4096)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True)
    assert len(done.stderr) <= MAX_LINE_BYTES
    assert done.stderr.decode().startswith("haptic-panel: ")

"""The log never keeps anybody waiting, says what it has missed, and gives the journal its priorities."""

import contextlib
import os

import pytest

from controller.log import MAX_LINE_BYTES, Log, Priority, line


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


def test_a_log_that_is_full_loses_lines_and_is_told_how_many(pipe):
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


@pytest.mark.parametrize("priority", list(Priority))
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

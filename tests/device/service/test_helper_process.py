"""A process is started whatever the others do; a helper that cannot be started is none: the loop that asked for it goes on."""

import contextlib
import os
import resource
import threading

import pytest
from patience import wait_for
from tables import each_row

from controller.device.kernel import start_program, twin
from controller.device.service.scenes.helper_process import HelperProcess


@pytest.fixture
def no_file_left():
    """As many files as are open may be open: the next one fails."""
    before = resource.getrlimit(resource.RLIMIT_NOFILE)
    free = os.dup(0)
    os.close(free)
    resource.setrlimit(resource.RLIMIT_NOFILE, (free, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_NOFILE, before)


def test_without_a_file_there_is_no_helper_and_nothing_is_raised(no_file_left):
    helper = HelperProcess("layers", 1.0)
    helper.start()
    assert helper.fileno() is None
    assert helper.pid == 0
    assert not helper.send(b"anything")
    assert helper.receive() == b""
    helper.end()
    helper.close()


@contextlib.contextmanager
def threads_that_wait_for_the_interpreter(count=6):
    """As those that read from a network do, many times more often."""
    ours, theirs = os.pipe()
    ended = threading.Event()

    def writes_and_reads():
        while not ended.is_set():
            os.write(theirs, b"x")
            os.read(ours, 1)

    threads = [threading.Thread(target=writes_and_reads) for _ in range(count)]
    for thread in threads:
        thread.start()
    try:
        yield
    finally:
        ended.set()
        for thread in threads:
            thread.join()
        os.close(ours)
        os.close(theirs)


def status_of(pid):
    """How a program has ended, which is waited for."""

    def ended():
        done, status = os.waitpid(pid, os.WNOHANG)
        return done and (os.waitstatus_to_exitcode(status),)

    return wait_for("its end", ended, seconds=20.0)[0]


@each_row("start", [start_program, twin.start_program])
def test_a_program_begins_with_what_it_was_given_also_beside_threads(start):
    program = b'read word && test "$HEARD-$word" = one-two && test -z "$HOME" && echo "nobody reads this"'
    with threads_that_wait_for_the_interpreter():
        for _ in range(20):
            ours, theirs = os.pipe()
            pid = start((b"/bin/sh", b"-c", program), (b"HEARD=one",), ours)
            os.close(ours)
            os.write(theirs, b"two\n")
            os.close(theirs)
            assert status_of(pid) == 0
    pid = start((b"/nowhere",), (), 0)
    assert pid == -1 or status_of(pid) == 127

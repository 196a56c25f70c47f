"""A helper that cannot be started is none: the loop that asked for it goes on."""

import os
import resource

import pytest

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

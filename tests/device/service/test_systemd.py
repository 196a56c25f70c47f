"""What the service manager is sent."""

import os
import re
import socket
from collections import deque

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.service.systemd import PINGS_PER_TIMEOUT, Notifier, Watchdog


@pytest.fixture(params=["path", "abstract"])
def manager(request, tmp_path):
    """A socket as systemd's, and the address it gives its services."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as listening:
        name = str(tmp_path / "notify")
        listening.bind(name if request.param == "path" else "\0" + name)
        listening.setblocking(False)
        yield listening, name if request.param == "path" else "@" + name


def heard(listening):
    messages = []
    while True:
        try:
            messages.append(listening.recv(4096).decode().split("\n"))
        except BlockingIOError:
            return messages


def test_the_manager_hears_each_state(manager):
    listening, address = manager
    with Notifier.from_environment({"NOTIFY_SOCKET": address}) as notifier:
        notifier.status("waiting for the panel")
        notifier.ready("playing")
        notifier.reloading("scene.toml")
        notifier.stopping("outputs off")
    status, ready, reloading, stopping = heard(listening)
    assert status == ["STATUS=waiting for the panel"]
    assert ready == ["READY=1", "STATUS=playing"]
    assert (reloading[0], reloading[2]) == ("RELOADING=1", "STATUS=scene.toml")
    assert re.fullmatch(r"MONOTONIC_USEC=\d+", reloading[1])
    assert stopping == ["STOPPING=1", "STATUS=outputs off"]


def test_a_status_cannot_smuggle_in_a_variable(manager):
    listening, address = manager
    with Notifier(address) as notifier:
        notifier.status("scene\nREADY=1\r\nMAINPID=1")
    assert heard(listening) == [["STATUS=scene READY=1 MAINPID=1"]]


def test_without_a_manager_nothing_is_sent_and_nothing_fails(tmp_path):
    Notifier.from_environment({}).ready("playing")
    with Notifier(str(tmp_path / "nobody")) as gone:
        gone.ready("playing")
        Watchdog(gone, 1.0).progress(0.0)


def fill(address):
    """Leave no room in a socket's queue."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as other:
        other.setblocking(False)
        other.connect("\0" + address[1:] if address[0] == "@" else address)
        while True:
            other.send(b"flood")


def test_what_finds_the_queue_full_is_sent_later_in_its_order(manager):
    listening, address = manager
    with pytest.raises(BlockingIOError):
        fill(address)
    with Notifier(address) as notifier:
        notifier.reloading("scene.toml")
        notifier.ready("playing")
        notifier.alive()  # still full: the watchdog's own message may be lost, a state may not
        assert all(message == ["flood"] for message in heard(listening))
        notifier.alive()
    assert [message[0] for message in heard(listening)] == ["RELOADING=1", "READY=1", "WATCHDOG=1"]


@given(st.lists(st.floats(0, 0.5), max_size=60), st.floats(0.01, 3))
def test_the_watchdog_hears_of_progress_soon_enough_and_not_too_often(steps_s, timeout_s):
    reported_s = deque()
    now_s = 1000.0

    class Reported(Notifier):
        def alive(self):
            reported_s.append(now_s)

    watchdog = Watchdog(Reported(""), timeout_s)
    period_s = timeout_s / PINGS_PER_TIMEOUT
    turns_s = []
    for step_s in steps_s:
        now_s += step_s
        turns_s.append(now_s)
        watchdog.progress(now_s)
    assert list(reported_s)[:1] == turns_s[:1]
    for earlier_s, later_s in zip(reported_s, list(reported_s)[1:], strict=False):
        assert later_s - earlier_s >= period_s * (1 - 1e-9)
        assert not any(earlier_s + period_s * (1 + 1e-9) < turn_s < later_s for turn_s in turns_s)


@each_row(
    ("environment", "watched"),
    [
        ({}, False),
        ({"WATCHDOG_USEC": "3000000"}, True),
        ({"WATCHDOG_USEC": "3000000", "WATCHDOG_PID": str(os.getpid())}, True),
        ({"WATCHDOG_USEC": "3000000", "WATCHDOG_PID": "1"}, False),  # meant for another process
        ({"WATCHDOG_USEC": "0"}, False),
        ({"WATCHDOG_USEC": "soon"}, False),
    ],
)
def test_only_a_service_that_is_watched_sends_pings(manager, environment, watched):
    listening, address = manager
    with Notifier(address) as notifier:
        watchdog = Watchdog.from_environment(notifier, environment)
        for now_s in (0.0, 0.9, 1.1, 2.05):
            watchdog.progress(now_s)
    assert heard(listening) == ([["WATCHDOG=1"]] * 2 if watched else [])

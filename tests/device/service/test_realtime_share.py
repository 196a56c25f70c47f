"""Real time for a share of one core: given back when that is used up, and never beside a loop that has none."""

import os
import signal

import pytest
from device.service.test_layer_preparer import bank, preparer, works  # noqa: F401

from controller.device.service.scenes import realtime_share
from controller.device.service.scenes.realtime_share import MOST_S, SHARE, RealtimeShare, refilled


class Host:
    """Clock, processor time, the loop's scheduling and ours."""

    def __init__(self):
        self.now_s = self.used_s = 0.0
        self.loop_in_realtime = True
        self.policy = os.SCHED_OTHER

    def schedule(self, policy, priority):
        assert priority == (realtime_share.PRIORITY if policy == os.SCHED_RR else 0)
        self.policy = policy


@pytest.fixture
def host(monkeypatch):
    host = Host()
    monkeypatch.setattr(realtime_share, "_schedule", host.schedule)
    monkeypatch.setattr(realtime_share, "_above_us", lambda _: host.loop_in_realtime)
    monkeypatch.setattr(realtime_share.time, "monotonic", lambda: host.now_s)
    monkeypatch.setattr(realtime_share.time, "process_time", lambda: host.used_s)
    monkeypatch.setattr(realtime_share.signal, "setitimer", lambda *_: None)
    before = signal.getsignal(signal.SIGPROF)
    yield host
    signal.signal(signal.SIGPROF, before)


def test_the_share_comes_back_with_time_up_to_a_limit():
    assert refilled(0.0, 0.1) == pytest.approx(0.1 * SHARE)
    assert refilled(-0.02, 0.08) == pytest.approx(0.0)
    assert refilled(0.0, 1e3) == MOST_S


def test_spans_are_in_real_time_until_the_share_is_used_and_again_once_it_is_back(host):
    share = RealtimeShare(1)
    policies = []
    for _ in range(10):
        with share:
            policies.append(host.policy)
            host.used_s += MOST_S / 8
    assert policies == [os.SCHED_RR] * 8 + [os.SCHED_OTHER] * 2
    host.now_s += 3 * MOST_S / 8 / SHARE
    with share:
        assert host.policy == os.SCHED_RR


def test_within_a_span_it_ends_when_the_timer_says_so(host):
    with RealtimeShare(1):
        assert host.policy == os.SCHED_RR
        signal.raise_signal(signal.SIGPROF)
        assert host.policy == os.SCHED_OTHER


def test_not_while_the_loop_is_an_ordinary_process(host):
    share = RealtimeShare(1)
    with share:
        assert host.policy == os.SCHED_RR
    host.loop_in_realtime = False
    with share:
        assert host.policy == os.SCHED_OTHER


def test_a_loop_that_is_gone_or_ordinary_is_not_above(bank, preparer, monkeypatch):  # noqa: F811
    assert not realtime_share._above_us(os.getpid())
    with monkeypatch.context() as patched:
        patched.setattr(os, "sched_getscheduler", lambda _: os.SCHED_FIFO)
        for beyond, above in ((1, True), (0, False), (-1, False)):
            patched.setattr(os, "sched_getparam", lambda _, beyond=beyond: os.sched_param(realtime_share.PRIORITY + beyond))
            assert realtime_share._above_us(1) is above
    works(preparer)
    pid = preparer.helper.process.pid
    assert os.sched_getscheduler(pid) == os.SCHED_OTHER
    preparer.close()
    assert not realtime_share._above_us(pid)


def test_the_process_that_checks_layers_follows_the_loop(preparer):  # noqa: F811
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO | os.SCHED_RESET_ON_FORK, os.sched_param(realtime_share.PRIORITY + 1))
    except PermissionError:
        pytest.skip("may not be in real time")
    try:
        works(preparer)
    finally:
        os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
    assert os.sched_getscheduler(preparer.helper.process.pid) == os.SCHED_RR
    works(preparer)
    assert os.sched_getscheduler(preparer.helper.process.pid) == os.SCHED_OTHER

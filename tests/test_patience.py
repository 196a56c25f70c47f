"""Waiting by the time that the machine had to spare."""

import os
import subprocess
import sys
import time

import patience
import psutil
import pytest


def test_a_process_that_works_uses_up_patience_and_one_that_waits_for_others_does_not(monkeypatch):
    monkeypatch.setattr(patience, "idle_s", lambda: 0.0)
    waiting = patience.Patience(0.2, os.getpid())
    monkeypatch.setattr(patience, "processor_s", lambda _: 7.0)
    waiting.begin()
    assert not waiting.over
    monkeypatch.setattr(patience, "processor_s", lambda _: 7.2)
    assert waiting.over  # twice 0.2 s: this process and the one named


def test_an_idle_machine_uses_up_patience(monkeypatch):
    idle_s = iter([10.0, 10.9, 11.1])
    monkeypatch.setattr(patience, "idle_s", lambda: next(idle_s))
    monkeypatch.setattr(patience, "processor_s", lambda _: 0.0)
    waiting = patience.Patience(1.0)
    assert not waiting.over
    assert waiting.over


def test_what_is_read_of_the_kernel_is_seconds():
    before_s = patience.processor_s(os.getpid())
    while patience.processor_s(os.getpid()) < before_s + 0.05:
        sum(range(100_000))
    assert patience.processor_s(os.getpid()) == pytest.approx(sum(os.times()[:4]), abs=0.1)
    spare = psutil.cpu_times()  # psutil divides the kernel's clock ticks by itself
    assert patience.idle_s() == pytest.approx((spare.idle + spare.iowait) / os.cpu_count(), rel=0.01, abs=5.0)
    up_s = time.clock_gettime(time.CLOCK_BOOTTIME)
    assert patience.idle_s() <= up_s + 1.0
    assert patience.processor_s(2**22 + 1) == 0.0


def test_a_process_that_does_not_end_is_killed_and_reported():
    hanging = subprocess.Popen(
        [sys.executable, "-c", "while True: pass"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    with pytest.raises(AssertionError, match="did not end"):
        patience.communicate(hanging, seconds=0.2)
    assert hanging.returncode == -9


def test_a_command_that_says_nothing_more_is_ended_and_one_that_does_is_not(tmp_path, monkeypatch):
    log = tmp_path / "log"
    log.write_text("")
    silent = subprocess.Popen([sys.executable, "-c", "while True: pass"])
    patience.end_when_silent(silent.pid, log, seconds=0.2)
    assert silent.wait() == -15
    deaf = [sys.executable, "-c", "import signal; signal.signal(15, signal.SIG_IGN); print(flush=True)\nwhile True: pass"]
    with subprocess.Popen(deaf, stdout=subprocess.PIPE) as silent:
        silent.stdout.readline()
        monkeypatch.setattr(patience, "FORCE_S", 0.1)
        patience.end_when_silent(silent.pid, log, seconds=0.1)
        assert silent.wait() == -9
    program = "import sys, time\nwhile time.process_time() < 2: open(sys.argv[1], 'a').write('.')"
    talking = subprocess.Popen([sys.executable, "-c", program, str(log)])
    patience.end_when_silent(talking.pid, log, seconds=1.0)
    assert talking.wait() == 0


def test_a_condition_that_does_not_come_is_reported():
    with pytest.raises(AssertionError, match=r"waited 0.01 s to spare for the moon\nclouds"):
        patience.wait_for("the moon", lambda: False, seconds=0.01, said=lambda: "clouds")
    assert patience.wait_for("the sun", lambda: "up") == "up"

"""Runs in the guest: what systemd permits a user without rights (LimitRTPRIO, LimitMEMLOCK) is enough for the loop."""

import mmap
import os
import re
import resource
import sys
import tempfile
import threading
import traceback
from pathlib import Path

from controller.device.board.devices import Realtime
from controller.device.service.realtime import enter_realtime

BANK_BYTES = 300 << 20


def status(name):
    """A figure of /proc/self/status in kB."""
    return int(re.search(rf"^{name}:\s*(\d+) kB$", Path("/proc/self/status").read_text(), re.MULTILINE)[1])


def as_nobody(check):
    """Run a check in a child without any right but the limits of the unit."""
    child = os.fork()
    if child == 0:
        code = 1
        try:
            resource.setrlimit(resource.RLIMIT_RTPRIO, (50, 50))
            resource.setrlimit(resource.RLIMIT_MEMLOCK, (65536, resource.RLIM_INFINITY))
            os.setgroups([])
            os.setgid(65534)
            os.setuid(65534)
            check()
            code = 0
        except BaseException:
            print(traceback.format_exc(), end="")
        finally:
            sys.stdout.flush()
            os._exit(code)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def test_a_user_gets_priority_and_core_but_not_for_threads_started_later():
    def check():
        assert enter_realtime(Realtime(priority=50, cpu=0)) == []
        assert os.sched_getscheduler(0) == os.SCHED_FIFO | os.SCHED_RESET_ON_FORK
        assert os.sched_getparam(0).sched_priority == 50
        assert os.sched_getaffinity(0) == {0}
        thread = threading.Thread(target=lambda: reported.append(os.sched_getscheduler(0)))
        thread.start()
        thread.join()
        assert reported == [os.SCHED_OTHER]

    reported = []
    as_nobody(check)


def test_more_than_the_limit_is_refused_and_reported():
    def check():
        (warning,) = enter_realtime(Realtime(priority=51, lock_memory=False))
        assert "SCHED_FIFO at priority 51: Operation not permitted (ulimit -r is 50; LimitRTPRIO=51 in the unit)" in warning

    as_nobody(check)


def test_a_bank_is_locked_page_by_page_as_it_is_touched():
    """The whole mapping is accounted as locked, but only what is read is in memory, and stays."""
    with tempfile.TemporaryFile(dir="/mnt") as file:
        file.truncate(BANK_BYTES)

        def check():
            assert enter_realtime(Realtime(priority=0)) == []
            locked_kb, resident_kb = status("VmLck"), status("VmRSS")
            with mmap.mmap(file.fileno(), BANK_BYTES, prot=mmap.PROT_READ) as bank:
                assert status("VmLck") - locked_kb >= BANK_BYTES // 1024
                assert status("VmRSS") - resident_kb < 20_000
                assert sum(bank[0 : 40 << 20 : mmap.PAGESIZE]) == 0
                print(f"VmLck {status('VmLck')} kB, VmRSS {resident_kb} -> {status('VmRSS')} kB")
                assert 30_000 < status("VmRSS") - resident_kb < 80_000

        as_nobody(check)

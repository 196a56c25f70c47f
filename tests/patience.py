"""How long tests wait: not by the wall clock, which says how busy the machine is, but by the time that it had to spare.

A wait ends when what is waited for has had its chance: the processors were idle, or worked for it, for this many seconds. Other
work on the machine does not count, so the same wait is right on a quiet and on an overloaded machine.

usage: patience.py PID LOG SECONDS     ends a process that has nothing more to say in its log
"""

import contextlib
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

TICKS_HZ = os.sysconf("SC_CLK_TCK")
IDLE_FIELDS = slice(4, 6)  # of a line of /proc/stat: idle, and waiting for a disk
PROCESS_FIELDS = slice(11, 15)  # of /proc/PID/stat behind the name: user, system, and of children that have ended
FORCE_S = 20.0  # that a process may have to spare between being asked to end and being killed


def idle_s():
    """Seconds since boot that a processor had nothing to do; the mean of all."""
    lines = Path("/proc/stat").read_text().splitlines()
    processors = sum(line.startswith("cpu") for line in lines) - 1
    return sum(map(int, lines[0].split()[IDLE_FIELDS])) / TICKS_HZ / processors


def processor_s(pid):
    """Seconds of processor time that a process and its ended children have used; 0 when there is no such process."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except (FileNotFoundError, ProcessLookupError):
        return 0.0
    return sum(map(int, fields[PROCESS_FIELDS])) / TICKS_HZ


def spare_s():
    """Seconds that the machine had to spare for this process: idle processors, and the process's own work."""
    return idle_s() + processor_s(os.getpid())


class SpareTime:
    """In place of the module `time` for a link whose peer is a thread of this process: only time to spare passes."""

    monotonic = staticmethod(spare_s)
    perf_counter_ns = staticmethod(time.perf_counter_ns)


class Patience:
    """So many seconds to spare, from now on.

    Parameters
    ----------
    seconds : float
        Of idle processors, or of work by these processes.
    pids : tuple of int
        Processes that are waited for, besides this one.
    """

    def __init__(self, seconds, *pids):
        self._seconds = seconds
        self._pids = (os.getpid(), *pids)
        self.begin()

    def begin(self):
        """Count from now on."""
        self._from_s = self._now_s()

    @property
    def over(self):
        """Whether that much was spared."""
        return self._now_s() - self._from_s > self._seconds

    def _now_s(self):
        return idle_s() + sum(processor_s(pid) for pid in self._pids)


def wait_for(what, condition, seconds=60.0, said=lambda: "", every_s=0.05):
    """Until a condition holds, which is looked at so often; its value.

    Raises
    ------
    AssertionError
        When patience is over, with what was waited for and what `said` gives.
    """
    patience = Patience(seconds)
    while not (value := condition()):
        assert not patience.over, f"waited {seconds} s to spare for {what}\n{said()}"
        time.sleep(every_s)
    return value


def communicate(process, seconds=60.0):
    """Output and errors of a process that ends by itself.

    Raises
    ------
    AssertionError
        When it does not, though it could have; it is killed then.
    """
    patience = Patience(seconds, process.pid)
    while True:
        try:
            return process.communicate(timeout=1.0)
        except subprocess.TimeoutExpired:
            if patience.over:
                process.kill()
                out, err = process.communicate()
                raise AssertionError(f"did not end: {out or ''}\n{err or ''}") from None


def end_when_silent(pid, log, seconds):
    """End a process once so much time was spared without a byte more in its log; return when it has ended.

    It is asked first, and killed if it could have followed and has not.
    """
    patience, size, way = Patience(seconds, pid), -1, signal.SIGTERM
    while _running(pid):
        if log.stat().st_size != size and way == signal.SIGTERM:
            size = log.stat().st_size
            patience.begin()
        if patience.over:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, way)
            patience, way = Patience(FORCE_S, pid), signal.SIGKILL
        time.sleep(0.1)


def _running(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


if __name__ == "__main__":
    end_when_silent(int(sys.argv[1]), Path(sys.argv[2]), float(sys.argv[3]))

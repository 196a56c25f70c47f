"""What the kernel is asked for where it is refused (tests/kernel: where it is permitted)."""

import subprocess
import sys

from tables import each_row

from controller.device.service.realtime import group_refusal


def in_a_process_without_rights(code):
    """Printed by code run as nobody, with no limit left to raise."""
    prelude = """
import os, resource
from math import inf
import numpy
from controller.device.board.devices import Realtime
from controller.device.service.realtime import enter_realtime, one_blas_thread
resource.setrlimit(resource.RLIMIT_RTPRIO, (0, 0))
resource.setrlimit(resource.RLIMIT_MEMLOCK, (65536, 65536))
if os.getuid() == 0:
    os.setgroups([]); os.setgid(65534); os.setuid(65534)
"""
    done = subprocess.run([sys.executable, "-c", prelude + code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_where_it_is_not_permitted_one_line_says_what_and_what_to_do():
    printed = in_a_process_without_rights("""
print(*enter_realtime(Realtime(priority=40, cpu=1023)), sep="\\n")
assert os.sched_getscheduler(0) == os.SCHED_OTHER
numpy.zeros(40_000_000 // 8)  # more than the limit: it must not have become unobtainable
""")
    assert printed.count("\n") == 1
    assert "SCHED_FIFO at priority 40: Operation not permitted (ulimit -r is 0; LimitRTPRIO=40 in the unit)" in printed
    assert "core 1023: Invalid argument" in printed
    assert "memory is not locked (ulimit -l is 64 KiB; LimitMEMLOCK=infinity in the unit)" in printed


@each_row(
    ("groups", "files", "said"),
    [
        (
            "4:memory:/\n3:cpu,cpuacct:/system.slice/haptic-panel.service\n",
            {"sys/fs/cgroup/cpu,cpuacct/system.slice/haptic-panel.service/cpu.rt_runtime_us": "0\n"},
            "/system.slice/haptic-panel.service/cpu.rt_runtime_us is 0: give the group a share",
        ),
        ("1:cpu:/pod\n", {"sys/fs/cgroup/cpu/pod/cpu.rt_runtime_us": "0\n"}, "/cpu/pod/cpu.rt_runtime_us is 0"),
        ("1:cpu:/pod\n", {"sys/fs/cgroup/cpu/pod/cpu.rt_runtime_us": "950000\n"}, "in the control group /pod"),
        (
            "0::/system.slice/haptic-panel.service\n",
            {},
            "in the control group /system.slice/haptic-panel.service: start the kernel",
        ),
        ("0::/\n", {}, "seccomp profile"),
        ("", {}, "seccomp profile"),
    ],
)
def test_a_refusal_in_spite_of_every_right_names_the_control_group(tmp_path, groups, files, said):
    for name, text in ({"proc/self/cgroup": groups} | files).items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    why = group_refusal(tmp_path)
    assert said in why
    assert ("RT_GROUP_SCHED" in why) == ("control group" in said or "rt_runtime_us" in said)


def test_the_control_group_is_looked_at_where_the_limit_permits_the_priority():
    """The kernel's refusal is that of one with RT_GROUP_SCHED: EPERM."""
    printed = in_a_process_without_rights("""
def refuse(*_): raise PermissionError(1, "Operation not permitted")
os.sched_setscheduler = refuse
resource.getrlimit = lambda _: (50, 50)
print(*enter_realtime(Realtime(priority=50, lock_memory=False)))
""")
    assert "SCHED_FIFO at priority 50: Operation not permitted (the limits permit it" in printed
    assert "LimitRTPRIO" not in printed


def test_what_is_not_asked_for_is_not_warned_of():
    assert in_a_process_without_rights("print(enter_realtime(Realtime(priority=0, lock_memory=False)))") == "[]\n"


def test_blas_is_left_one_thread():
    """Asked from the library itself; two threads beforehand, whatever the machine has."""
    printed = in_a_process_without_rights("""
import ctypes
reported = one_blas_thread()
library = ctypes.CDLL(reported[0])
asked = next(name for name in ("scipy_openblas_get_num_threads64_", "scipy_openblas_get_num_threads",
                               "openblas_get_num_threads64_", "openblas_get_num_threads") if hasattr(library, name))
get, set = getattr(library, asked), getattr(library, asked.replace("get", "set"))
set(2)
assert get() == 2
enter_realtime(Realtime(priority=0, lock_memory=False))
print(get(), os.environ["OPENBLAS_NUM_THREADS"])
""")
    assert printed == "1 1\n"

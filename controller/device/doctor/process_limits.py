"""Whether the service may have the real-time priority and the locked memory that its board asks for."""

from __future__ import annotations

import math
import os
import resource
from dataclasses import dataclass

from controller.device.board.devices import Realtime
from controller.device.board.paths import SERVICE
from controller.errors import ConfigError
from controller.programs import ProgramError, run_program

MEMORY_BYTES = 64 << 20  # that the service locks: interpreter, libraries, and the waveforms of a scene
ASK_S = 10.0  # for an answer of systemd


@dataclass(frozen=True, slots=True)
class Allowed:
    """Limits of a user: highest real-time priority, and memory that may be locked, in bytes."""

    whose: str
    priority: float
    memory_bytes: float


def this_process_may() -> Allowed:
    """Limits of this process."""
    priority, memory_bytes = (
        math.inf if os.geteuid() == 0 or soft == resource.RLIM_INFINITY else soft
        for soft, _ in map(resource.getrlimit, (resource.RLIMIT_RTPRIO, resource.RLIMIT_MEMLOCK))
    )
    return Allowed("this user", priority, memory_bytes)


def unit_allows() -> Allowed:
    """Limits of the service's unit, which are not those of a shell; raises ConfigError if systemd does not know them."""
    names = ("LoadState", "LimitRTPRIO", "LimitMEMLOCK")
    asked = ["systemctl", "show", *(f"--property={name}" for name in names), f"{SERVICE}.service"]
    try:
        said = run_program(asked, ASK_S, attempts=2).out
    except ProgramError as error:
        raise ConfigError(f"systemctl does not tell the limits of {SERVICE}.service ({error})") from None
    reported = dict(line.split("=", 1) for line in said.splitlines() if "=" in line)
    if reported.get("LoadState") != "loaded":
        raise ConfigError(f"{SERVICE}.service is not installed (systemd/README.md)")
    priority, memory_bytes = (math.inf if reported[name] == "infinity" else float(reported[name]) for name in names[1:])
    return Allowed("the unit", priority, memory_bytes)


def priority_in_words(realtime: Realtime, allowed: Allowed) -> str:
    """What of the priority is permitted; raises ConfigError, with what to do, if it is not what the board asks for."""
    if allowed.priority < realtime.priority:
        raise ConfigError(
            f"{allowed.whose} may ask for {allowed.priority:g}, the board for {realtime.priority}:"
            " LimitRTPRIO= in the unit, or limits.conf"
        )
    if realtime.cpu is not None and realtime.cpu not in os.sched_getaffinity(0):
        raise ConfigError(f"there is no core {realtime.cpu} for this user: set realtime.cpu to one of those there are")
    return f"SCHED_FIFO {realtime.priority} is permitted" if realtime.priority else "none is asked for"


def memory_in_words(realtime: Realtime, allowed: Allowed) -> str:
    """Whether locked memory is permitted; raises ConfigError, with what to do, if the board asks for it and it is not."""
    if not realtime.lock_memory:
        return "not asked for"
    if allowed.memory_bytes < MEMORY_BYTES:
        raise ConfigError(
            f"{allowed.whose} may lock {int(allowed.memory_bytes) >> 20} MiB, the service needs {MEMORY_BYTES >> 20}:"
            " LimitMEMLOCK= in the unit"
        )
    return "permitted"

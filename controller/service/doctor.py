"""Checks of a panel for `haptic-panel doctor`: each device, file and permission that the board needs, and what to do."""

from __future__ import annotations

import contextlib
import math
import os
import pwd
import resource
import stat
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import msgspec

from controller.bank.inspection import wrong_pitch
from controller.bank.lookup import find_bank
from controller.bank.reader import Bank
from controller.board.board import Board
from controller.board.devices import LinkSettings, Realtime
from controller.board.paths import SERVICE, service_user
from controller.board.relations import judge
from controller.board.touch_panels import LinuxInputTouch, RecordingTouch
from controller.errors import BankError, ConfigError, ControllerError, LinkError
from controller.fpga.frames import UPLOAD_BYTES
from controller.fpga.link import Link
from controller.scene.scene import load_scene
from controller.scene.scene_file import find_scene
from controller.service.drivers import open_link, open_panel
from controller.service.finding import Finding
from controller.service.installation import missing_package
from controller.service.prepare_scene import populate
from controller.service.raspberry_pi import look_at_pi
from controller.touch.recording import Recording

MEMORY_BYTES = 64 << 20  # that the service locks: interpreter, libraries, and the waveforms of a scene


@dataclass(frozen=True, slots=True)
class _Allowed:
    """Limits of a user: highest real-time priority, and memory that may be locked, in bytes."""

    whose: str
    priority: float
    memory_bytes: float


def look(board: Board, now_s: Callable[[], float]) -> list[Finding]:
    """Check everything that a board needs, without outputs and without disturbing a running service.

    For the service's board, root checks with the rights of the service's user and the limits of its unit.

    Parameters
    ----------
    board : Board
    now_s : callable
        The host's clock.
    """
    link = board.link
    user = service_user() if os.geteuid() == 0 and board.is_the_systems else None
    checks: list[tuple[str, Callable[[], str | Finding]]] = [("user", lambda: _user(board, user))]
    if link.kind == "spi":
        checks += [
            ("SPI device", lambda: _node(link.device)),
            ("spidev buffer", _buffer),
            ("GPIO lines", lambda: _lines(link)),
        ]
    elif link.kind == "serial":
        checks.append(("serial port", lambda: _opened(open_link(board, now_s), link.device)))
    checks += [("touch panel", lambda: _touch(board)), ("scene", lambda: _scene(board)), ("bank", lambda: _bank(board))]
    if board.temperature is not None:
        checks.append(("temperature", lambda: _temperature(board)))
    if link.kind != "simulated":
        checks.append(("responses", lambda: _responses(board)))
        allowed = _unit_allows if user else _this_process_may
        checks += [
            ("priority", lambda: _priority(board.realtime, allowed())),
            ("locked memory", lambda: _memory(board.realtime, allowed())),
        ]
    findings = [Finding("board.toml", True, odd, warns=True) for odd in judge(board).odd]
    with _rights_of(user):
        findings += [_tried(about, check) for about, check in checks]
    findings += look_at_pi(board)
    return [finding for finding in findings if finding.good or finding.about != "responses"]  # an invalid bank is reported once


def _tried(about: str, check: Callable[[], str | Finding]) -> Finding:
    try:
        found = check()
        return found if isinstance(found, Finding) else Finding(about, True, found)
    except (ControllerError, OSError) as error:
        return Finding(about, False, str(error))
    except ModuleNotFoundError as error:
        return Finding(about, False, missing_package(error.name) or f"{error}: may this user read where it is installed?")


@contextlib.contextmanager
def _rights_of(user: pwd.struct_passwd | None) -> Iterator[None]:
    """Run with the rights of another user; None: with this process's own."""
    if user is None:
        yield
        return
    own = os.getgroups(), os.getegid(), os.geteuid()
    os.setgroups(os.getgrouplist(user.pw_name, user.pw_gid))
    os.setegid(user.pw_gid)
    os.seteuid(user.pw_uid)
    try:
        yield
    finally:
        os.seteuid(own[2])
        os.setegid(own[1])
        os.setgroups(own[0])


def _user(board: Board, user: pwd.struct_passwd | None) -> str:
    """User whose rights are checked."""
    if user is not None:
        return f"looked at as {user.pw_name}, as which the service runs"
    if os.geteuid() == 0 and board.is_the_systems:
        raise ConfigError(f"there is no user {SERVICE}, as which the service runs: install it (systemd/README.md)")
    try:
        name = pwd.getpwuid(os.geteuid()).pw_name
    except KeyError:
        name = str(os.geteuid())
    return f"looked at as {name}" + ("" if name == SERVICE or not board.is_the_systems else f"; the service runs as {SERVICE}")


def _opened(link: Link, device: str) -> str:
    link.close()
    return f"{device} opens"


def _node(device: str) -> str:
    try:
        mode = os.stat(device).st_mode  # noqa: PTH116 - os.stat takes the text as it is
    except OSError as error:
        raise LinkError(f"there is no {device} ({error.strerror}): switch SPI on, on a Raspberry Pi by dtparam=spi=on") from None
    if not stat.S_ISCHR(mode):
        raise LinkError(f"{device} is no device: was it made by hand?")
    if not os.access(device, os.R_OK | os.W_OK, effective_ids=True):
        raise LinkError(f"{device} may not be opened by this user: add it to the group that owns the device (on Debian: spi)")
    return f"{device} may be opened"


def _buffer() -> str:
    from controller.fpga.spi_link import read_bufsiz

    bufsiz = read_bufsiz()
    if bufsiz >= 2 * UPLOAD_BYTES:
        return f"{bufsiz} bytes: an upload is one message"
    if bufsiz >= UPLOAD_BYTES:
        return f"{bufsiz} bytes: an upload is two messages; with bufsiz={2 * UPLOAD_BYTES} it would be one"
    raise LinkError(f"{bufsiz} bytes split an upload into many messages: put 'options spidev bufsiz=8192' into /etc/modprobe.d")


def _lines(link: LinkSettings) -> str:
    import gpiod

    from controller.board.gpio_chip import find_chip
    from controller.fpga.gpio_lines import CONSUMER

    path = find_chip(link.gpio_chip, LinkError)
    wanted = [name for name in (link.trigger_line, link.configured_line, link.permit_line) if name]
    with gpiod.Chip(str(path)) as chip:
        for name in wanted:
            try:
                info = chip.get_line_info(name)
            except OSError:
                raise LinkError(f"GPIO chip {link.gpio_chip!r} has no line named {name!r}: gpioinfo lists them") from None
            if info.used and info.consumer != CONSUMER:
                raise LinkError(f"line {name!r} is in use by {info.consumer or 'the kernel'}: end it, or choose another line")
    return f"{', '.join(wanted)} on {link.gpio_chip}"


def _touch(board: Board) -> str:
    touch = board.touch
    if isinstance(touch, RecordingTouch):
        file = board.beside(touch.recording)
        return f"recording {Recording.open(file).name}"
    if isinstance(touch, LinuxInputTouch):
        board = msgspec.structs.replace(board, touch=msgspec.structs.replace(touch, grab=False))
    panel = open_panel(board)
    try:
        return f"{touch.__struct_config__.tag} answers"
    finally:
        panel.close()


def _scene(board: Board) -> str:
    file = find_scene(board)
    load_scene(file, board)
    return str(file)


def _bank(board: Board) -> str:
    found, scene_file = find_bank(board), find_scene(board)
    path = found.path
    with Bank.open(path, board) as bank:
        if wrong := wrong_pitch(bank, board):
            raise BankError(f"{path}: {wrong}; rebuild it: {bank.rebuild}")
        cells = populate(bank, load_scene(scene_file, board), str(scene_file), responses=True)
    return f"{path}, {cells:,} cells of the scene; {found.why}"


def _responses(board: Board) -> str | Finding:
    """Whether the bank was computed from measured or modelled responses."""
    with Bank.open(find_bank(board).path) as bank:
        provenance = bank.header.provenance
    if provenance and provenance.from_measurements:
        return f"the bank's responses are {provenance.in_words()}"
    said = "the bank was computed from a model of the plate: it moves the panel, but a real one is not focused by it (README.md)"
    return Finding("responses", True, said, warns=True)


def _temperature(board: Board) -> str:
    from controller.service.temperature import Thermometer

    assert board.temperature is not None
    thermometer = Thermometer(board.temperature)
    thermometer.scale(0.0)
    thermometer.close()
    if thermometer.cause:
        raise ConfigError(thermometer.cause)
    return f"{thermometer.temperature_c:g} °C"


def _this_process_may() -> _Allowed:
    priority, memory_bytes = (
        math.inf if os.geteuid() == 0 or soft == resource.RLIM_INFINITY else soft
        for soft, _ in map(resource.getrlimit, (resource.RLIMIT_RTPRIO, resource.RLIMIT_MEMLOCK))
    )
    return _Allowed("this user", priority, memory_bytes)


def _unit_allows() -> _Allowed:
    """Limits of the service's unit, which are not those of a shell."""
    names = ("LoadState", "LimitRTPRIO", "LimitMEMLOCK")
    asked = ["systemctl", "show", *(f"--property={name}" for name in names), f"{SERVICE}.service"]
    try:
        said = subprocess.run(asked, capture_output=True, text=True, check=True, timeout=10).stdout
    except (OSError, subprocess.SubprocessError) as error:
        raise ConfigError(f"systemctl does not tell the limits of {SERVICE}.service ({error})") from None
    told = dict(line.split("=", 1) for line in said.splitlines() if "=" in line)
    if told.get("LoadState") != "loaded":
        raise ConfigError(f"{SERVICE}.service is not installed (systemd/README.md)")
    priority, memory_bytes = (math.inf if told[name] == "infinity" else float(told[name]) for name in names[1:])
    return _Allowed("the unit", priority, memory_bytes)


def _priority(realtime: Realtime, allowed: _Allowed) -> str:
    if allowed.priority < realtime.priority:
        raise ConfigError(
            f"{allowed.whose} may ask for {allowed.priority:g}, the board for {realtime.priority}:"
            " LimitRTPRIO= in the unit, or limits.conf"
        )
    if realtime.cpu is not None and realtime.cpu not in os.sched_getaffinity(0):
        raise ConfigError(f"there is no core {realtime.cpu} for this user: set realtime.cpu to one of those there are")
    return f"SCHED_FIFO {realtime.priority} is permitted" if realtime.priority else "none is asked for"


def _memory(realtime: Realtime, allowed: _Allowed) -> str:
    if not realtime.lock_memory:
        return "not asked for"
    if allowed.memory_bytes < MEMORY_BYTES:
        raise ConfigError(
            f"{allowed.whose} may lock {int(allowed.memory_bytes) >> 20} MiB, the service needs {MEMORY_BYTES >> 20}:"
            " LimitMEMLOCK= in the unit"
        )
    return "permitted"

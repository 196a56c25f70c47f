"""What of a panel works, what does not, and what to do: everything that the board names, and the link to its FPGA."""

from __future__ import annotations

import math
import os
import resource
import stat
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import gpiod
import msgspec
import numpy as np

from controller.bank.location import bank_path
from controller.bank.reader import Bank
from controller.board import Board
from controller.clocks import Clock
from controller.device_settings import LinkSettings, LinuxInputTouch, Realtime, RecordingTouch
from controller.errors import ConfigError, ControllerError, LinkError
from controller.fpga import bring_up
from controller.fpga.capture import Capture
from controller.fpga.frames import UPLOAD_BYTES
from controller.fpga.gpio_lines import CONSUMER
from controller.fpga.link import Link
from controller.fpga.link_check import counted, error_rate_bound, measured_hz, proposed_hz, sweep
from controller.fpga.session import Session
from controller.fpga.simulated_link import SimulatedLink
from controller.fpga.spi_link import SpiLink, read_bufsiz
from controller.gpio_chip import find_chip
from controller.hardware import open_link, open_panel
from controller.scene import load_scene
from controller.scene_file import find_scene
from controller.temperature import Thermometer
from controller.touch.recording import Recording

SWEEP_SHARE = 0.1  # of the bits, at each speed of the sweep
MEMORY_BYTES = 64 << 20  # that the service locks: interpreter, libraries, and a scene's entries


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing looked at: what it is, whether it is as it should be, and what was found or is to be done."""

    about: str
    good: bool
    said: str


def look(board: Board, now_s: Callable[[], float]) -> list[Finding]:
    """Look at everything that a board names, without moving anything or disturbing a service that runs."""
    link = board.link
    checks: list[tuple[str, Callable[[], str]]] = []
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
        temperature = board.temperature
        checks.append(("temperature", lambda: _temperature(Thermometer(temperature))))
    if link.kind != "simulated":
        checks += [("priority", lambda: _priority(board.realtime)), ("locked memory", lambda: _memory(board.realtime))]
    return [_tried(about, check) for about, check in checks]


@dataclass(frozen=True, slots=True)
class LinkExamined:
    """What `doctor --link` found."""

    findings: list[Finding]
    figures: dict[str, Any]


def examine_link(
    board: Board,
    link: Link,
    open_session: Callable[[], Session],
    clock: Clock,
    bits: float,
    channels: Sequence[int],
    progress: Callable[[int, int], None] = lambda *_: None,
) -> LinkExamined:
    """Everything about the link: identity, bits there and back, memory, channels, and the SCK that its wires carry.

    Parameters
    ----------
    open_session : callable
        Brings up what is at the other end.
    bits : float
        Random bits to send at least.
    channels : sequence of int
        To chirp on; outputs are on meanwhile. Empty: they stay off.
    """
    findings: list[Finding] = []
    figures: dict[str, Any] = {}
    take_capture: Callable[[], Capture] | None = link.take_capture if isinstance(link, SimulatedLink) else None
    try:
        session = open_session()
        findings.append(Finding("identity and settings", True, "the gateware of this software; each setting was read back"))
        if isinstance(link, SpiLink | SimulatedLink):
            findings.append(_swept(board, session, link, max(bits * SWEEP_SHARE, 1), figures, progress))
            if not findings[-1].good:
                return LinkExamined(findings, figures)
        done = bring_up.check(session, board, clock, bits, channels, progress=progress, take_capture=take_capture)
    except ControllerError as error:
        return LinkExamined([*findings, Finding("link", False, str(error))], figures)
    sent, errors = counted(done.bit_errors)
    bound = error_rate_bound(errors, sent)
    figures["bit_errors"] = asdict(done.bit_errors) | {"error_rate_at_most": bound, "confidence": 0.95}
    figures["registers"] = done.registers
    findings.append(
        Finding("bits", not errors, f"{errors} errors in {sent:,} bits: fewer than {bound:.1e} of them are wrong (95 %)")
    )
    if isinstance(link, SpiLink):
        figures["sck_measured_hz"] = _finite(measured_hz(session, link))
        figures["effective_hz"] = link.effective_hz
    findings += [Finding("board", False, complaint) for complaint in done.complaints]
    if not done.complaints:
        seen = "" if take_capture is None else ", each moved its own pin"
        chirped = f"{len(done.channels)} channels chirped{seen}" if channels else "no channel was asked for"
        findings.append(Finding("board", True, f"{done.slots} slots keep what they are given; {chirped}"))
    return LinkExamined(findings, figures)


def _swept(
    board: Board,
    session: Session,
    link: SpiLink | SimulatedLink,
    bits: float,
    figures: dict[str, Any],
    progress: Callable[[int, int], None],
) -> Finding:
    """Errors at each SCK; the link is left at the one that is proposed."""
    speeds = sweep(session, link, board.link.sck_hz, bits, np.random.default_rng(bring_up.SEED), progress)
    proposal_hz = proposed_hz(speeds)
    figures["sweep"] = [asdict(speed) for speed in speeds]
    figures["proposed_sck_hz"] = proposal_hz
    rule = "the fastest without an error, at most 0.8 of the slowest with one"
    if proposal_hz is None:
        worst = next((speed.trouble for speed in speeds if speed.trouble), "bits are damaged even at the slowest")
        return Finding("SCK", False, f"no SCK carries every bit ({worst}): look at the wires")
    sck_hz = link.set_sck_hz(proposal_hz)
    if proposal_hz < board.link.sck_hz:
        return Finding("SCK", False, f"set link.sck_hz = {proposal_hz} ({rule}), or shorten the wires and join the grounds")
    return Finding("SCK", True, f"{sck_hz / 1e6:g} MHz as the board says; no error from {speeds[0].sck_hz / 1e6:g} MHz on")


def _tried(about: str, check: Callable[[], str]) -> Finding:
    try:
        return Finding(about, True, check())
    except (ControllerError, OSError) as error:
        return Finding(about, False, str(error))


def _opened(link: Link, device: str) -> str:
    link.close()
    return f"{device} opens"


def _node(device: str) -> str:
    try:
        mode = os.stat(device).st_mode  # noqa: PTH116 - a Path says the same in more words
    except OSError as error:
        raise LinkError(f"there is no {device} ({error.strerror}): switch SPI on, on a Raspberry Pi by dtparam=spi=on") from None
    if not stat.S_ISCHR(mode):
        raise LinkError(f"{device} is no device: was it made by hand?")
    if not os.access(device, os.R_OK | os.W_OK):
        raise LinkError(f"{device} may not be opened by this user: add it to the group that owns the device (on Debian: spi)")
    return f"{device} may be opened"


def _buffer() -> str:
    bufsiz = read_bufsiz()
    if bufsiz >= 2 * UPLOAD_BYTES:
        return f"{bufsiz} bytes: an upload is one message"
    if bufsiz >= UPLOAD_BYTES:
        return f"{bufsiz} bytes: an upload is two messages; with bufsiz={2 * UPLOAD_BYTES} it would be one"
    raise LinkError(f"{bufsiz} bytes split an upload into many messages: put 'options spidev bufsiz=8192' into /etc/modprobe.d")


def _lines(link: LinkSettings) -> str:
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
        file = board.folder / touch.recording
        return f"recording {Recording.open(file).name}"
    if isinstance(touch, LinuxInputTouch):
        board = msgspec.structs.replace(board, touch=msgspec.structs.replace(touch, grab=False))
    panel = open_panel(board)
    try:
        return f"{type(touch).__name__.removesuffix('Touch').lower()} answers"
    finally:
        panel.close()


def _scene(board: Board) -> str:
    file = find_scene(board, board.scene)
    load_scene(file, board)
    return str(file)


def _bank(board: Board) -> str:
    path = bank_path(board.name, find_scene(board, board.scene).stem)
    if not path.exists():
        raise ConfigError(f"there is no {path} yet: haptic-panel bank build --board {board.called} --scene {board.scene}")
    with Bank.open(path, board):
        return str(path)


def _temperature(thermometer: Thermometer) -> str:
    thermometer.scale(0.0)
    thermometer.close()
    if thermometer.cause:
        raise ConfigError(thermometer.cause)
    return f"{thermometer.temperature_c:g} °C"


def _priority(realtime: Realtime) -> str:
    allowed, _ = resource.getrlimit(resource.RLIMIT_RTPRIO)
    if os.geteuid() != 0 and allowed != resource.RLIM_INFINITY and allowed < realtime.priority:
        raise ConfigError(
            f"this user may ask for {allowed}, the board for {realtime.priority}: LimitRTPRIO= in the unit, or limits.conf"
        )
    if realtime.cpu is not None and realtime.cpu not in os.sched_getaffinity(0):
        raise ConfigError(f"there is no core {realtime.cpu} for this user: set realtime.cpu to one of those there are")
    return f"SCHED_FIFO {realtime.priority} is permitted" if realtime.priority else "none is asked for"


def _memory(realtime: Realtime) -> str:
    allowed, _ = resource.getrlimit(resource.RLIMIT_MEMLOCK)
    if not realtime.lock_memory:
        return "not asked for"
    if os.geteuid() != 0 and allowed != resource.RLIM_INFINITY and allowed < MEMORY_BYTES:
        raise ConfigError(
            f"this user may lock {allowed >> 20} MiB, the service needs {MEMORY_BYTES >> 20}: LimitMEMLOCK= in the unit"
        )
    return "permitted"


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None

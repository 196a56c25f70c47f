"""Checks of a panel for `haptic-panel doctor`: each device, file and permission that the board needs, and what to do."""

from __future__ import annotations

import os
import pwd
import stat
from collections.abc import Callable
from functools import partial

from controller.device.bank.inspection import wrong_pitch
from controller.device.bank.lookup import find_bank
from controller.device.bank.provenance import why_unknown
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.board.devices import LinkSettings
from controller.device.board.identity import panel_identity
from controller.device.board.paths import SERVICE, service_user
from controller.device.board.relations.checked import judge
from controller.device.doctor.finding import Finding
from controller.device.doctor.process_limits import memory_in_words, priority_in_words, this_process_may, unit_allows
from controller.device.doctor.raspberry_pi import look_at_pi
from controller.device.doctor.touch_check import OpenPanel, look_at_touch_panel
from controller.device.fpga.bitstreams.bitstream import read_identity
from controller.device.fpga.frames import UPLOAD_BYTES
from controller.device.fpga.links.link import Link
from controller.device.scene.scene import load_scene
from controller.device.scene.scene_file import find_scene
from controller.device.service.drivers import bitstream_path, open_link, open_panel
from controller.device.service.installation import missing_package
from controller.device.service.scenes.prepare_scene import populate
from controller.errors import BankError, ConfigError, ControllerError, LinkError

WATCHED = ("ecp5", "gowin")  # families whose top.v has a second clock


def look(board: Board, now_s: Callable[[], float], opened: OpenPanel = open_panel) -> list[Finding]:
    """Check everything that a board needs, without outputs and without disturbing a running service.

    For the service's board, its user checks with the limits of the unit; what root calls runs as that user (systemd/haptic-panel).
    """
    link = board.link
    service = service_user() if board.is_the_systems else None
    as_the_service = service is not None and service.pw_uid == os.geteuid()
    checks: list[tuple[str, Callable[[], str | Finding]]] = [("user", lambda: _user(board, as_the_service=as_the_service))]
    if link.kind == "spi":
        of_each = {f"SPI device of FPGA {number}": one.device for number, one in enumerate(link.fpga)}
        checks += [
            *((about, partial(_node, device)) for about, device in (of_each or {"SPI device": link.device}).items()),
            ("spidev buffer", _buffer),
            ("GPIO lines", lambda: _lines(link)),
        ]
    elif link.kind == "serial":
        checks.append(("serial port", lambda: _opened(open_link(board, now_s), link.device)))
    checks += [
        ("touch panel", lambda: look_at_touch_panel(board, now_s, opened)),
        ("scene", lambda: _scene(board)),
        ("bank", lambda: _bank(board)),
    ]
    if board.temperature is not None:
        checks.append(("temperature", lambda: _temperature(board)))
    if link.kind != "simulated" and bitstream_path(board).is_file():
        checks.append(("lost clock", lambda: _lost_clock(board)))
    if link.kind != "simulated":
        checks.append(("responses", lambda: _responses(board)))
        allowed = unit_allows if as_the_service else this_process_may
        checks += [
            ("priority", lambda: priority_in_words(board.realtime, allowed())),
            ("locked memory", lambda: memory_in_words(board.realtime, allowed())),
        ]
    findings = [Finding("board.toml", True, odd, warns=True) for odd in judge(board).odd]
    findings += [*(_tried(about, check) for about, check in checks), *look_at_pi(board)]
    return [finding for finding in findings if finding.good or finding.about != "responses"]  # an invalid bank is reported once


def _tried(about: str, check: Callable[[], str | Finding]) -> Finding:
    try:
        found = check()
        return found if isinstance(found, Finding) else Finding(about, True, found)
    except (ControllerError, OSError) as error:
        return Finding(about, False, str(error))
    except ModuleNotFoundError as error:
        return Finding(about, False, missing_package(error.name) or f"{error}: may this user read where it is installed?")


def _user(board: Board, *, as_the_service: bool) -> str | Finding:
    """User whose rights are checked."""
    try:
        name = pwd.getpwuid(os.geteuid()).pw_name
    except KeyError:
        name = str(os.geteuid())
    said = f"looked at as {name}"
    if as_the_service:
        return f"{said}, as which the service runs"
    if not board.is_the_systems:
        return said
    if service_user() is None:
        raise ConfigError(f"there is no user {SERVICE}, as which the service runs: install it (systemd/README.md)")
    return Finding("user", True, f"{said}; the service runs as {SERVICE}, and may do other things", warns=True)


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
    from controller.device.fpga.links.spi_device import read_bufsiz

    bufsiz = read_bufsiz()
    if bufsiz >= 2 * UPLOAD_BYTES:
        return f"{bufsiz} bytes: an upload is one message"
    if bufsiz >= UPLOAD_BYTES:
        return f"{bufsiz} bytes: an upload is two messages; with bufsiz={2 * UPLOAD_BYTES} it would be one"
    raise LinkError(f"{bufsiz} bytes split an upload into many messages: put 'options spidev bufsiz=8192' into /etc/modprobe.d")


def _lines(link: LinkSettings) -> str:
    import gpiod

    from controller.device.board.gpio_chip import find_chip, find_lines
    from controller.device.fpga.links.gpio_lines import CONSUMER

    path = find_chip(link.gpio_chip, LinkError)
    wanted = [line for line in (link.trigger_line, *link.configured_lines, link.permit_line) if line]
    with gpiod.Chip(str(path)) as chip:
        for line, number in find_lines(chip, link.gpio_chip, wanted, LinkError).items():
            info = chip.get_line_info(number)
            if info.used and info.consumer != CONSUMER:
                raise LinkError(f"line {line!r} is in use by {info.consumer or 'the kernel'}: end it, or choose another line")
    return f"{', '.join(wanted)} on {link.gpio_chip}"


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


def _lost_clock(board: Board) -> str | Finding:
    """Whether the FPGA itself finds out that its clock has stopped, where the PLL does not say so."""
    device = read_identity(bitstream_path(board)).device
    if device.startswith(WATCHED):
        return "the FPGA's own oscillator watches its clocks"
    said = (
        f"nothing in this FPGA ({device}) watches its clock: the 60 V need the pump of hv_alive, off within 10 ms of its last edge"
    )
    return Finding("lost clock", True, said, warns=True)


def _responses(board: Board) -> str | Finding:
    """Whether the bank was computed from measured or modelled responses."""
    with Bank.open(find_bank(board).path) as bank:
        provenance = bank.header.provenance
    if provenance and provenance.from_measurements:
        said = f"the bank's responses are {provenance.in_words()}"
        unknown = "" if board.link.kind == "simulated" else why_unknown(provenance, panel_identity())
        return Finding("responses", True, f"{said}; {unknown}", warns=True) if unknown else said
    said = "the bank was computed from a model of the plate: it moves the panel, but a real one is not focused by it (README.md)"
    return Finding("responses", True, said, warns=True)


def _temperature(board: Board) -> str:
    from controller.device.service.temperature import Thermometer

    assert board.temperature is not None
    thermometer = Thermometer(board.temperature)
    thermometer.scale(0.0)
    thermometer.close()
    if thermometer.cause:
        raise ConfigError(thermometer.cause)
    return f"{thermometer.temperature_c:g} °C"

"""`doctor` on a Raspberry Pi: settings of firmware and kernel on which SCK and the loop's latency depend."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from controller.device.board.board import Board
from controller.device.board.touch_panels import I2cTouch
from controller.device.doctor.finding import Finding
from controller.device.fpga.frames import LOAD_FRAME_BYTES
from controller.programs import ProgramError, last_line, run_program

PAGE = "boards/raspberry_pi.md"
ASK_S = 10.0  # for an answer of the firmware
CMDLINE = "cmdline.txt in /boot/firmware"
POLLED_CLOCKS = 9  # of SCK for a byte, where spi-bcm2835 polls
POLLING_LIMIT_US = 250  # more than a LOAD frame takes at 25 MHz, with room for 19 MHz
DMA_MENDED = (6, 6, 30)  # raspberrypi/linux #5696, #6020: the DMA of a Pi 5's SPI times out before
THROTTLED = ("under-voltage", "frequency capped", "throttled", "too hot")  # bits 0 to 3 now, 16 to 19 since the start


@dataclass(frozen=True, slots=True)
class _Model:
    """What differs between Raspberry Pis: clock of the SPI controller in MHz, and whether that is the firmware's core clock."""

    config_filter: str  # section of config.txt for it
    spi_source_mhz: int
    follows_core: bool


_PI_3, _PI_4, _PI_5 = _Model("pi3", 400, True), _Model("pi4", 500, True), _Model("pi5", 200, False)
_MODELS = (  # beginnings of /proc/device-tree/model behind "Raspberry Pi "
    (r"5|500|Compute Module 5", _PI_5),
    (r"4|400|Compute Module 4", _PI_4),
    (r"3|Compute Module 3|Zero 2", _PI_3),
)


def look_at_pi(board: Board, root: Path = Path("/")) -> list[Finding]:
    """Check what a Raspberry Pi's firmware and kernel say of their settings, for a board on SPI.

    What cannot be read is left out; on another machine there is nothing to find.

    `root` is that of the machine's files.
    """
    name = _name(root, "proc/device-tree/model")
    found = re.fullmatch(r"Raspberry Pi (.*)", name)
    if board.link.kind != "spi" or found is None:
        return []
    model = next((model for begins, model in _MODELS if re.match(rf"({begins})\b", found[1])), None)
    checks: list[Callable[[], Iterator[Finding]]] = [
        lambda: _kernel(root, name, model),
        lambda: _spi_source(board, model),
        lambda: _core_clock(root, model),
        lambda: _polling(root, board),
        lambda: _governor(root, board),
        lambda: _core(root, board),
        lambda: _throttled_by_scheduler(root, board),
        lambda: _throttled_by_firmware(root),
        lambda: _i2c(root, board),
    ]
    return [finding for check in checks for finding in check()]


def _read(root: Path, path: str) -> str:
    """Text of a file; empty where there is none."""
    try:
        return (root / path).read_text(errors="replace")
    except OSError:
        return ""


def _name(root: Path, path: str) -> str:
    """First line of a file, without what cannot be printed; empty where there is none."""
    return "".join(filter(str.isprintable, _read(root, path).strip("\0\n ").partition("\n")[0])).strip()


def _number(root: Path, path: str, base: int = 10) -> int | None:
    """Whole number that a file holds; None where there is none."""
    try:
        return int(_read(root, path).strip().replace(",", ""), base)
    except ValueError:
        return None


def _warned(about: str, said: str) -> Finding:
    return Finding(about, True, f"{said} ({PAGE})", warns=True)


def _kernel(root: Path, name: str, model: _Model | None) -> Iterator[Finding]:
    """Model and kernel; on a Pi 5 whether the kernel is one whose SPI times out."""
    release = _name(root, "proc/sys/kernel/osrelease")
    realtime = _read(root, "sys/kernel/realtime").strip() == "1"
    numbers = re.match(r"(\d+)\.(\d+)\.(\d+)", release)
    if model is _PI_5 and numbers and tuple(map(int, numbers.groups())) < DMA_MENDED:
        mended = ".".join(map(str, DMA_MENDED))
        said = f"Linux {release}: the DMA of its SPI times out above 64 bytes; take {mended} or newer: apt full-upgrade"
        yield Finding("kernel", False, f"{said} ({PAGE})")
        return
    yield Finding("kernel", True, f"Linux {release}{', PREEMPT_RT' if realtime else ''} on a {name}")


def _spi_source(board: Board, model: _Model | None) -> Iterator[Finding]:
    """Whether board.toml names the clock of this model's SPI controller."""
    given_hz = board.link.spi_source_hz
    if model is not None and given_hz is not None and given_hz != model.spi_source_mhz * 1_000_000:
        said = f"board.toml says {given_hz / 1e6:g} MHz, this model has {model.spi_source_mhz}"
        yield Finding("SPI clock", False, f"{said}: set link.spi_source_hz = {model.spi_source_mhz}_000_000")


def _core_clock(root: Path, model: _Model | None) -> Iterator[Finding]:
    """Whether config.txt holds the core clock, of which SCK is made on a Pi 3 or 4."""
    text = _read(root, "boot/firmware/config.txt") or _read(root, "boot/config.txt")
    if model is None or not model.follows_core or not text:
        return
    settings = _settings(text, model.config_filter)
    least_mhz = settings.get("core_freq_min", 0)
    if settings.get("force_turbo") == 1:
        yield Finding("core clock", True, "held by force_turbo=1, and SCK with it")
    elif least_mhz >= model.spi_source_mhz:
        yield Finding("core clock", True, f"held at {least_mhz} MHz or more, and SCK with it")
    else:
        said = f"follows the load, and SCK with it: put core_freq_min={model.spi_source_mhz} into config.txt in /boot/firmware"
        yield Finding("core clock", False, f"{said}, then restart ({PAGE})")


def _settings(text: str, model_filter: str) -> dict[str, int]:
    """Whole numbers that config.txt sets for a model; the last one of a name counts."""
    settings, section = {}, "all"
    for line in text.splitlines():
        if head := re.fullmatch(r"\s*\[(.*)\]\s*", line):
            section = head[1].strip().lower()
        elif (pair := re.match(r"\s*(\w+)\s*=\s*(\d+)\s*(#.*)?$", line)) and section in ("all", model_filter):
            settings[pair[1]] = int(pair[2])
    return settings


def _polling(root: Path, board: Board) -> Iterator[Finding]:
    """Whether spi-bcm2835 polls a LOAD frame, rather than sleep until an interrupt."""
    limit_us = _number(root, "sys/module/spi_bcm2835/parameters/polling_limit_us")
    if limit_us is None:
        return
    frame_us = POLLED_CLOCKS * LOAD_FRAME_BYTES / board.link.sck_hz * 1e6
    if limit_us > frame_us:
        yield Finding("SPI polling", True, f"up to {limit_us} µs: a LOAD frame of {frame_us:.0f} µs costs no interrupt")
    else:
        wanted = max(POLLING_LIMIT_US, int(frame_us * 1.3))
        said = f"up to {limit_us} µs: each LOAD frame of {frame_us:.0f} µs waits for an interrupt"
        yield _warned("SPI polling", f"{said}; add spi_bcm2835.polling_limit_us={wanted} to {CMDLINE}")


def _governor(root: Path, board: Board) -> Iterator[Finding]:
    """Whether the loop's core keeps its clock."""
    core = board.realtime.cpu or 0
    governor = _name(root, f"sys/devices/system/cpu/cpu{core}/cpufreq/scaling_governor")
    if governor == "performance":
        yield Finding("governor", True, "performance")
    elif governor:
        yield _warned(
            "governor", f"{governor}: a core that idled begins slowly; add cpufreq.default_governor=performance to {CMDLINE}"
        )


def _core(root: Path, board: Board) -> Iterator[Finding]:
    """Whether the loop has a core to itself, interrupts included."""
    core = board.realtime.cpu
    isolated = _numbers(_read(root, "sys/devices/system/cpu/isolated"))
    present = _numbers(_read(root, "sys/devices/system/cpu/present"))
    if len(present) < 2:
        return
    if core is None:
        advice = f"set realtime.cpu = {max(isolated)} in board.toml" if isolated else _isolation(max(present), board=True)
        yield _warned("isolated core", f"the loop shares its core: {advice}")
    elif core not in isolated:
        yield _warned("isolated core", f"core {core} runs other programs too: {_isolation(core)}")
    elif (_number(root, "proc/irq/default_smp_affinity", 16) or 0) >> core & 1:
        yield _warned("isolated core", f"core {core} takes interrupts of other devices too: {_isolation(core)}")
    else:
        yield Finding("isolated core", True, f"core {core} is the loop's own")


def _isolation(core: int, *, board: bool = False) -> str:
    others = f"0-{core - 1}" if core > 1 else "0" if core else "1-3"
    added = f"add isolcpus={core} irqaffinity={others} to {CMDLINE}"
    return f"{added}, and set realtime.cpu = {core} in board.toml" if board else added


def _numbers(text: str) -> set[int]:
    """Numbers of a list such as 0-2,5."""
    spans = re.findall(r"(\d+)(?:-(\d+))?", text)  # "(null)" in some kernels: none
    return {number for first, last in spans for number in range(int(first), int(last or first) + 1)}


def _throttled_by_scheduler(root: Path, board: Board) -> Iterator[Finding]:
    """Whether the kernel stops a real-time process that never sleeps."""
    runtime_us = _number(root, "proc/sys/kernel/sched_rt_runtime_us")
    period_us = _number(root, "proc/sys/kernel/sched_rt_period_us") or 1_000_000
    if not board.realtime.priority or runtime_us is None:
        return
    if runtime_us == -1:
        yield Finding("real-time limit", True, "none")
    else:
        share = runtime_us / period_us
        said = f"the kernel stops the loop for the rest of a second of which it has used {share:.0%}"
        yield _warned(
            "real-time limit", f"{said}; put kernel.sched_rt_runtime_us=-1 into /etc/sysctl.d, once it has a core of its own"
        )


def _throttled_by_firmware(root: Path) -> Iterator[Finding]:
    """Whether supply and cooling are enough."""
    command = root / "usr/bin/vcgencmd"
    if not os.access(command, os.X_OK):
        return
    try:
        said = run_program([command, "get_throttled"], ASK_S, attempts=2).out
    except ProgramError as error:
        yield _warned("supply and heat", f"not known: {error}; users of the group video may ask")
        return
    if not (found := re.search(r"throttled=0x([0-9a-fA-F]+)", said)):
        yield _warned("supply and heat", f"not known: {command} answers {last_line(said)!r}")
        return
    bits = int(found[1], 16)
    now = [what for bit, what in enumerate(THROTTLED) if bits >> bit & 1]
    before = [what for bit, what in enumerate(THROTTLED) if bits >> 16 + bit & 1]
    advice = "take the Pi's own supply, shorter wires, a heat sink"
    if now:
        yield Finding("supply and heat", False, f"{', '.join(now)} now: {advice} ({PAGE})")
    elif before:
        yield _warned("supply and heat", f"{', '.join(before)} since the start: {advice}")
    else:
        yield Finding("supply and heat", True, "enough since the start")


def _i2c(root: Path, board: Board) -> Iterator[Finding]:
    """Whether a touch panel is on the controller that does not wait for a device that stretches the clock."""
    if not isinstance(board.touch, I2cTouch):
        return
    adapter = _name(root, f"sys/class/i2c-dev/{Path(board.touch.bus).name}/name")
    if adapter.startswith("bcm2835"):
        said = f"{board.touch.bus} is the Pi's own controller, which damages bytes where a device stretches the clock"
        yield _warned("I2C clock", f"{said}: dtoverlay=i2c-gpio, or dtparam=i2c_arm_baudrate=50000, in config.txt")

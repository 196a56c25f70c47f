"""One thing broken at a time, at the pins of each compiled board, with the product's link, session and recovery as its host.

Each row measures what the outputs do, which fault the FPGA keeps and what the host makes of it; fpga_rtl/README.md has the same
table. The FPGA is set up for a heartbeat timeout of 5 ms and a ramp of 0.1 ms, which a host may do: the board's 100 and 10 ms
last long in Verilog.
"""

import contextlib
import re
from dataclasses import dataclass, field

import numpy as np
import pytest
from compiled_top import PS, UART, channel_pins, channels_of, files, signal_pins

from controller.device.board.lookup import data_folder
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.frames import Play, pack_nop
from controller.device.fpga.links.spi_link import SpiLink
from controller.device.fpga.recovery import Action, Recovery, action_for
from controller.device.fpga.registers import Fault, Register, State
from controller.device.fpga.session import Session
from controller.errors import ControllerError

pytestmark = pytest.mark.gateware

ULX3S = files("ulx3s").board
README = data_folder("fpga_rtl") / "README.md"
TIMEOUT_S = 5e-3
RAMP_SAMPLES = 50
BEAT_S = 1.5e-3
WATCHED_S = 8e-3  # longer than the timeout
AT_ONCE_S = 1e-3
WORDS = np.full(ULX3S.waveform.samples, 0x5555AAAA, "<u4")
COUNTERS = (Register.EMISSIONS, Register.TRIGGERS_IGNORED, Register.FRAME_ERRORS)
LOCK_LOST_PS = 300_000  # by the PLL's model
SHUT_CLOCKS = 4  # behind the pin: at once


@dataclass
class Seen:
    """What came of one fault."""

    outputs: str
    fault: Fault
    error: ControllerError | None
    state: str
    counts: dict[Register, int] = field(default_factory=dict)  # that someone could see
    host: str = ""  # where there is none, or it does not begin

    def row(self):
        """Cells of the README's table."""
        kept = ", ".join(f"`{flag.name}`" for flag in Fault if flag in self.fault) or "–"
        if self.host:
            return self.outputs, kept, self.host
        if self.error is None:
            return (
                self.outputs,
                kept,
                " ".join(["goes on", *(f"`{register.name}` {count}" for register, count in self.counts.items())]),
            )
        does = {Action.RETRY: "tries again", Action.WAIT_FOR_PERMIT: "waits", Action.FAIL: f"exit {self.error.exit_code}"}
        said = re.match(r"(?:outputs off: )?([^:,.]+)", str(self.error))[1]
        return self.outputs, kept, f"{self.state}, {does[action_for(self.error)]}: {said}"


class Host:
    """A Raspberry Pi that has armed the board and keeps it on; `breaks` happens, and it is watched for a while."""

    def __init__(self, pi):
        self.pi = pi
        self.board = pi.board
        self.outputs = sum(channel_pins()) | signal_pins()["hv_enable"]
        self.link = SpiLink(pi.files.board.link, pi.now_s)
        self.session = Session(self.link, pi.files.board, build_hash(data_folder("fpga_rtl")), pi.now_s)
        self.session.exchange.write(Register.HEARTBEAT_TICKS, round(TIMEOUT_S * pi.files.board.link.clock_hz))
        self.session.exchange.write(Register.RAMP_SAMPLES, RAMP_SAMPLES)
        self.recovery = Recovery(self.session, pi.files.board)
        self.error = None
        self.lows_ps = []  # times at which noise pulled a pin low
        self.arm()

    def arm(self):
        self.session.arm()
        for _ in range(20):
            if State.ARMED in self.session.heartbeat().state:
                return
            self.board.run(0.1e-3 * PS)
        raise AssertionError("it did not arm")

    def beat(self):
        """One heartbeat, and what the loop does with an error."""
        if self.error is None:
            try:
                self.session.heartbeat()
            except ControllerError as error:
                self.error = error
                with contextlib.suppress(type(error)):  # where the rule is to fail
                    self.recovery.begin(error, self.pi.now_s())

    def watch(self, breaks, *, beats=True, meanwhile=lambda: None, for_s=WATCHED_S, host=""):
        """What the outputs do from `breaks` on, while the host goes on as long as it can."""
        assert self.board.levels & self.outputs
        self.board.take()
        begin_ps = self.board.now_ps
        last_s = self.session._heartbeat_s
        breaks()
        while self.board.now_ps < begin_ps + for_s * PS:
            meanwhile()
            if beats:
                self.beat()
            self.board.run(min(BEAT_S, for_s / 2) * PS)
        times, pins = self.board.take()
        outputs = self.outputs_since(times, pins, begin_ps, last_s)
        return Seen(outputs, self.fault(), self.error, self.recovery.state.value, self.counts(), host)

    def outputs_since(self, times, pins, begin_ps, last_s):
        """In words, what they did."""
        on = (pins & np.uint64(self.outputs)) != 0
        if self.board.levels & self.outputs:
            return "stay on"
        off = len(on) - int(np.argmax(on[::-1])) if on.any() else 0
        off_ps = int(times[off])
        if not self.board.levels & signal_pins()["configured"]:
            return "off with the PLL's lock" if off_ps - begin_ps < LOCK_LOST_PS else "off within 3 µs"
        if off_ps - max([begin_ps, *(low for low in self.lows_ps if low <= off_ps)]) <= SHUT_CLOCKS * self.pi.files.clock_ps:
            return "off at once"
        if np.count_nonzero(np.diff(channels_of(pins[:off]))) > 4:
            return "ramp down"
        assert off_ps / PS - last_s == pytest.approx(TIMEOUT_S, abs=0.1e-3)
        return "off at the timeout"

    def counts(self):
        """Counters that have moved, if the host could read them."""
        if self.error is not None:
            return {}
        read = {register: self.session.exchange.read(register) for register in COUNTERS} if not self.fault() else {}
        return {register: count for register, count in read.items() if count}

    def fault(self):
        """Cause that the FPGA keeps, read when everything is whole again."""
        self.board.mend()
        self.pi.damage = lambda frame: frame
        self.board.run(2e-6 * PS)
        exchange = self.session.exchange
        for _ in range(3):
            end = pack_nop(exchange.sent, 0, exchange.sequence)
            try:
                return exchange.send_short(pack_nop(exchange.sent, end, exchange.sequence + 1), raise_faults=False).faults
            except ControllerError:
                continue
        raise AssertionError("no answer")

    def noise(self, pins, seed=3, changes=150):
        """Random levels for random times between 10 ns and some microseconds."""
        random = np.random.default_rng(seed)
        for level, time_s in zip(
            random.integers(0, 2, changes), random.choice([1e-8, 4e-8, 2e-7, 1e-6, 5e-6], changes), strict=True
        ):
            if level == 0 and self.board.high(pins):
                self.lows_ps.append(self.board.now_ps)
            self.board.stick(pins, int(level))
            self.board.run(time_s * PS)


def stuck(name, level, for_s=WATCHED_S):
    def perform(host):
        return host.watch(lambda: host.board.stick(signal_pins()[name], level), for_s=for_s)

    return perform


def noisy(name):
    """Floating, with noise between the frames; the pull holds it during them."""

    def perform(host):
        def noise():
            host.noise(signal_pins()[name])
            host.board.stick(signal_pins()[name], None)

        return host.watch(lambda: None, meanwhile=noise)

    return perform


def one_frame_in(damaged_of):
    """A link that damages one bit in every this many frames."""

    def perform(host):
        count = iter(range(10**6))

        def damage(frame):
            number = next(count)
            if number % damaged_of:
                return frame
            bit = number * 131 % (8 * len(frame))
            return bytes(byte ^ (1 << bit % 8 if place == bit // 8 else 0) for place, byte in enumerate(frame))

        return host.watch(lambda: setattr(host.pi, "damage", damage))

    return perform


def oscillator(host):
    """It stops, and runs again before it is asked why."""
    fault = host.fault

    def runs_again():
        host.board.oscillate(True)
        host.board.run(5e-6 * PS)
        return fault()

    host.fault = runs_again
    return host.watch(lambda: host.board.oscillate(False), for_s=AT_ONCE_S)


def oscillator_under_a_lock(host):
    """Only the FPGA's own oscillator finds out."""
    host.board.pll("lock_stays")
    return oscillator(host)


def cable(host):
    """Every wire to the Raspberry Pi is off: what is left are the board's pulls."""
    return host.watch(lambda: host.board.stick(sum(host.pi.wires.values()), None), for_s=AT_ONCE_S)


def killed(host):
    """The kernel closes the process' files: its lines are released, and the permit's pull-down acts."""
    return host.watch(host.link.close, beats=False, for_s=AT_ONCE_S, host="–")


def hangs(host):
    return host.watch(lambda: None, beats=False, host="–")


def uart_floods(host):
    return host.watch(lambda: None, meanwhile=lambda: host.noise(UART))


def triggered(level):
    """Two plays wait; how many the trigger line starts."""

    def perform(host):
        host.session.upload(0, memoryview(WORDS).cast("B"))
        for _ in range(2):
            host.session.play(Play(0), stop=False)
        if level == "noise":
            return noisy("trigger")(host)
        return stuck("trigger", level)(host)

    return perform


ROWS = {
    "SCK low": stuck("SCK", 0),
    "SCK high": stuck("SCK", 1),
    "SCK floating, noise": noisy("SCK"),
    "chip select low": stuck("CS", 0),
    "chip select high": stuck("CS", 1),
    "chip select floating, noise": noisy("CS"),
    "MOSI low": stuck("MOSI", 0),
    "MOSI high": stuck("MOSI", 1),
    "MISO low": stuck("MISO", 0),
    "MISO high": stuck("MISO", 1),
    "one frame in 4 damaged": one_frame_in(4),
    "every frame damaged": one_frame_in(1),
    "UART low (break)": lambda host: host.watch(lambda: host.board.stick(UART, 0)),
    "UART floating, noise": uart_floods,
    "trigger low": triggered(0),
    "trigger high": triggered(1),
    "trigger floating, noise": triggered("noise"),
    "run permit low, or its wire off": stuck("run permit", 0, AT_ONCE_S),
    "run permit high": stuck("run permit", 1),
    "run permit floating, noise": noisy("run permit"),
    "temperature low, or its wire off": stuck("temperature good", 0, AT_ONCE_S),
    "temperature high": stuck("temperature good", 1),
    "temperature floating, noise": noisy("temperature good"),
    "oscillator stopped": oscillator,
    "oscillator stopped, the PLL's lock stays": oscillator_under_a_lock,
    "host killed": killed,
    "host hangs": hangs,
    "cable to the host off, or the host without supply": cable,
}

AT_THE_START = {
    "FPGA not configured, or without supply: `configured` low": lambda pi: pi.board.stick(pi.wires["GPIO24"], 0),
    "`configured` high, FPGA not there": lambda pi: pi.board.stick(pi.wires["GPIO9"], 0),
}
IN_EVERY_RUN = (
    "run permit low, or its wire off",
    "oscillator stopped",
    "oscillator stopped, the PLL's lock stays",
    "cable to the host off, or the host without supply",
)


def reported(board="ulx3s"):
    """{fault: cells} of the README's table of the pins, with the rows that differ on this board."""
    tables = re.findall(r"^\| (.*?)one thing broken \|.*\n\|[-|]+\n((?:\|.*\n)+)", README.read_text(), re.MULTILINE)
    rows = "".join(rows for of, rows in tables if of in ("", f"{board}: "))
    cells = [[cell.strip() for cell in row.strip("|\n").split(" | ")] for row in rows.splitlines()]
    return {what.strip(" |"): tuple(cell.strip(" |") for cell in rest) for what, *rest in cells}


def test_the_table_has_these_rows():
    assert list(reported()) == [*ROWS, *AT_THE_START] == list(reported("tang_primer_20k"))


@pytest.mark.parametrize("what", [row if row in IN_EVERY_RUN else pytest.param(row, marks=pytest.mark.slow) for row in ROWS])
def test_one_thing_broken(pi, what):
    assert ROWS[what](Host(pi)).row() == reported(pi.name)[what]


@pytest.mark.parametrize("what", AT_THE_START)
def test_one_thing_broken_at_the_start(pi, what):
    AT_THE_START[what](pi)
    with pytest.raises(ControllerError) as caught:
        Session(SpiLink(pi.files.board.link, pi.now_s), pi.files.board, build_hash(data_folder("fpga_rtl")), pi.now_s)
    assert not pi.board.levels & (sum(channel_pins()) | signal_pins()["hv_enable"])
    said = re.match(r"[^:,.]+", str(caught.value))[0]
    assert ("stay off", "–", f"exit {caught.value.exit_code}: {said}") == reported(pi.name)[what]

"""Runs in the guest: the device's link on the kernel's own spidev and GPIO lines, with the gateware's model at the far end."""

import contextlib
import fcntl
import os
import struct
import threading
import time
import tracemalloc
from functools import cache
from pathlib import Path

import gpiod
import msgspec
import numpy as np
from far_end_spi import FarEnd, GpioTrace
from gpio_lines import GpioLines

from controller.device.board.board import load_board
from controller.device.board.devices import LinkSettings, Temperature
from controller.device.board.lookup import data_folder, find_board
from controller.device.doctor.bring_up import Chirps
from controller.device.doctor.doctor import look
from controller.device.doctor.link_examination import examine_link
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.exchange import FpgaReset
from controller.device.fpga.frames import Play
from controller.device.fpga.links.gpio_lines import SET_VALUES
from controller.device.fpga.links.spi_device import read_bufsiz
from controller.device.fpga.links.spi_link import SpiLink
from controller.device.fpga.registers import Register
from controller.device.fpga.session import Session
from controller.device.loop.context import LoopContext
from controller.device.loop.outputs import Outputs
from controller.device.service.temperature import RETRY_S, Thermometer
from controller.errors import ControllerError, FaultError, LinkError

LABEL = "panel"
NAMES = ["TRIGGER", "CONFIGURED", "PERMIT"]
SETTINGS = LinkSettings(
    kind="spi",
    clock_hz=80_000_000,
    sck_hz=25_000_000,
    slots=4,
    device="/dev/spidev0.0",
    gpio_chip=LABEL,
    trigger_line="TRIGGER",
    configured_line="CONFIGURED",
    permit_line="PERMIT",
)
SIMULATED = load_board(find_board("simulated"))
BOARD = msgspec.structs.replace(
    SIMULATED, link=SETTINGS, limits=msgspec.structs.replace(SIMULATED.limits, heartbeat_timeout_ms=250.0)
)
WORDS = memoryview(np.random.default_rng(7).integers(0, 1 << 32, 1000, dtype=np.uint32).view(np.uint8)).cast("B")


class SlowClock:
    """The loop's clock where `SLOWNESS` seconds on the wall are one."""

    def now_s(self):
        return time.monotonic() / SLOWNESS

    def wait(self, _, until_s):
        time.sleep(max(until_s - self.now_s(), 0) * SLOWNESS)


CLOCK = SlowClock()
BIND = Path("/sys/bus/spi/drivers/spidev")
TIMEOUT_MS = Path("/sys/module/labdev/parameters/timeout_ms")  # until a controller gives up a transfer
SLOWNESS = 5.0  # of all clocks, for a machine that is busy with other things as well


@cache
def lines():
    """The chip with the lines of the link."""
    chip = GpioLines(LABEL, NAMES)
    chip.pull("CONFIGURED", 1)  # as guest_board_top.py has it from the board itself; here nobody may be at the far end
    return chip


def setup_module():
    lines()
    TIMEOUT_MS.write_text("20000")


def with_settings(**changes):
    return msgspec.structs.replace(SETTINGS, **changes)


def refusal(action):
    """What an action that must not work says."""
    try:
        action()
    except ControllerError as error:
        return str(error)
    raise AssertionError("nothing was refused")


@contextlib.contextmanager
def opened(settings=SETTINGS, now_s=CLOCK.now_s):
    link = SpiLink(settings, now_s)
    try:
        yield link
    finally:
        link.close()


def session_on(link, board=BOARD):
    return Session(link, board, build_hash(data_folder("fpga_rtl")), CLOCK.now_s)


class Panel:
    """Far end, link and session, armed."""

    def __init__(self):
        self.far_end = FarEnd(BOARD, NAMES, slowness=SLOWNESS)
        self.link = SpiLink(SETTINGS, CLOCK.now_s)
        self.session = session_on(self.link)
        self.outputs = Outputs(LoopContext(BOARD, CLOCK, self.session, None))
        self.come_on()

    def come_on(self):
        """As the loop does it, without waiting in between."""
        while not self.outputs.on:
            try:
                self.outputs.advance(CLOCK.now_s())
            except (LinkError, FaultError) as error:
                self.outputs.failed(error, CLOCK.now_s())

    def rest(self, until_s):
        while CLOCK.now_s() < until_s:
            self.session.heartbeat()

    def emissions(self, until):
        """Heartbeats until the FPGA has counted this many emissions."""
        while self.session.heartbeat().emissions < until:
            pass

    def recover(self, error):
        self.outputs.failed(error, CLOCK.now_s())
        self.come_on()

    def lost(self):
        """The error by which heartbeats find that something is wrong."""
        while True:
            try:
                self.session.heartbeat()
            except ControllerError as error:
                return error

    def close(self):
        self.link.close()
        self.far_end.close()


@contextlib.contextmanager
def panel():
    opened_panel = Panel()
    try:
        yield opened_panel
    finally:
        opened_panel.close()


def test_each_frame_is_a_transfer_of_its_own_chip_select_and_comes_back_in_its_place():
    lengths = [512] * 8 + [36] * 4
    seen = []
    wires = os.open("/dev/labspi", os.O_RDWR)

    def answer():
        for number in range(len(lengths)):
            request = os.read(wires, 1 << 16)
            speed_hz, size, mode, last = struct.unpack_from("<IIII", request)
            seen.append((speed_hz, size, mode, last, request[16:]))
            os.write(wires, bytes([number]) * size)

    thread = threading.Thread(target=answer)
    thread.start()
    sent, received = memoryview(bytearray(os.urandom(5000))), memoryview(bytearray(5000))
    with opened() as link:
        link.exchange(sent, lengths, received)
        assert link.bytes_sent == sum(lengths)
        assert 0 < link.effective_hz < link.sck_hz == 25e6
        assert link.wire_free_s() <= CLOCK.now_s()
    thread.join()
    os.close(wires)
    start = 0
    for number, (length, entry) in enumerate(zip(lengths, seen, strict=True)):
        assert entry == (25_000_000, length, 0, 1, bytes(sent[start : start + length]))
        assert bytes(received[start : start + length]) == bytes([number]) * length
        start += length
    assert not any(received[start:])


def test_a_message_allocates_nothing_to_speak_of():
    lengths = [512] * 8 + [36] * 4
    sent, received = memoryview(bytearray(5000)), memoryview(bytearray(5000))
    with opened() as link:  # nobody is at the far end: what is sent comes back
        link.exchange(sent, lengths, received)
        tracemalloc.start()
        before, _ = tracemalloc.get_traced_memory()
        tracemalloc.reset_peak()
        link.exchange(sent, lengths, received)
        after, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
    assert peak - before < 1024, f"{peak - before} bytes at a time"
    assert after - before < 256


def test_a_buffer_that_the_kernel_does_not_have_is_reported():
    assert read_bufsiz() == 4096
    sent, received = memoryview(bytearray(5000)), memoryview(bytearray(5000))
    with opened() as link:
        link.bufsiz = 8192
        assert "does not fit spidev's buffer" in refusal(lambda: link.exchange(sent, [512] * 9, received))
    with opened() as link:
        link.exchange(sent, [512] * 9, received)


def test_a_trigger_is_a_pulse_and_its_time_is_between_its_edges():
    trace = GpioTrace(LABEL, NAMES)
    with opened(now_s=time.monotonic) as link:
        trace.read()
        edge_s = link.trigger()
        (rise_s, name, up), (fall_s, _, down) = trace.read()
    trace.close()
    assert (name, up, down) == ("TRIGGER", 1, 0)
    assert rise_s - 1e-6 <= edge_s <= fall_s + 1e-6  # the trace has whole microseconds


def test_the_permit_is_given_while_the_link_is_open():
    with opened():
        assert lines().value("PERMIT") == 1
    assert lines().value("PERMIT") == 0


def test_an_fpga_that_is_not_configured_is_reported_and_gets_no_permit():
    lines().pull("CONFIGURED", 0)
    try:
        assert "is not configured: its line 'CONFIGURED' is low" in refusal(lambda: SpiLink(SETTINGS, CLOCK.now_s))
    finally:
        lines().pull("CONFIGURED", 1)
    assert lines().value("PERMIT") == 0
    with opened() as link:
        assert link.lines.configured()


def test_chips_and_lines_that_are_not_there_are_named_with_those_that_are():
    assert "no GPIO chip has the label 'pinctrl-bcm2711'; there are: panel" in refusal(
        lambda: SpiLink(with_settings(gpio_chip="pinctrl-bcm2711"), time.monotonic)
    )
    assert "no line named 'TRIGER'; names like it: TRIGGER" in refusal(
        lambda: SpiLink(with_settings(trigger_line="TRIGER"), time.monotonic)
    )


def test_lines_without_names_are_driven_by_their_numbers_and_refused_by_name_with_what_there_is():
    expander = GpioLines("expander", ["PERMIT", "CONFIGURED", "TRIGGER"], named=False)
    expander.pull("CONFIGURED", 1)
    named = with_settings(gpio_chip="expander")
    numbered = with_settings(gpio_chip="expander", trigger_line="2", configured_line="1", permit_line="0")
    try:
        assert 'its lines have no names; a line without a name is given by its number, "0" to "2"' in refusal(
            lambda: SpiLink(named, CLOCK.now_s)
        )
        twice = with_settings(gpio_chip="expander", trigger_line="0", configured_line="1", permit_line="0")
        assert "have to be lines of their own; given are '0', '1', '0'" in refusal(lambda: SpiLink(twice, CLOCK.now_s))
        with opened(numbered) as link:
            link.lines.permit(given=True)
            assert link.lines.configured()
            assert (expander.value("TRIGGER"), expander.value("PERMIT")) == (0, 1)
            fcntl.ioctl(link.lines._fd, SET_VALUES, link.lines._rise)  # the first half of a pulse
            assert (expander.value("TRIGGER"), expander.value("PERMIT")) == (1, 1)
            link.lines.pulse()
            link.lines.permit(given=False)
            assert (expander.value("TRIGGER"), expander.value("PERMIT")) == (0, 0)
            expander.pull("CONFIGURED", 0)
            assert not link.lines.configured()
    finally:
        expander.close()


def test_a_line_that_somebody_holds_is_reported_with_its_holder():
    with gpiod.request_lines(f"/dev/{lines().chip}", consumer="oscilloscope", config={"TRIGGER": None}):
        assert "'TRIGGER' of GPIO chip 'panel' is in use by oscilloscope" in refusal(lambda: SpiLink(SETTINGS, CLOCK.now_s))
    with opened():
        pass


def test_two_programs_never_share_the_device():
    with opened():
        assert "in use by another haptic-panel" in refusal(lambda: SpiLink(SETTINGS, CLOCK.now_s))


def test_a_device_that_is_not_there_is_reported_with_those_that_are():
    message = refusal(lambda: SpiLink(with_settings(device="/dev/spidev7.1"), time.monotonic))
    assert "there is no /dev/spidev7.1 (there are: /dev/spidev0.0, /dev/spidev0.1)" in message


def test_the_speed_is_read_back_and_divided_as_the_controller_does():
    with opened(with_settings(spi_source_hz=500_000_000, sck_hz=30_000_000)) as link:
        assert link.sck_hz == 500e6 / 18
        assert link.set_sck_hz(10_000_000) == 10e6
        assert link.set_sck_hz(9_999_999) == 500e6 / 52


def test_it_arms_uploads_and_plays_by_its_trigger_line():
    with panel() as there:
        there.session.upload_and_play(Play(1), WORDS, stop=False)
        there.session.trigger()
        there.emissions(1)
        there.session.play(Play(1, emissions=2, period_ticks=there.session.timing.period_ticks(3e-3)), stop=False)
        assert there.session.heartbeat().trigger_count == 1
        there.session.trigger()
        there.emissions(3)
        pins = there.far_end.pins()
        assert (pins["hv"], pins["word"], pins["focus"], pins["modes"]) == (1, BOARD.idle_word, 3, {0})
        there.rest(there.session.disarm())
        there.session.off()
        assert there.far_end.pins()["hv"] == 0


def test_what_is_wrong_with_the_wires_is_said():
    far_end = FarEnd(BOARD, NAMES, slowness=SLOWNESS)
    try:
        with opened() as link:
            for kind, said in [
                ("zeros", "only zeros came back"),
                ("ones", "only ones came back"),
                ("joined", "our own bytes came back: MOSI and MISO are joined"),
                ("inverted", "every bit came back inverted"),
                ("late", "came 1 bit late"),
                ("noise", "it is no status"),
            ]:
                far_end.wire(kind)
                message = refusal(lambda: session_on(link))
                assert said in message, (kind, message)
            far_end.wire("good")
            session_on(link)
    finally:
        far_end.close()


def test_a_loopback_is_reported_by_the_kernels_own():
    with opened() as link:  # nobody at the far end
        message = refusal(lambda: session_on(link))
    assert "our own bytes came back" in message


def test_a_reset_fpga_is_noticed_and_brought_back():
    with panel() as there:
        there.session.upload(2, WORDS)
        there.far_end.reset()
        error = there.lost()
        assert isinstance(error, FpgaReset), error
        assert there.far_end.pins()["hv"] == 0
        there.recover(error)
        assert there.session.exchange.read(Register.IDLE_WORD) == BOARD.idle_word
        there.session.upload_and_play(Play(2), WORDS, stop=False)
        there.session.trigger()
        there.emissions(1)
        assert there.far_end.pins()["focus"] == 1


def test_an_fpga_without_supply_for_a_while_is_brought_back():
    with panel() as there:
        there.far_end.reset(dark_s=0.6)
        error = there.lost()
        assert "only ones came back" in str(error), error
        there.recover(error)
        assert there.far_end.pins()["hv"] == 1


def test_a_device_that_is_unplugged_is_reported_and_opened_again_when_it_is_back():
    with panel() as there:
        (BIND / "unbind").write_text("spi0.0")
        try:
            error = there.lost()
            assert "/dev/spidev0.0 was removed" in str(error), error
            assert lines().value("PERMIT") == 0
            assert there.far_end.pins()["hv"] == 0, "without the permit, at once"
            assert "there is no /dev/spidev0.0" in refusal(lambda: SpiLink(SETTINGS, CLOCK.now_s))
        finally:
            (BIND / "bind").write_text("spi0.0")
        there.recover(error)
        there.session.upload_and_play(Play(0), WORDS, stop=False)
        there.session.trigger()
        there.emissions(1)


def test_a_bus_that_is_stuck_is_reported_and_work_goes_on_when_it_is_free():
    with panel() as there:
        there.far_end.wire("stuck")
        TIMEOUT_MS.write_text("300")
        try:
            error = there.lost()
        finally:
            TIMEOUT_MS.write_text("20000")
        assert isinstance(error, LinkError)
        assert "did not finish a transfer: its bus is stuck" in str(error), error
        assert there.far_end.pins()["hv"] == 0
        there.far_end.wire("good")
        there.recover(error)
        assert lines().value("PERMIT") == 1
        assert there.far_end.pins()["hv"] == 1


def test_the_doctor_finds_the_devices_and_examines_the_link():
    settings = with_settings(slots=1)
    short = msgspec.structs.replace(BOARD.waveform, duration_ms=0.2)  # its memory is read word by word
    board = msgspec.structs.replace(BOARD, link=settings, waveform=short)
    far_end = FarEnd(board, NAMES, slowness=SLOWNESS)
    findings = {finding.about: finding for finding in look(board, CLOCK.now_s)}
    for about in ("SPI device", "spidev buffer", "GPIO lines", "priority", "locked memory"):
        assert findings[about].good, findings[about]
    assert "an upload is two messages" in findings["spidev buffer"].said
    with opened(settings) as link:
        assert {finding.about: finding for finding in look(board, CLOCK.now_s)}["GPIO lines"].good, "our own lines are no fault"

        def examine(channels):
            return examine_link(board, link, lambda: session_on(link, board), CLOCK, 3e4, Chirps(channels))

        found = examine([5])
        but_for_sck = [finding for finding in found.findings if finding.about != "SCK measured"]  # this far end computes
        assert all(finding.good for finding in but_for_sck), found.findings
        assert found.figures["proposed_sck_hz"] == SETTINGS.sck_hz
        assert found.figures["bit_errors"]["bits"] >= 3e4 * 0.9
        print({name: found.figures[name] for name in ("sck_measured_hz", "effective_hz")})
        far_end.wire("noise")
        assert [finding.good for finding in examine([]).findings] == [False]
    assert far_end.pins()["hv"] == 0
    far_end.close()


def bus_name():
    """The I2C bus whose far end is a program."""
    return next(
        f"/dev/{bus.name}" for bus in Path("/sys/bus/i2c/devices").glob("i2c-*") if (bus / "name").read_text() == "labdev i2c\n"
    )


class Lm75Chip:
    """TMP75 by its datasheet (SBOS288): a write sets the pointer, a read gives the register it points at, high byte first."""

    def __init__(self):
        self.words = {0: 0x1900, 1: 0x6000, 2: 0x4B00, 3: 0x5000}  # temperature 25 °C, configuration, limits
        self.awake = True
        self._pointer = 0
        self._far_end = os.open("/dev/labi2c", os.O_RDWR)
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def _serve(self):
        while True:
            request = os.read(self._far_end, 1 << 12)
            (count,) = struct.unpack_from("<I", request)
            at, answer, result = 4, b"", count
            for _ in range(count):
                address, flags, length = struct.unpack_from("<HHH", request, at)
                at += 6
                if address != 0x4A or not self.awake:
                    result = -6  # ENXIO: nobody acknowledges
                if flags & 1:
                    answer += struct.pack(">H", self.words[self._pointer & 3])[:length].ljust(length, b"\xff")
                else:
                    self._pointer = request[at]
                    at += length
            os.write(self._far_end, struct.pack("<i", result) + (answer if result > 0 else b""))
            if self._pointer == 0x7F:
                os.close(self._far_end)
                return


def test_the_bit_clock_follows_an_lm75_that_comes_and_goes():
    chip = Lm75Chip()
    settings = Temperature(kind="lm75", device=bus_name(), address=0x4A, reference_c=23.0, coefficient_per_k=-100e-6)
    thermometer = Thermometer(settings)
    assert abs(thermometer.scale(0.0) - (1 - 200e-6)) < 1e-12
    chip.words[0] = 0xFFF0
    assert thermometer.scale(2.0) == 1 - 200e-6, "a jump to -0.06 °C is not believed at once"
    thermometer.scale(4.0)
    assert thermometer.temperature_c == -0.0625
    chip.awake = False
    scale = thermometer.scale(6.0)
    assert "no temperature sensor answers" in thermometer.cause
    assert scale == thermometer.scale(7.0)
    chip.awake = True
    chip.words[0] = 0x0100
    thermometer.scale(6.0 + RETRY_S)
    assert (thermometer.temperature_c, thermometer.cause) == (1.0, "")
    thermometer.close()
    other = Thermometer(msgspec.structs.replace(settings, address=0x48))
    assert other.scale(0.0) == 1
    assert "address 0x48" in other.cause

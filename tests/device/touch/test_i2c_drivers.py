"""GT911 and FT5x06 driven over the kernel's interfaces, their far ends (peers) built from the data sheets, in virtual time."""

import contextlib
import errno
from pathlib import Path
from random import Random
from types import SimpleNamespace

import msgspec
import pytest
from gpiod.line import Edge
from peers.adapter import Adapter, Lines
from peers.edt_m06_chip import EdtM06Chip
from peers.ft5x06_chip import Ft5x06Chip
from peers.gt911_chip import STATUS, Gt911Chip
from peers.i2c_chip import READ, NotAcknowledged
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.doctor import touch_check
from controller.device.touch.drivers import i2c_bus, i2c_reader, panel_lines
from controller.device.touch.event_codes import ABS_MT_TOUCH_MAJOR
from controller.device.touch.live_source import LiveSource
from controller.device.touch.panels import ft5x06, gt911
from controller.device.touch.panels.ft5x06 import Ft5x06Touch
from controller.device.touch.panels.gt911 import PRODUCTS, Gt911Touch
from controller.errors import TouchError

BOARD = load_board(find_board("simulated"))
AXES_MM = {"x_mm_from_axes": (210.0, 0.0, 0.0), "y_mm_from_axes": (0.0, 148.0, 0.0)}
LINES = {"interrupt_chip": "panel", "interrupt_line": "INT", **AXES_MM}


class Bench:
    """A panel on a bus, and a clock that goes on only when it is commanded to."""

    def __init__(self, monkeypatch, tmp_path):
        self.now_s = 0.0
        self._path = tmp_path / "i2c-1"
        self._path.touch()
        self._monkeypatch = monkeypatch
        self._opened = []
        monkeypatch.setattr(i2c_reader, "time", SimpleNamespace(sleep=self.wait))
        monkeypatch.setattr(panel_lines, "find_chip", lambda *_: "/dev/gpiochip0")
        monkeypatch.setattr(touch_check, "FOLDER", tmp_path)

    def put(self, chip, **adapter):
        self.chip = chip
        self.adapter = Adapter(chip, **adapter)
        self.lines = Lines(chip, lambda: self.now_s)
        self._monkeypatch.setattr("smbus2.smbus2.ioctl", self.adapter.ioctl)
        self._monkeypatch.setattr(i2c_bus.fcntl, "ioctl", self.adapter.ioctl)
        self._monkeypatch.setattr(panel_lines, "gpiod", self.lines)
        return chip

    def wait(self, wait_s):
        assert wait_s >= 0
        self.now_s += wait_s

    def gt911(self, **more):
        return self._open(gt911.open_panel, Gt911Touch, more)

    def ft5x06(self, **more):
        return self._open(ft5x06.open_panel, Ft5x06Touch, {"width": 2100, "height": 1480} | more)

    def _open(self, open_panel, settings, more):
        reader = open_panel(settings(**{"bus": str(self._path), **LINES, **more}))
        self._opened.append(reader)
        return LiveSource(reader, BOARD)

    def touch(self, held, pulse=True, **more):
        if self.chip.touch(held, **more) is not False and pulse:
            self.lines.pulse()

    def prove(self, source):
        """Let the interrupt line announce three reports in a row, the last one empty."""
        for held in ({0: (1000, 700)}, {0: (1001, 700)}, {}):
            self.now_s += 8e-3
            self.touch(held)
            assert len(self.read(source)) == 1

    def open_buses(self):
        """How often the bus is open."""
        found = 0
        for fd in Path("/proc/self/fd").iterdir():
            with contextlib.suppress(OSError):  # the one of the listing itself
                found += fd.readlink() == self._path
        return found

    def read(self, source):
        """Samples of what there is to read now, as (finger, x in mm, y in mm, contact)."""
        return in_short(source.read(self.now_s))

    def until_due(self, source):
        """Let the time pass to when the reader wants to be asked, and ask it; how long that was, and what came."""
        waited_s = source.next_time_s() - self.now_s
        self.now_s = max(self.now_s, source.next_time_s())
        return round(waited_s, 6), self.read(source)

    def close(self):
        for reader in self._opened:
            reader.close()


def in_short(samples):
    return [(s.finger, round(s.x_m * 1e3, 6), round(s.y_m * 1e3, 6), s.contact) for s in samples]


@pytest.fixture
def bench(monkeypatch, tmp_path):
    found = Bench(monkeypatch, tmp_path)
    yield found
    found.close()


# ---- GT911


@pytest.mark.parametrize("address", [0x5D, 0x14])
def test_a_gt911_is_reset_to_the_boards_address_by_the_level_of_its_interrupt_line(bench, address):
    chip = bench.put(Gt911Chip(width=2100, height=1480))
    chip.address = 0x5D if address == 0x14 else 0x14
    source = bench.gt911(address=address, reset_line="RST")
    assert chip.address == address
    assert bench.lines.driven == {"RST": True}  # it keeps running; the interrupt line is the chip's again
    levels = [(name, level) for _, name, level in bench.lines.history]
    assert levels == [("RST", False), ("INT", False), ("INT", address == 0x14), ("RST", True), ("INT", False)]
    at_s = [at_s for at_s, _, _ in bench.lines.history]
    assert at_s[2] - at_s[0] >= 10e-3  # T2 of the data sheet
    assert at_s[3] - at_s[2] >= 100e-6  # T3
    assert at_s[4] - at_s[3] >= 5e-3  # T4
    assert bench.now_s - at_s[4] >= 50e-3  # T5
    bench.touch({0: (100, 200), 3: (300, 400)}, size=75)
    samples = source.read(bench.now_s)
    assert in_short(samples) == [(0, 10, 20, True), (1, 30, 40, True)]
    assert [round(s.size_m * 1e3, 6) for s in samples] == [7.5, 7.5]
    assert not source.warnings


@pytest.mark.parametrize(("given", "true"), [(0x14, 0x5D), (0x5D, 0x14)])
def test_without_a_reset_line_a_gt911_is_found_at_its_other_address(bench, given, true):
    bench.put(Gt911Chip(width=2100, height=1480)).address = true
    source = bench.gt911(address=given)
    bench.touch({0: (100, 200)})
    assert bench.read(source) == [(0, 10, 20, True)]
    assert bench.chip.registers[STATUS] == 0  # cleared at that address
    assert bench.lines.history == []


@each_row("product", PRODUCTS, afresh=[bench])
def test_every_chip_of_the_kernels_list_with_the_same_registers_is_driven(bench, product):
    bench.put(Gt911Chip(width=2100, height=1480, contacts=10, product=product.encode().ljust(4, b"\0")))
    source = bench.gt911()
    assert source._reader.description.name == f"GT{product}"
    bench.touch({number: (200 * number + 1, 100 * number) for number in range(10)})
    assert [place[1:3] for place in bench.read(source)] == [(20 * k + 0.1, 10 * k) for k in range(10)]


def test_the_list_is_the_kernels():
    assert set(PRODUCTS) == {"911", "9110", "9111", "927", "9271", "928", "912", "9147", "967"}  # goodix_chip_ids, map at 0x8047


@each_row("product", [b"1158", b"5688", b"917S", b"9112", b"91\0\0"], afresh=[bench])
def test_another_goodix_is_refused_by_name_with_the_list(bench, product):
    bench.put(Gt911Chip(product=product))
    with pytest.raises(TouchError) as caught:
        bench.gt911()
    assert repr(product.rstrip(b"\0").decode()) in str(caught.value)
    assert "911, 9110, 9111, 912, 9147, 927, 9271, 928, 967" in str(caught.value)


@each_row(
    ("product", "words"), [(bytes(4), "with 0x00 only"), (b"\xff" * 4, "0xFF"), (b"\x12\x34\x80\0", "no Goodix")], afresh=[bench]
)
def test_what_is_no_goodix_is_refused(bench, product, words):
    bench.put(Gt911Chip(product=product))
    with pytest.raises(TouchError, match=words):
        bench.gt911()


def test_a_gt911_tells_its_extents_unless_the_board_does(bench):
    bench.put(Gt911Chip(width=1024, height=600))
    axes = bench.gt911().axes
    assert (axes.x.maximum, axes.y.maximum) == (1024, 600)
    bench.put(Gt911Chip(width=0, height=600))
    with pytest.raises(TouchError, match="width and height"):
        bench.gt911()
    axes = bench.gt911(width=30).axes
    assert (axes.x.maximum, axes.y.maximum) == (30, 600)


@each_row(("trigger", "edge"), [(0, Edge.RISING), (1, Edge.FALLING), (2, Edge.FALLING), (3, Edge.RISING)], afresh=[bench])
def test_the_edge_is_the_one_of_the_chips_configuration(bench, trigger, edge):
    bench.put(Gt911Chip(trigger=trigger))
    bench.gt911()
    assert bench.lines.listening is edge


def test_a_report_of_before_its_start_is_no_touch(bench):
    bench.put(Gt911Chip(width=2100, height=1480)).touch({0: (100, 200)})
    source = bench.gt911()
    assert bench.until_due(source)[1] == []
    bench.touch({1: (110, 200)})
    assert bench.read(source) == [(0, 11, 20, True)]


def test_every_report_of_a_gt911_is_cleared_and_one_of_more_than_two_contacts_read_on(bench):
    bench.put(Gt911Chip(width=2100, height=1480, contacts=10))
    source = bench.gt911()
    clears = bench.chip.clears
    for held, given in (({0: (10, 20)}, 1), ({0: (11, 20), 1: (30, 40)}, 2), ({k: (9 + k, 50) for k in range(3)}, 3), ({}, 3)):
        before = bench.adapter.transfers
        bench.touch(held)
        assert len(bench.read(source)) == given
        assert bench.adapter.transfers - before == (3 if len(held) > 2 else 2)  # status and points, the rest, clear
    assert bench.chip.clears == clears + 4
    assert bench.chip.lost_reports == 0


# ---- when a chip is asked


def test_a_sample_has_the_time_of_its_edge(bench):
    bench.put(Gt911Chip(width=2100, height=1480))
    source = bench.gt911()
    assert source.fileno() is not None
    edge_s = bench.now_s
    bench.touch({0: (100, 200)})
    bench.now_s += 4e-3
    chip = type(bench._opened[-1]._chip)
    fetch, meanwhile = chip.fetch, [{0: (110, 200)}]

    def fetched(*given):
        contacts = fetch(*given)
        if meanwhile:
            bench.touch(meanwhile.pop())
        return contacts

    bench._monkeypatch.setattr(chip, "fetch", fetched)
    (sample,) = source.read(bench.now_s)
    assert sample.time_s == pytest.approx(edge_s, abs=1e-8)
    edge_s = bench.now_s
    bench.now_s += 2e-3
    (sample,) = source.read(bench.now_s)
    assert sample.time_s == pytest.approx(edge_s, abs=1e-8), "its edge came while the report before was read"


def test_without_an_edge_an_idle_panel_is_asked_ten_times_a_second_and_a_touched_one_every_30_ms(bench):
    bench.put(Gt911Chip(width=2100, height=1480))
    source = bench.gt911()
    bench.prove(source)
    bench.touch({0: (100, 200)}, pulse=False)
    transfers = bench.adapter.transfers
    bench.now_s += 0.06
    assert bench.read(source) == []
    assert bench.adapter.transfers == transfers  # not before it is due
    assert bench.until_due(source) == (0.04, [(1, 10, 20, True)])
    bench.touch({0: (110, 200)})
    assert bench.read(source) == [(1, 11, 20, True)]
    bench.touch({0: (120, 200)}, pulse=False)
    assert bench.until_due(source) == (0.03, [(1, 12, 20, True)])
    bench.touch({})
    assert bench.read(source) == [(1, 12, 20, False)]
    assert bench.until_due(source) == (0.1, [])
    assert not source.warnings  # one edge missed now and then is none of a line that is not there


def test_a_report_that_its_edge_announced_too_early_is_asked_for_again_after_2_4_8_and_10_ms(bench):
    bench.put(Gt911Chip(width=2100, height=1480))
    source = bench.gt911()
    bench.until_due(source)
    for late, waits_s in ((1, [0.002]), (4, [0.002, 0.004, 0.008, 0.01])):
        bench.chip.late = late
        edge_s = bench.now_s
        bench.touch({0: (100 + late, 200)})
        assert bench.read(source) == []
        for wait_s in waits_s[:-1]:
            assert bench.until_due(source) == (wait_s, [])
        bench.now_s += waits_s[-1]
        (sample,) = source.read(bench.now_s)
        assert in_short([sample]) == [(0, 10 + late / 10, 20, True)]
        assert sample.time_s == pytest.approx(edge_s, abs=1e-8)
    bench.chip.late = 5
    bench.touch({0: (120, 200)})
    assert bench.read(source) == []
    assert [bench.until_due(source)[0] for _ in range(4)] == [0.002, 0.004, 0.008, 0.01]
    bench.now_s += 0.03
    (sample,) = source.read(bench.now_s)  # found all the same, but nobody knows of when it is
    assert (sample.x_m, sample.time_s) == (pytest.approx(0.012), bench.now_s)


def test_a_panel_that_is_touched_for_long_is_not_started_again(bench):
    bench.put(Gt911Chip(width=2100, height=1480))
    source = bench.gt911()
    for k in range(200):
        bench.now_s += 1e-3
        bench.touch({0: (100 + k, 200)}, pulse=k % 3 != 0)
        assert bench.read(source) + bench.until_due(source)[1] == [(0, 10 + k / 10, 20, True)]
    assert not source.warnings


def test_a_panel_that_is_touched_and_silent_for_half_a_second_is_started_again(bench):
    bench.put(Gt911Chip(width=2100, height=1480))
    source = bench.gt911()
    bench.prove(source)
    bench.touch({0: (100, 200)})
    assert bench.read(source) == [(1, 10, 20, True)]
    began_s, samples = bench.now_s, []
    while not samples:
        waited_s, samples = bench.until_due(source)
        assert waited_s == 0.03
    assert samples == [(1, 10, 20, False)]
    assert 0.5 < bench.now_s - began_s < 0.54
    assert source.warnings == {"contact_stuck": 1}
    assert not source.present
    assert bench.until_due(source) == (0.5, [])  # started again
    assert source.present
    bench.touch({0: (100, 200)})
    assert bench.read(source) == [(2, 10, 20, True)]


def test_an_absurd_report_is_counted_and_the_next_one_read(bench):
    bench.put(Gt911Chip(width=2100, height=1480))
    source = bench.gt911()
    bench.touch({0: (100, 200)}, status=0x8F)
    assert bench.read(source) == []
    assert source.warnings == {"report_absurd": 1}
    bench.touch({0: (100, 200)})
    assert bench.read(source) == [(0, 10, 20, True)]


# ---- a line that does not announce what it should


CHIPS = [(Gt911Chip, "gt911"), (Ft5x06Chip, "ft5x06"), (EdtM06Chip, "ft5x06")]
TAP_S, PAUSE_S = 0.08, 0.42


def taps(bench, source, number, pulse):
    """Contacts found of this many taps, at the rate of a chip that scans every 10 ms; the reader is asked as the loop would."""
    found = 0
    for k in range(number):
        until_s = bench.now_s + TAP_S
        while bench.now_s < until_s:
            bench.touch({0: (100 + k + round(1e3 * (until_s - bench.now_s)), 200)}, pulse=pulse)
            found += _asked_until(bench, source, bench.now_s + 10e-3)
        bench.touch({}, pulse=pulse)
        found += _asked_until(bench, source, bench.now_s + PAUSE_S + k * 1.7e-3)
    return found


def _asked_until(bench, source, end_s):
    before = source.counts.contacts
    for _ in range(1000):
        woken = bool(bench.lines.listening and bench.lines.edges)
        if not woken and source.next_time_s() >= end_s:
            bench.now_s = end_s
            return source.counts.contacts - before
        if not woken:
            bench.now_s = max(bench.now_s, source.next_time_s())
        bench.read(source)
    raise AssertionError("it is asked without end")


@each_row(("make", "kind"), CHIPS, afresh=[bench])
def test_a_panel_whose_interrupt_line_never_comes_is_polled_every_tap_found_and_it_is_said_once(bench, make, kind):
    bench.put(make())
    source = getattr(bench, kind)()
    assert taps(bench, source, 60, pulse=False) == 60
    assert source.warnings["interrupt_silent"] == 1
    assert source.next_time_s() - bench.now_s <= 10e-3


@each_row(("make", "kind"), CHIPS, afresh=[bench])
def test_a_line_that_breaks_while_the_panel_works_is_noticed_at_the_second_report_that_was_missed(bench, make, kind):
    bench.put(make())
    source = getattr(bench, kind)()
    assert taps(bench, source, 5, pulse=True) == 5
    bench.until_due(source)
    assert bench.until_due(source)[0] == 0.1  # it is trusted: an idle panel is read ten times a second
    bench.lines.cut = True
    assert taps(bench, source, 6, pulse=True) >= 4
    assert source.warnings["interrupt_silent"] == 1
    assert taps(bench, source, 60, pulse=True) == 60
    bench.lines.cut = False  # mended
    assert taps(bench, source, 5, pulse=True) == 5
    assert source.warnings["interrupt_silent"] == 1
    bench.until_due(source)
    assert bench.until_due(source)[0] == 0.1  # trusted again


def test_after_a_reconnection_a_line_has_to_prove_itself_again(bench):
    bench.put(Ft5x06Chip())
    source = bench.ft5x06()
    taps(bench, source, 5, pulse=True)
    bench.until_due(source)
    for number in (1, 2):
        bench.lines.cut = True
        bench.chip.silent = True
        bench.until_due(source)
        assert not source.present
        bench.chip.silent = False
        while not source.present:
            bench.until_due(source)
        bench.until_due(source)
        assert taps(bench, source, 30, pulse=True) == 30  # from the first one on
        assert source.warnings["interrupt_silent"] == number


def test_doctor_says_how_a_panel_is_read_and_what_it_refuses(bench):
    bench.put(Emulated())
    ask = {"bus": str(bench._path), "width": 2100, "height": 1480, **AXES_MM}
    board = msgspec.structs.replace(BOARD, touch=Ft5x06Touch(**ask))
    finding = touch_check.look_at_touch_panel(board, lambda: bench.now_s)
    assert (finding.good, finding.warns) == (True, True)
    assert "refuses registers 0xA3, 0xA6, 0xA8, 0xA4" in finding.said
    assert finding.said.endswith("polled, as the board names no interrupt line")
    bench.put(Ft5x06Chip())
    wired = msgspec.structs.replace(BOARD, touch=Ft5x06Touch(**ask, interrupt_chip="panel", interrupt_line="INT"))
    finding = touch_check.look_at_touch_panel(wired, lambda: bench.now_s)
    assert (finding.good, finding.warns) == (True, False)
    assert "whether line 'INT' announces reports shows when it is touched" in finding.said
    bench.lines.held = False
    finding = touch_check.look_at_touch_panel(wired, lambda: bench.now_s)
    assert finding.warns
    assert "interrupt line active and nothing touched" in finding.said


@each_row(
    ("keys", "words"),
    [
        ({"interrupt_line": "INT"}, "interrupt_chip is missing: the label of the GPIO chip with interrupt_line 'INT'"),
        ({"reset_line": "RST"}, "interrupt_chip is missing: the label of the GPIO chip with reset_line 'RST'"),
        ({"interrupt_chip": "soc"}, "interrupt_chip is given without"),
        ({"interrupt_chip": "soc", "interrupt_line": "4", "reset_line": "4"}, "are two lines"),
    ],
)
def test_keys_of_lines_that_do_not_go_together_are_refused(keys, words):
    with pytest.raises(ValueError, match=words):
        Gt911Touch(bus="/dev/i2c-1", **AXES_MM, **keys)
    Gt911Touch(bus="/dev/i2c-1", **AXES_MM)


def test_a_panel_without_an_interrupt_line_is_polled_and_nothing_is_said(bench):
    for make, kind in CHIPS:
        bench.put(make())
        source = getattr(bench, kind)(interrupt_line="", interrupt_chip="")
        assert source.fileno() is None
        assert bench.lines.listening is None
        assert taps(bench, source, 30, pulse=False) == 30
        assert not source.warnings


def test_a_gt911_without_an_interrupt_line_is_reset_and_found_at_the_address_of_its_level(bench):
    for address in (0x14, 0x5D):
        bench.put(Gt911Chip(width=2100, height=1480))
        bench.lines.driven["INT"] = address == 0x14  # a resistor of the module
        source = bench.gt911(interrupt_line="", reset_line="RST")
        assert bench.chip.address == address
        assert [name for _, name, _ in bench.lines.history] == ["RST", "RST"]
        bench.touch({0: (100, 200)})
        assert bench.until_due(source)[1] == [(0, 10, 20, True)]
        source.close()


@each_row(("trigger", "held"), [(1, False), (2, False), (0, True), (3, True)], afresh=[bench])
def test_a_line_that_is_held_active_is_said_at_the_start_and_the_panel_polled(bench, trigger, held):
    bench.put(Gt911Chip(trigger=trigger))
    bench.lines.held, bench.lines.cut = held, True
    source = bench.gt911()
    bench.until_due(source)
    assert source.warnings == {"interrupt_active": 1}
    assert taps(bench, source, 30, pulse=True) == 30
    assert source.warnings == {"interrupt_active": 1, "interrupt_silent": 1}


def test_a_finger_that_is_there_at_the_start_is_no_held_line(bench):
    chip = bench.put(Ft5x06Chip())
    chip.touch({0: (100, 200)})
    bench.lines.held = False  # as in polling mode, while it is touched
    source = bench.ft5x06()
    bench.until_due(source)
    assert source.warnings == {"stale_reports": 1}
    bench.lines.held = None
    bench.touch({})
    bench.read(source)
    bench.until_due(source)
    assert "interrupt_active" not in source.warnings


def test_a_line_of_the_other_polarity_whose_edge_comes_when_the_report_was_read_is_never_trusted(bench):
    """Level-triggered and inverted: the edge that is waited for is the end of a report, which the host's reading makes."""
    chip = bench.put(Gt911Chip(width=2100, height=1480, trigger=2))
    source = bench.gt911()
    write = chip.write_register

    def cleared(register, value):
        ended = register == STATUS and value == 0 and chip.registers[STATUS] & 0x80
        write(register, value)
        if ended:
            bench.lines.pulse()

    chip.write_register = cleared
    assert taps(bench, source, 60, pulse=False) == 60
    assert source.next_time_s() - bench.now_s <= 10e-3


def test_a_line_with_edges_without_end_is_let_go_and_the_panel_polled(bench):
    bench.put(Ft5x06Chip())
    source = bench.ft5x06()
    assert taps(bench, source, 5, pulse=True) == 5
    bench.lines.pulse(5000)
    bench.read(source)
    assert source.warnings == {"interrupt_noisy": 1}
    assert source.fileno() is None
    assert bench.lines.listening is None
    assert taps(bench, source, 30, pulse=True) == 30
    bench.chip.silent = True
    bench.until_due(source)
    bench.chip.silent = False
    while not source.present:
        bench.until_due(source)
    assert bench.lines.listening is Edge.FALLING  # another chip may be at its place
    assert taps(bench, source, 5, pulse=True) == 5
    assert source.warnings == {"interrupt_noisy": 1, "bus_retried": 2, "panel_lost": 1}


def test_a_chip_that_pulses_for_the_first_report_of_a_touch_only_is_polled(bench):
    """As in the polling mode of FocalTech, where the line is low while the panel is touched: one edge for each touch."""
    chip = bench.put(Ft5x06Chip())
    source = bench.ft5x06()
    touches = bench.touch
    bench.touch = lambda held, **_: touches(held, pulse=bool(held) and not chip.held)
    assert taps(bench, source, 30, pulse=True) == 30
    assert source.warnings == {"interrupt_silent": 1}
    assert source.next_time_s() - bench.now_s <= 10e-3


def test_a_gt911_is_polled_at_the_rate_of_its_configuration(bench):
    chip = Gt911Chip(width=2100, height=1480)
    chip.configuration += bytes(8) + b"\x07"
    chip.power_up()
    bench.put(chip)
    source = bench.gt911()
    bench.until_due(source)
    assert bench.until_due(source) == (0.012, [])


# ---- a chip that has some of its registers only


class Emulated(Ft5x06Chip):
    """A microcontroller that plays an FT5x06 (raspberrypi/linux#4881); registers beyond `last` are not acknowledged."""

    last = 0x1E

    def transfer(self, messages):
        for address, flags, content in messages:
            if address == self.address and not flags & READ and content[0] > self.last:
                raise NotAcknowledged
        return super().transfer(messages)


def test_a_chip_with_the_registers_of_its_reports_only_works_and_the_others_are_named(bench):
    bench.put(Emulated()).registers[0xA4] = 1
    source = bench.ft5x06()
    assert source._reader.description.name == "FT5x06 chip unknown"
    remark = source._reader.description.remark
    assert remark.endswith("refuses registers 0xA3, 0xA6, 0xA8, 0xA4: it is used without them")
    assert taps(bench, source, 30, pulse=False) == 30
    bench.touch({number: (200 * number + 1, 100 * number + 1) for number in range(10)})
    assert len(bench.read(source)) == 10
    bench.put(Ft5x06Chip())
    assert bench.ft5x06()._reader.description.remark == ""


@each_row("refused", [0x00, 0xA3, 0xA4, 0xA6, 0xA8, 0xBB], afresh=[bench])
def test_each_register_of_an_ft5x06_but_those_of_its_reports_may_be_refused(bench, refused):
    chip = bench.put(Ft5x06Chip())
    transfer = chip.transfer

    def some(messages):
        written = [content for _, flags, content in messages if not flags & READ]
        if any(content[0] == refused and (refused or len(content) > 1) for content in written):  # 0x00: only its writing
            raise NotAcknowledged
        return transfer(messages)

    chip.transfer = some
    source = bench.ft5x06()
    assert (f"0x{refused:02X}" in source._reader.description.remark) == (refused != 0xBB)  # 0xBB: EDT's alone have it
    bench.prove(source)


def test_points_that_an_ft5x06_refuses_are_left_out_and_counted(bench):
    chip = bench.put(Ft5x06Chip())
    transfer = chip.transfer

    def short(messages):
        if any(flags & READ and content > 0x1F for _, flags, content in messages):
            raise NotAcknowledged
        return transfer(messages)

    chip.transfer = short
    source = bench.ft5x06()
    for count, seen in ((4, 4), (5, 2), (10, 2), (1, 1)):
        bench.touch({number: (200 * number + 1, 100 * number + 1) for number in range(count)})
        bench.read(source)
        assert len(in_short_now(source)) == seen
    assert source.present
    assert source.warnings["points_refused"] == 2


def test_a_device_that_refuses_its_identity_and_reports_what_cannot_be_is_refused(bench):
    bench.put(Emulated()).registers[2] = 0xFF
    with pytest.raises(TouchError, match="no FocalTech chip with firmware: it reports 15 contacts"):
        bench.ft5x06()
    bench.put(Emulated()).last = -1
    with pytest.raises(TouchError, match=r"FT5x06 touch panel on .* does not answer"):
        bench.ft5x06()
    assert bench.open_buses() == 0


def refusing(chip, *registers):
    """A chip with 16-bit registers some of which it does not acknowledge."""
    transfer = chip.transfer

    def some(messages):
        if any(not flags & READ and int.from_bytes(content[:2], "big") in registers for _, flags, content in messages):
            raise NotAcknowledged
        return transfer(messages)

    chip.transfer = some
    return chip


def test_a_gt911_that_refuses_product_or_configuration_works_and_says_so(bench):
    bench.put(refusing(Gt911Chip(width=2100, height=1480), 0x8140))
    source = bench.gt911()
    assert source._reader.description.name == "Goodix of unknown product"
    assert "refuses registers 0x8140:" in source._reader.description.remark
    bench.prove(source)
    bench.put(refusing(Gt911Chip(), 0x8047))
    with pytest.raises(TouchError, match="refuses the registers of its configuration, from 0x8047 on: give width and height"):
        bench.gt911()
    source = bench.gt911(width=2100, height=1480)
    assert "refuses registers 0x8047:" in source._reader.description.remark
    bench.prove(source)
    bench.put(refusing(Gt911Chip(), 0x8047, 0x8140)).address = 0x14
    source = bench.gt911(width=2100, height=1480)  # at its other address
    assert "refuses registers 0x8140, 0x8047:" in source._reader.description.remark
    bench.prove(source)
    bench.put(refusing(Gt911Chip(), 0x8140)).registers[STATUS] = 0xFF
    with pytest.raises(TouchError, match="no Goodix chip: it reports 15 contacts"):
        bench.gt911()
    bench.put(refusing(Gt911Chip(), 0x8140, STATUS))
    with pytest.raises(TouchError, match=r"Goodix touch panel on .* does not answer"):
        bench.gt911()


def test_points_that_a_gt911_refuses_are_left_out_and_counted(bench):
    chip = bench.put(Gt911Chip(width=2100, height=1480, contacts=10))
    transfer = chip.transfer

    def short(messages):
        if any(flags & READ and content > 17 for _, flags, content in messages):
            raise NotAcknowledged
        return transfer(messages)

    chip.transfer = short
    source = bench.gt911()
    for count, seen in ((2, 2), (3, 2), (10, 2), (1, 1)):
        bench.touch({number: (200 * number + 1, 100 * number + 1) for number in range(count)})
        bench.read(source)
        assert len(in_short_now(source)) == seen
    assert source.warnings["points_refused"] == 2
    assert chip.lost_reports == 0


# ---- GPIO lines


def test_lines_are_given_by_name_or_by_number(bench):
    for interrupt, reset in (("INT", "RST"), ("0", "1"), ("INT", "1")):
        bench.put(Ft5x06Chip())
        source = bench.ft5x06(interrupt_line=interrupt, reset_line=reset)
        assert bench.lines.driven == {"RST": True}
        bench.prove(source)
        source.close()
        assert bench.lines.driven == {}
    wrong = {"NC": '2 lines .* are named \'NC\': give the number of one: "3", "4"', "5": "no line named '5'", "1": "are one line"}
    for line, words in wrong.items():
        with pytest.raises(TouchError, match=words):
            bench.ft5x06(interrupt_line=line, reset_line="RST")


# ---- the bus


def test_what_is_not_acknowledged_is_tried_three_times_and_then_lost(bench):
    bench.put(Gt911Chip(width=2100, height=1480))
    source = bench.gt911(reset_line="RST")
    bench.chip.nacks = 2
    bench.touch({0: (100, 200)})
    assert bench.read(source) == [(0, 10, 20, True)]
    assert source.warnings == {"bus_retried": 2}
    bench.chip.nacks = 3
    bench.touch({0: (110, 200)})
    assert bench.read(source) == [(0, 10, 20, False)]
    assert source.warnings == {"bus_retried": 4, "panel_lost": 1}
    assert not source.present
    assert source.fileno() is None
    assert bench.lines.driven == {"RST": True}


def test_a_bus_that_hangs_is_not_tried_again_at_once(bench):
    bench.put(Gt911Chip(width=2100, height=1480))
    assert bench.adapter.timeout_10ms == 100
    source = bench.gt911()
    assert bench.adapter.timeout_10ms == 3  # the adapter gives up after 30 ms, not after a second
    bench.touch({0: (100, 200)})
    bench.read(source)
    bench.chip.hangs = True
    before = bench.adapter.transfers
    bench.touch({})
    assert bench.read(source) == [(0, 10, 20, False)]
    assert bench.adapter.transfers == before + 1
    assert source.warnings == {"panel_lost": 1}


def test_a_panel_that_went_is_tried_every_half_second_and_started_step_by_step_when_it_is_back(bench):
    bench.put(Gt911Chip(width=2100, height=1480))
    source = bench.gt911(reset_line="RST")
    bench.touch({0: (100, 200)})
    bench.read(source)
    bench.chip.silent = True
    bench.touch({})
    assert bench.read(source) == [(0, 10, 20, False)]
    began_s = bench.now_s
    while bench.now_s < began_s + 1.2:
        assert bench.until_due(source)[1] == []
        assert not source.present
        if source.next_time_s() > bench.now_s + 0.4:  # it waits for the next attempt
            assert bench.lines.driven == {"RST": True}
    bench.chip.silent = False
    bench.chip.configuration = Gt911Chip(width=1050, height=1480).configuration
    bench.chip.product = b"1158"
    while bench.now_s < began_s + 2.5:  # another chip answers: as if there were none
        assert bench.until_due(source)[1] == []
    assert not source.present
    bench.chip.product = b"928\0"
    steps_s = []
    while not source.present:
        steps_s.append(bench.until_due(source)[0])
    assert 0.1 < sum(steps_s[1:]) < 0.2  # the loop has gone on in between
    assert max(steps_s[1:]) <= 0.05
    bench.touch({0: (100, 200)})
    assert bench.read(source) == [(1, 20, 20, True)]  # by the extents it has now
    assert source.warnings["panel_lost"] == 1


def test_what_keeps_a_bus_from_being_opened_is_said(bench, tmp_path, monkeypatch):
    bench.put(Gt911Chip(), functions=0x10000)
    with pytest.raises(TouchError, match="has no plain I2C"):
        bench.gt911()
    assert bench.open_buses() == 0
    with pytest.raises(TouchError, match=r"there is no I2C bus .*i2c-9"):
        bench.gt911(bus=str(tmp_path / "i2c-9"))

    def refused(*_):
        raise PermissionError(errno.EACCES, "no")

    monkeypatch.setattr("smbus2.smbus2.os.open", refused)
    with pytest.raises(TouchError, match="add it to the group"):
        bench.gt911()


def test_a_chip_that_does_not_answer_at_the_start_is_named_and_everything_given_back(bench):
    bench.put(Gt911Chip()).silent = True
    for opened, name in ((bench.gt911, "Goodix"), (bench.ft5x06, "FT5x06")):
        with pytest.raises(TouchError, match=f"{name} touch panel on .* does not answer"):
            opened(reset_line="RST")
        assert bench.lines.driven == {}
        assert bench.lines.listening is None
        assert bench.open_buses() == 0
    bench.put(Ft5x06Chip())
    with pytest.raises(TouchError, match="has no line named 'NONE'"):
        bench.ft5x06(interrupt_line="NONE")


# ---- FT5x06


def test_an_ft5x06_is_reset_set_to_pulses_and_read(bench):
    bench.put(Ft5x06Chip())
    source = bench.ft5x06(reset_line="RST")
    (low_s, *low), (high_s, *high) = bench.lines.history
    assert (low, high) == (["RST", False], ["RST", True])
    assert high_s - low_s >= 5e-3
    assert bench.now_s - high_s >= 0.3
    assert bench.chip.registers[0xA4] == 1  # a pulse for each report
    assert bench.chip.registers[0x00] == 0
    assert bench.lines.listening is Edge.FALLING
    assert source._reader.description.name == "FT5x06 chip 55"
    assert source._reader.description.version == 0x0A
    assert ABS_MT_TOUCH_MAJOR not in source._reader.description.axes
    assert bench.open_buses() == 1
    bench.touch({number: (200 * number + 1, 100 * number + 1) for number in range(10)})
    assert [place[1:3] for place in bench.read(source)] == [(20 * k + 0.1, 10 * k + 0.1) for k in range(10)]
    bench.touch({5: (1011, 501)})
    assert len(bench.read(source)) == 10
    bench.touch({})
    assert bench.read(source) == [(5, 101.1, 50.1, False)]


def test_what_an_ft5x06_holds_from_before_its_start_is_no_touch(bench):
    bench.put(Ft5x06Chip()).touch({0: (100, 200)})
    source = bench.ft5x06()
    assert bench.until_due(source)[1] == []
    assert source.warnings == {"stale_reports": 1}
    bench.touch({0: (110, 200)})
    assert bench.read(source) == [(0, 11, 20, True)]
    bench.touch({0: (100, 200)}, put_down={0})  # byte for byte what it held then
    assert bench.read(source) == [(0, 10, 20, True)]


@each_row("chip_id", [0x06, 0x36, 0x54, 0x55, 0x64], afresh=[bench])
def test_chips_of_the_family_are_known_whatever_their_number(bench, chip_id):
    bench.put(Ft5x06Chip(chip_id=chip_id))
    assert bench.ft5x06()._reader.description.name == f"FT5x06 chip {chip_id:02x}"


@each_row("byte", [0x00, 0xFF, 0x5A], afresh=[bench])
def test_an_empty_chip_a_stuck_bus_and_a_chip_without_registers_are_refused(bench, byte):
    """0x5A: such as a PCF8574A, an expander that has the same address and gives its pins whatever it is asked."""
    bench.put(Ft5x06Chip()).garbage = byte
    with pytest.raises(TouchError, match=f"at 0x38 .* no FocalTech chip .* all 0x{byte:02X}"):
        bench.ft5x06()
    assert bench.lines.listening is None
    assert bench.open_buses() == 0
    bench.put(Ft5x06Chip()).registers[:] = bytes([byte]) * 256
    with pytest.raises(TouchError, match="no FocalTech chip"):
        bench.ft5x06()


def test_a_firmware_that_leaves_some_of_its_identity_empty_is_taken(bench):
    chip = bench.put(Ft5x06Chip(chip_id=0))
    chip.registers[0xA6] = 0
    assert chip.registers[0xA8]
    assert bench.ft5x06().present


def test_an_ft5x06_that_lost_its_power_is_set_to_work_again_and_an_empty_one_in_its_place_is_not(bench):
    bench.put(Ft5x06Chip())
    source = bench.ft5x06()
    bench.touch({0: (100, 200)})
    bench.read(source)
    bench.chip.silent = True
    bench.touch({})
    assert bench.read(source) == [(0, 10, 20, False)]
    bench.chip.silent = False
    bench.chip.garbage = 0xFF
    assert bench.until_due(source) == (0.5, [])
    assert not source.present
    bench.chip.garbage = None
    bench.chip.power_up()
    assert bench.chip.registers[0xA4] == 0
    bench.until_due(source)
    assert source.present
    assert bench.chip.registers[0xA4] == 1
    bench.touch({0: (100, 200)})
    assert bench.read(source) == [(1, 10, 20, True)]


def test_an_edt_m12_has_the_registers_and_says_its_model(bench):
    bench.put(Ft5x06Chip(chip_id=0x54)).registers[0xBB:0xCA] = b"EP0500M12*A0.1$"
    source = bench.ft5x06()
    assert source._reader.description.name == "EDT EP0500M12"
    bench.touch({0: (100, 200)})
    assert bench.read(source) == [(0, 10, 20, True)]


# ---- EDT M06


def test_an_edt_m06_is_found_out_and_its_reports_are_read(bench):
    bench.put(EdtM06Chip())
    source = bench.ft5x06()
    assert source._reader.description.name == "EDT EP0570M06"
    assert bench.lines.listening is Edge.FALLING
    one = {1: (100, 200)}
    bench.touch(one)
    assert bench.read(source) == []  # just put down: the place is not true yet
    bench.touch(one)
    assert bench.read(source) == [(0, 10, 20, True)]
    many = {number: (200 * number + 1, 100 * number + 1) for number in range(5)}
    bench.touch(many)
    bench.read(source)
    bench.touch(many)
    assert len(bench.read(source)) == 4
    assert sorted(place[1:3] for place in in_short_now(source)) == [(20 * k + 0.1, 10 * k + 0.1) for k in range(5)]
    bench.touch({3: (601, 301)})
    assert [contact for *_, contact in bench.read(source)] == [False] * 4
    bench.touch({})
    assert len(bench.read(source)) == 1
    assert not source.warnings


def in_short_now(source):
    """Fingers that are down, as (finger, x in mm, y in mm)."""
    return [(finger, round(x_m * 1e3, 6), round(y_m * 1e3, 6)) for finger, x_m, y_m in source._decoder.fingers()]


@pytest.mark.parametrize("fault", ["damaged", "headless"])
def test_a_damaged_report_of_an_edt_m06_changes_nothing(bench, fault):
    bench.put(EdtM06Chip())
    source = bench.ft5x06()
    for _ in range(2):
        bench.touch({1: (100, 200)})
        samples = bench.read(source)
    assert samples == [(0, 10, 20, True)]
    setattr(bench.chip, fault, 1)
    bench.touch({1: (110, 200)})
    assert bench.read(source) == []
    assert source.warnings == {"report_absurd": 1}
    bench.touch({1: (120, 200)})
    assert bench.read(source) == [(0, 12, 20, True)]


def test_what_an_edt_m06_holds_from_before_its_start_is_no_touch(bench):
    chip = bench.put(EdtM06Chip())
    for _ in range(2):
        chip.touch({1: (100, 200)})
    source = bench.ft5x06()
    assert bench.until_due(source)[1] == []
    assert source.warnings == {"stale_reports": 1}
    bench.touch({1: (110, 200)})
    assert bench.read(source) == [(0, 11, 20, True)]


# ---- whatever happens


@each_row("make", [Gt911Chip, Ft5x06Chip, EdtM06Chip])
@each_row("seed", range(4), afresh=[bench])
def test_whatever_the_bus_does_the_reader_goes_on_and_a_panel_that_works_again_is_felt_again(bench, make, seed):
    random = Random(seed)
    chip = bench.put(make())
    source = (bench.gt911 if make is Gt911Chip else bench.ft5x06)(reset_line=random.choice(["", "RST"]))
    down = set()

    def look(samples):
        for finger, _, _, contact in samples:
            assert contact or finger in down
            (down.add if contact else down.discard)(finger)

    for _ in range(300):
        fault = random.choice(["none", "none", "none", "nacks", "silent", "hangs", "garbage", "power"])
        chip.silent, chip.garbage = fault == "silent", random.randrange(256) if fault == "garbage" else None
        chip.nacks = random.randrange(5) if fault == "nacks" else 0
        chip.hangs = fault == "hangs"
        if fault == "power" and make is not EdtM06Chip:
            chip.power_up()
        held = {
            number: (random.randrange(1, 400), random.randrange(1, 400)) for number in random.sample(range(5), random.randrange(5))
        }
        bench.touch(held, pulse=random.random() < 0.7)
        look(bench.read(source))
        for _ in range(random.randrange(4)):
            look(bench.until_due(source)[1])
        bench.now_s += random.choice([0, 1e-3, 8e-3, 0.1, 0.6])
    chip.silent, chip.garbage, chip.nacks, chip.hangs = False, None, 0, False
    for _ in range(200):  # it is started again, if need be, and what it holds is let go
        bench.touch({})
        look(bench.until_due(source)[1])
    assert source.present
    assert not down
    for x in (100, 110):
        bench.now_s += 8e-3
        bench.touch({0: (x, 100)})
        look(bench.read(source))
    assert len(down) == 1

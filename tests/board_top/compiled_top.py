"""boards/ulx3s/top.v as it is, compiled with the parameters of its bitstream, by its pins; and what the board's files say of them.

The library (ulx3s.cpp) keeps time, SPI and recording to itself. Times are picoseconds since configuration.
"""

import ctypes
import re
import weakref
from functools import cache
from pathlib import Path

import numpy as np

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.fpga.build_hash import build_hash
from controller.device.fpga.build_parameters import top_parameters
from controller.workshop.gateware.rtl_build import Design, build_library

HERE = Path(__file__).parent
BOARD = data_folder("boards") / "ulx3s"
TOP = Design(
    "top",
    (BOARD / "top.v", HERE / "EHXPLLL.v", HERE / "OSCG.v", HERE / "OB.v", HERE / "IB.v"),
    HERE / "ulx3s.cpp",
    ("-DSYNTHESIS", "--timing", "--pins-inout-enables", "--timescale", "1ps/1ps", "-Wno-fatal", "-Wno-lint"),
)
PS = 10**12
SPARE = (1 << 11, 1 << 39, 1 << 12, 1 << 40)  # gp[11], gn[11], gp[12], gn[12]: no signal of the FPGA, and no input
MISO = 1 << 37
UART = 1 << 56  # its line into the FPGA


def parameters():
    """Of top.v, as its bitstream is built."""
    return top_parameters(load_board(BOARD / "board.toml"), build_hash(data_folder("fpga_rtl")))


@cache
def pulled_up():
    """Header pins that pins.lpf pulls up; all others are pulled down."""
    found = re.findall(r'^IOBUF PORT "(g[pn]\[\d+\])" PULLMODE=(\w+)', (BOARD / "pins.lpf").read_text(), re.MULTILINE)
    assert {pull for _, pull in found} == {"UP", "DOWN"}
    return sum(pin(name) for name, pull in found if pull == "UP")


@cache
def inputs():
    """Header pins that top.v takes to inputs of the core."""
    top = (BOARD / "top.v").read_text()
    found = dict(re.findall(r"IB \w+_pad +\(\.I\((g[pn]\[\d+\])\), +\.O\((\w+)\)\)", top))
    assert {f".{name}_i({name})" in top for name in found.values()} == {True}
    assert len(found) == 6
    return sum(map(pin, found))


def pin(name):
    """Bit of a header pin, such as gp[10] or GP10."""
    row, number = re.fullmatch(r"(g[pn])\[?(\d+)\]?", name.lower()).groups()
    return 1 << int(number) + (28 if row == "gn" else 0)


def section(title):
    """Rows of the table of the board's README.md whose head begins with this."""
    (table,) = re.findall(rf"^\| {title} \|.*\n((?:\|.*\n)+)", (BOARD / "README.md").read_text(), re.MULTILINE)
    return [[cell.strip() for cell in row.strip("|").split("|")] for row in table.splitlines()[1:]]


@cache
def channel_pins():
    """(channel,) bit of each channel's header pin: "even channels on GP, odd on GN"."""
    pins = {}
    for signal, place, *_ in section("signal"):
        if found := re.fullmatch(r"channels (\d+)–(\d+)", signal):
            first, last = map(int, found.groups())
            begin = int(re.search(r"GP(\d+)", place)[1])
            for channel in range(first, last + 1):
                offset = channel - first
                pins[channel] = pin(f"{'gn' if offset % 2 else 'gp'}{begin + offset // 2}")
    return [pins[channel] for channel in range(32)]


@cache
def signal_pins():
    """Header pin of each other signal, by the README's name."""
    pins = {}
    for signal, place, *_ in section("signal"):
        names, places = signal.split(", "), re.findall(r"G[PN]\d+", place)
        if len(names) == len(places) and "channels" not in signal:
            pins |= dict(zip((name.removeprefix("SPI ") for name in names), map(pin, places), strict=True))
    return pins


@cache
def wires():
    """Header pin at the other end of each GPIO of the Raspberry Pi."""
    pins = {}
    for ours, _, theirs in section("Pi"):
        numbers, places = re.findall(r"\d+", ours.split("(")[0]), re.findall(r"G[PN]\d+", theirs)
        if numbers:
            pins |= {f"GPIO{number}": pin(place) for number, place in zip(numbers, places, strict=False)}
    return pins


class CompiledTop:
    """The board with power and its oscillator running, from its configuration on; nothing drives its pins."""

    def __init__(self, library=None):
        self._library = _load(library or build_library(parameters(), design=TOP))
        self._board = self._library.board_open(inputs(), pulled_up())
        weakref.finalize(self, self._library.board_close, self._board)
        self._mask = self._levels = 0
        self._stuck = self._stuck_levels = 0

    @property
    def now_ps(self):
        return self._library.board_now(self._board)

    @property
    def now_s(self):
        return self.now_ps / PS

    def run(self, ps):
        """So much longer."""
        self._library.board_run(self._board, self.now_ps + round(ps))

    def run_until(self, ps):
        self._library.board_run(self._board, round(ps))

    def drive(self, pins, level):
        """Drive header pins from outside; None lets go of them."""
        self._mask = self._mask & ~pins if level is None else self._mask | pins
        self._levels = self._levels | pins if level else self._levels & ~pins
        self._drive()

    def stick(self, pins, level):
        """Hold header pins at a level, whatever else drives them; None lets go, and is what a broken wire leaves: the pull."""
        self._stuck |= pins
        if level is None:
            self._stuck_levels = self._stuck_levels & ~pins | (pulled_up() | UART) & pins
        else:
            self._stuck_levels = self._stuck_levels | pins if level else self._stuck_levels & ~pins
        self._drive()

    def mend(self):
        """Nothing is stuck any more."""
        self._stuck = self._stuck_levels = 0
        self._drive()

    def _drive(self):
        levels = self._levels & ~self._stuck | self._stuck_levels
        self._library.board_drive(self._board, self._mask | self._stuck, levels)

    def oscillate(self, runs, *, lock_stays=False):
        """Stop the oscillator, under the PLL's lock or not, or let it run; or, under its lock, the PLL alone, for ever."""
        self._library.board_oscillate(self._board, runs, lock_stays)

    def high(self, pins):
        """Whether all of these header pins are high."""
        levels = self._library.board_levels(self._board)
        return (levels & ~self._stuck | self._stuck_levels) & pins == pins

    @property
    def levels(self):
        """All pins, as anyone sees them."""
        return self._library.board_levels(self._board)

    @property
    def driven(self):
        """Pins that the FPGA drives."""
        return self._library.board_driven(self._board)

    @property
    def leds(self):
        """Bits 0 to 7: led; 8: wifi_gpio0."""
        return self._library.board_leds(self._board)

    def exchange(self, pins, sent, sck_hz, lead_ps=200_000, lag_ps=100_000):
        """One chip-select assertion at pins SCK, CS, MOSI, MISO; what came back."""
        self._mask |= pins[0] | pins[1] | pins[2]
        self._levels = self._levels & ~(pins[0] | pins[2]) | pins[1]
        # what the controller does with a wire that is stuck ends nowhere
        pins = [spare if pin & self._stuck else pin for pin, spare in zip(pins, SPARE, strict=True)]
        if self._stuck:
            self._drive()
        wires_of_spi = (ctypes.c_uint64 * 4)(*pins)
        received = ctypes.create_string_buffer(len(sent))
        period_ps = round(PS / sck_hz)
        self._library.board_exchange(self._board, wires_of_spi, lead_ps, period_ps, lag_ps, len(sent), bytes(sent), received)
        if pins[3] in SPARE:
            return (b"\xff" if self._stuck_levels & self._stuck & MISO else b"\0") * len(sent)
        return received.raw

    def take(self):
        """(times in ps, pins that the FPGA drives high from then on), since this was last asked for."""
        count = self._library.board_changes(self._board)
        times, words = np.empty(count, np.uint64), np.empty(count, np.uint64)
        self._library.board_take(self._board, times.ctypes.data, words.ctypes.data)
        return times, words


def channels_of(words):
    """(n,) uint32 drive words on the header's channel pins."""
    found = np.zeros(len(words), np.uint32)
    for channel, bit in enumerate(channel_pins()):
        found |= ((words & np.uint64(bit)) != 0).astype(np.uint32) << np.uint32(channel)
    return found


@cache
def _load(path):
    library = ctypes.CDLL(str(path))
    board, number, size, address = ctypes.c_void_p, ctypes.c_uint64, ctypes.c_size_t, ctypes.c_void_p
    for name, result, arguments in (
        ("open", board, [number, number]),
        ("close", None, [board]),
        ("now", number, [board]),
        ("levels", number, [board]),
        ("driven", number, [board]),
        ("leds", ctypes.c_uint32, [board]),
        ("drive", None, [board, number, number]),
        ("oscillate", None, [board, ctypes.c_uint32, ctypes.c_uint32]),
        ("run", None, [board, number]),
        ("exchange", None, [board, address, number, number, number, size, ctypes.c_char_p, address]),
        ("changes", size, [board]),
        ("take", None, [board, address, address]),
    ):
        function = getattr(library, f"board_{name}")
        function.restype, function.argtypes = result, arguments
    return library

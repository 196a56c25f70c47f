"""The top.v of a board as it is, with its bitstream's parameters, compiled, by its pins; and what its files say of them.

The library (board.cpp) keeps time, SPI and recording to itself. Times are picoseconds since configuration. A pin is a bit, by the
port of the top that it is: where on a header it is say the board's file of pins and, for the wires, its README.md.
"""

import ctypes
import re
import weakref
from fractions import Fraction
from functools import cache, cached_property
from pathlib import Path

import numpy as np
from fpga_pins import oscillator_ps, read_pins

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.build_parameters import top_parameters
from controller.workshop.gateware.rtl_build import Design, build_library

HERE = Path(__file__).parent
PS = 10**12
CHANNELS = [f"channel[{channel}]" for channel in range(32)]
INPUTS = {  # port of the top, by the name of the READMEs
    "SCK": "spi_sck",
    "CS": "spi_cs_n",
    "MOSI": "spi_mosi",
    "trigger": "trigger",
    "run permit": "run_permit",
    "temperature good": "temperature_ok",
}
OUTPUTS = {"MISO": "spi_miso"} | {name: name for name in ("configured", "hv_enable", "hv_alive", "focus", "fault", "waiting")}
SIGNALS = INPUTS | OUTPUTS
PORTS = [*CHANNELS, *SIGNALS.values()]  # in the order of board.cpp
UART = 1 << len(PORTS)  # its line into the FPGA, and that out of it
SPARE = tuple(1 << bit for bit in range(48, 52))  # no pin of the FPGA
BOARDS = [file.parent.name for file in sorted(data_folder("boards").glob("*/top.v"))]


def channel_pins():
    """(channel,) bit of each channel."""
    return [1 << channel for channel in range(32)]


def signal_pins():
    """Bit of each other signal, by the README's name."""
    return {name: 1 << PORTS.index(port) for name, port in SIGNALS.items()}


MISO = signal_pins()["MISO"]


class BoardFiles:
    """What a board's files say of its pins."""

    def __init__(self, name):
        self.folder = data_folder("boards") / name
        self.board = load_board(self.folder / "board.toml")
        self.pins = read_pins(self.folder)
        self.oscillator_ps = oscillator_ps(self.folder)

    @property
    def clock_ps(self):
        """Period that the PLL's model makes: whole picoseconds between edges."""
        ratio = Fraction(self.board.link.clock_hz * self.oscillator_ps / PS).limit_denominator(64)
        return 2 * int(self.oscillator_ps // 2 / ratio)

    @cached_property
    def named(self):
        """{name of a pin on the board: bit}."""
        return {pin.name: 1 << PORTS.index(pin.port) for pin in self.pins.values() if pin.name}

    @property
    def pulled_up(self):
        """Pins that are pulled up; all others are pulled down."""
        assert {self.pins[port].pull for port in PORTS} == {"UP", "DOWN"}
        up = sum(1 << PORTS.index(port) for port in PORTS if self.pins[port].pull == "UP")
        return up | (UART if self.pins["uart_rx"].pull == "UP" else 0)

    def section(self, title):
        """Rows of the table of README.md whose head begins with this."""
        (table,) = re.findall(rf"^\| {title} \|.*\n((?:\|.*\n)+)", (self.folder / "README.md").read_text(), re.MULTILINE)
        return [[cell.strip() for cell in row.strip("|").split("|")] for row in table.splitlines()[1:]]

    @cached_property
    def wires(self):
        """Pin at the other end of each GPIO of the Raspberry Pi: README.md says which, the file of pins what is there."""
        pins = {}
        for ours, _, theirs in self.section("Pi"):
            numbers = re.findall(r"\d+", ours.split("(")[0])
            if numbers:
                pins |= {f"GPIO{number}": self.named[place] for number, place in zip(numbers, names_in(theirs), strict=False)}
        return pins

    def parameters(self):
        """Of top.v, as its bitstream is built."""
        return top_parameters(self.board, build_hash(data_folder("fpga_rtl")))

    @property
    def design(self):
        """For the simulator: top.v, what is between it and the core, and models of the FPGA's own cells."""
        between = sorted((data_folder("fpga_rtl") / "board").glob("*.v"))
        return Design(
            "top",
            (self.folder / "top.v", *between, *sorted(HERE.glob("*.v"))),
            HERE / "board.cpp",
            ("-DSYNTHESIS", "--timing", "--timescale", "1ps/1ps", "-Wno-fatal", "-Wno-lint"),
        )


files = cache(BoardFiles)
"""Of a board, by its name."""


def names_in(cell):
    """Names of header pins in a cell of a README, in order: GP8, P2_9; "P3_3–6" is four, "GP0, GN0, GP1 … GN7" sixteen."""
    if pairs := re.search(r"GP(\d+), GN\d+, GP\d+ … GN(\d+)", cell):
        return [f"G{row}{number}" for number in range(int(pairs[1]), int(pairs[2]) + 1) for row in "PN"]
    names = []
    for name, last in re.findall(r"\b(G[PN]\d+|[PJ]\d_\d+)(?:–(\d+))?", cell):
        row, first = re.fullmatch(r"(.*?)(\d+)", name).groups()
        names += [f"{row}{number}" for number in range(int(first), int(last or first) + 1)]
    return names


class CompiledTop:
    """A board with power and its oscillator running, from its configuration on; nothing drives its pins."""

    def __init__(self, name="ulx3s", library=None):
        own = files(name)
        self._library = _load(library or build_library(own.parameters(), design=own.design))
        self._pulled_up = own.pulled_up
        self._board = self._library.board_open(self._pulled_up, own.oscillator_ps // 2)
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
            self._stuck_levels = self._stuck_levels & ~pins | self._pulled_up & pins
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

    def oscillate(self, runs):
        """Stop the oscillator, or let it run."""
        self._library.board_oscillate(self._board, runs)

    def pll(self, fault):
        """A fault of the PLL from now on: its `lock_stays` without a clock, or `clk_stops` under it, or its `lock_blinks`, once."""
        self._library.board_pll(self._board, f"+{fault}".encode())

    def high(self, pins):
        """Whether all of these header pins are high."""
        levels = self._library.board_levels(self._board)
        return (levels & ~self._stuck | self._stuck_levels) & pins == pins

    @property
    def levels(self):
        """All pins, as anyone sees them."""
        return self._library.board_levels(self._board)

    @property
    def leds(self):
        """Of a ULX3S; bits 0 to 7: led; 8: wifi_gpio0."""
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
    """(n,) uint32 drive words on the channels' pins."""
    return words.astype(np.uint32)


@cache
def _load(path):
    library = ctypes.CDLL(str(path))
    board, number, size, address = ctypes.c_void_p, ctypes.c_uint64, ctypes.c_size_t, ctypes.c_void_p
    for name, result, arguments in (
        ("open", board, [number, number]),
        ("close", None, [board]),
        ("now", number, [board]),
        ("levels", number, [board]),
        ("leds", ctypes.c_uint32, [board]),
        ("drive", None, [board, number, number]),
        ("oscillate", None, [board, ctypes.c_uint32]),
        ("pll", None, [board, ctypes.c_char_p]),
        ("run", None, [board, number]),
        ("exchange", None, [board, address, number, number, number, size, ctypes.c_char_p, address]),
        ("changes", size, [board]),
        ("take", None, [board, address, address]),
    ):
        function = getattr(library, f"board_{name}")
        function.restype, function.argtypes = result, arguments
    return library

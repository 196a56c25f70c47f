"""What a clock of the FPGA costs in the compiled Verilog: host instructions, the same on every machine, and processor time.

    python -m tests.workshop.benchmark.gateware_instructions [--functions N]

The simulated panel is armed, rests for some clocks, then plays one slot while a waveform of full length is uploaded into
another at 25 MHz, and plays it again alone: with leaps over clocks in which only counters move, and with every clock computed.
Needs valgrind, and what `run --link rtl` needs. `--functions` lists where most instructions went. Times are the least processor
times of some rounds, in which the two take turns; callgrind counts.
"""

from __future__ import annotations

import argparse
import ctypes
import json
import random
import re
import subprocess
import sys
import tempfile
import time
import zlib
from dataclasses import replace
from pathlib import Path
from typing import Any

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder, find_board
from controller.device.fpga import frames
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.frames import Play
from controller.device.fpga.registers import Control, Register, Start
from controller.workshop.gateware.pin_timing import READY_TICKS
from controller.workshop.gateware.rtl_build import build_library, clocked_design, core_design

RESTING_TICKS = 50_000
FRAME_GAP_TICKS = 800
WORDS = 1000
KEPT = 0.75  # share of the bits that are as they were a word ago: 125,000 edges a second of each channel
PHASES = ("armed, at rest", "playing, an upload on the wire", "playing")
ROUNDS = 6
Step = tuple[str, Any, Any, str]  # method, two ticks or pin and tick, bytes in hexadecimal


class Session:
    """Steps of the session, with the ticks of the phases.

    BuildParameters
    ----------
    parameters : BuildParameters
    """

    def __init__(self, parameters: BuildParameters) -> None:
        self.steps: list[Step] = [("set", pin, 2, "1") for pin in (1, 2)]
        self.tick = READY_TICKS
        self.marks: list[tuple[int, int]] = []
        self._clock_hz = parameters.clock_hz
        self._sequence = 0
        self._buffer = bytearray(frames.LOAD_FRAME_BYTES)

    def send(self, pack: Any, *arguments: Any, **named: Any) -> None:
        """A frame at 25 MHz, and the pause behind it."""
        self._sequence += 1
        end = pack(self._buffer, 0, self._sequence, *arguments, **named)
        release = self.tick + 10 + round(8 * end * self._clock_hz / 25e6)
        self.steps.append(("exchange", self.tick, release, bytes(self._buffer[:end]).hex()))
        self.tick = release + FRAME_GAP_TICKS

    def wait(self, ticks: int) -> None:
        self.tick += ticks
        self.steps.append(("run", self.tick, 0, ""))

    def mark(self) -> None:
        """A phase begins, or the last one has ended."""
        self.marks.append((len(self.steps), self.tick))

    def upload(self, slot: int, words: list[int]) -> None:
        data = b"".join(word.to_bytes(4, "little") for word in words)
        for chunk in range(-(-len(words) // 125)):
            self.send(frames.pack_load, chunk, memoryview(data)[500 * chunk : 500 * (chunk + 1)])
        self.send(frames.pack_store, slot, len(words), zlib.crc32(data))


def waveform(seed: int) -> list[int]:
    rng, word, words = random.Random(seed), 0, []
    for _ in range(WORDS):
        word ^= sum(1 << bit for bit in range(32) if rng.random() > KEPT)
        words.append(word)
    return words


def session(parameters: BuildParameters) -> Session:
    """What is measured."""
    run = Session(parameters)
    run.send(frames.pack_write, Register.IDLE_WORD, 0x96969696)
    run.send(frames.pack_write, Register.RAMP_SAMPLES, 4)
    run.upload(0, waveform(1))
    run.send(frames.pack_unlock, parameters.build_hash)
    run.send(frames.pack_control, Control.ARM)
    run.wait(4000)
    run.mark()
    run.wait(RESTING_TICKS)
    run.mark()
    for uploads in (1, 0):
        ends = run.tick + WORDS * (parameters.bit_period_reset >> 16)
        run.send(frames.pack_play, Play(0, length=0, emissions=1, start=Start.NOW))
        for slot in range(1, 1 + uploads):
            run.upload(slot, waveform(2))
        run.wait(ends - run.tick)
        run.mark()
    return run


def perform(library: str, steps: list[Step]) -> list[float]:
    """Perform a session in this process, with as little around it as can be; processor time before each step and at the end."""
    panel_library = ctypes.CDLL(library)
    panel_library.panel_open.restype = ctypes.c_void_p
    panel = ctypes.c_void_p(panel_library.panel_open())
    tick, size = ctypes.c_uint64, ctypes.c_size_t
    times_s = []
    for method, first, second, data in steps:
        times_s.append(time.process_time())
        if method == "set":
            panel_library.panel_set(panel, first, tick(second), int(data))
        elif method == "run":
            panel_library.panel_run(panel, tick(first))
        else:
            mosi = bytes.fromhex(data)
            miso = ctypes.create_string_buffer(len(mosi))
            panel_library.panel_exchange(panel, tick(first), tick(second), size(len(mosi)), mosi, miso)
    times_s.append(time.process_time())
    panel_library.panel_close(panel)
    return times_s


def instructions(library: Path, steps: list[Step], folder: Path) -> int:
    """Instructions of the clocks of a session; callgrind's file is `out` in the folder."""
    file = folder / "steps.json"
    file.write_text(json.dumps(steps))
    counting = ["--collect-atstart=no", "--toggle-collect=*Panel::run*", f"--callgrind-out-file={folder / 'out'}"]
    command = ["valgrind", "--tool=callgrind", *counting, sys.executable, "-m", "tests.workshop.benchmark.gateware_instructions"]
    subprocess.run([*command, "--perform", str(library), str(file)], check=True, capture_output=True)
    return int(re.findall(r"^totals: (\d+)", (folder / "out").read_text(), re.MULTILINE)[0])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--functions", type=int, default=0, metavar="N")
    parser.add_argument("--perform", nargs=2, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.perform:
        perform(arguments.perform[0], json.loads(Path(arguments.perform[1]).read_text()))
        return
    built = BuildParameters.of(load_board(find_board("simulated")), build_hash(data_folder("fpga_rtl")))
    parameters = replace(built, hv_settle_ticks=100)
    libraries = {
        name: build_library(parameters.verilog(), design=design)
        for name, design in (("with leaps", core_design()), ("every clock", clocked_design()))
    }
    run = session(parameters)
    spans = list(zip(PHASES, run.marks, run.marks[1:], strict=False))
    least_s = {name: [float("inf")] * len(spans) for name in libraries}
    for _ in range(ROUNDS):
        for name, library in libraries.items():
            times_s = perform(str(library), run.steps)
            taken_s = [times_s[end] - times_s[begin] for _, (begin, _), (end, _) in spans]
            least_s[name] = [min(pair) for pair in zip(least_s[name], taken_s, strict=True)]
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for name, library in libraries.items():
            counted = [instructions(library, run.steps[:steps], folder) for steps, _ in run.marks]
            for number, (phase, (_, begin), (_, end)) in enumerate(spans):
                clocks = end - begin
                per_clock, rate = (counted[number + 1] - counted[number]) / clocks, clocks / least_s[name][number]
                print(f"{name}: {phase}: {per_clock:,.1f} instructions a clock, {rate / 1e6:,.1f} million clocks/s")
            if arguments.functions:
                listed = subprocess.run(["callgrind_annotate", folder / "out"], check=True, capture_output=True, text=True).stdout
                print("\n".join(listed.split("\n")[20 : 24 + arguments.functions]))


if __name__ == "__main__":
    main()

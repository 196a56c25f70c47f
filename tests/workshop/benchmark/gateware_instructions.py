"""Host instructions that the compiled Verilog takes for a clock of the FPGA, counted by callgrind: the same on every machine.

    python -m tests.workshop.benchmark.gateware_instructions [--functions N]

The simulated panel is armed, rests for some clocks, and then plays one slot while a waveform of full length is uploaded into
another at 25 MHz. Needs valgrind, and what `run --link rtl` needs. `--functions` lists where most instructions went.
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
import zlib
from dataclasses import replace
from pathlib import Path
from typing import Any

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder, find_board
from controller.device.fpga import frames
from controller.device.fpga.build_hash import build_hash
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.frames import Play
from controller.device.fpga.registers import Control, Register, Start
from controller.workshop.gateware.pin_timing import READY_TICKS
from controller.workshop.gateware.rtl_build import build_library

RESTING_TICKS = 50_000
FRAME_GAP_TICKS = 800
WORDS = 1000
KEPT = 0.75  # share of the bits that are as they were a word ago: 125,000 edges a second of each channel
PHASES = ("armed, at rest", "playing, an upload on the wire")
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
    ends = run.tick + WORDS * (parameters.bit_period_reset >> 16)
    run.send(frames.pack_play, Play(0, length=0, emissions=1, start=Start.NOW))
    run.upload(1, waveform(2))
    run.wait(ends - run.tick)
    run.mark()
    return run


def perform(library: str, steps: list[Step]) -> None:
    """Perform a session in this process, under callgrind: with as little around it as can be."""
    panel_library = ctypes.CDLL(library)
    panel_library.panel_open.restype = ctypes.c_void_p
    panel = ctypes.c_void_p(panel_library.panel_open())
    tick, size = ctypes.c_uint64, ctypes.c_size_t
    for method, first, second, data in steps:
        if method == "set":
            panel_library.panel_set(panel, first, tick(second), int(data))
        elif method == "run":
            panel_library.panel_run(panel, tick(first))
        else:
            mosi = bytes.fromhex(data)
            miso = ctypes.create_string_buffer(len(mosi))
            panel_library.panel_exchange(panel, tick(first), tick(second), size(len(mosi)), mosi, miso)


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
    library = build_library(parameters.verilog())
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        run = session(parameters)
        counted = [(instructions(library, run.steps[:steps], folder), tick) for steps, tick in run.marks]
        for phase, (before, begin), (after, end) in zip(PHASES, counted, counted[1:], strict=False):
            print(f"{phase}: {(after - before) / (end - begin):,.0f} instructions a clock")
        if arguments.functions:
            listed = subprocess.run(["callgrind_annotate", folder / "out"], check=True, capture_output=True, text=True).stdout
            print("\n".join(listed.split("\n")[20 : 24 + arguments.functions]))


if __name__ == "__main__":
    main()

"""Python calls and bytecodes of one turn of the loop that plays two fingers, and how often calls go to another module.

    python -m tests.workshop.benchmark.turn_calls [--list]

Two fingers are put down in the same report; both feel it, the waveform is composed and uploaded. The link says yes
(`null_link.py`), so that what is counted is the host's. Counted by `sys.setprofile` are calls of the controller's Python
functions, and changes of module: calls, in the order in which they begin, of another module than the call before. Those of the
kernel, which may be its Python twin, are left out: the same on every machine. Bytecodes are those of the same functions: the
same with each Python of one version.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections import Counter
from pathlib import Path
from types import FrameType
from typing import Any

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.loop.context import LoopContext
from controller.device.loop.event_loop import EventLoop
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from tests.workshop.benchmark.null_link import NullLink

ROOT = Path(__file__).parents[3]
SCENE = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'
AXES = "A: 2f 0 9 0 0 0\nA: 35 0 2100 0 0 0\nA: 36 0 1480 0 0 0\nA: 39 0 65535 0 0 0\n"  # tenths of a millimetre on the plate
TAPS = 3  # the first ones fill caches
FINGERS = ((60, 54), (150, 94))  # mm
VIRTUAL_NOW_S = VirtualClock.now_s.__code__  # of this measurement only: a device asks `time.monotonic` itself


class Profile:
    """Calls and changes of module of the project's Python functions while it is on."""

    def __init__(self) -> None:
        self.calls = 0
        self.changes = 0
        self.bytecodes = 0
        self.edges: Counter[tuple[str, str]] = Counter()
        self._stack: list[str] = []
        self._last = ""

    def __enter__(self) -> Profile:
        sys.settrace(self._step)
        sys.setprofile(self._event)
        return self

    def __exit__(self, *_: object) -> None:
        sys.setprofile(None)
        sys.settrace(None)

    def _step(self, frame: FrameType, event: str, _: Any) -> Any:
        if not _counts(frame):
            return None
        frame.f_trace_opcodes = True
        self.bytecodes += event == "opcode"
        return self._step

    def _event(self, frame: FrameType, event: str, _: Any) -> None:
        if event not in {"call", "return"} or not _counts(frame):
            return
        module = frame.f_globals["__name__"]
        if event == "call":
            if self._stack:
                self.calls += 1
                self.changes += module != self._last
                if module != self._stack[-1]:
                    self.edges[self._stack[-1], f"{module}:{frame.f_code.co_name}"] += 1
            self._stack.append(module)
            self._last = module
        elif self._stack:
            self._stack.pop()


def _counts(frame: FrameType) -> bool:
    module = frame.f_globals.get("__name__", "")
    return (
        module.startswith("controller.") and not module.startswith("controller.device.kernel") and frame.f_code is not VIRTUAL_NOW_S
    )


def recording() -> Recording:
    """Two fingers that tap at once, some times."""
    lines = [AXES]
    for tap in range(TAPS):
        down_s, up_s = 0.2 * tap, 0.2 * tap + 0.1
        for slot, (x_mm, y_mm) in enumerate(FINGERS):
            values = ((0x2F, slot), (0x39, 10 * tap + slot), (0x35, 10 * (x_mm + tap)), (0x36, 10 * y_mm))
            lines += [f"E: {down_s:.6f} 0003 {code:04x} {value:04d}\n" for code, value in values]
        lines.append(f"E: {down_s:.6f} 0000 0000 0000\n")
        for slot in range(len(FINGERS)):
            lines += [f"E: {up_s:.6f} 0003 002f {slot:04d}\n", f"E: {up_s:.6f} 0003 0039 -001\n"]
        lines.append(f"E: {up_s:.6f} 0000 0000 0000\n")
    return Recording("".join(lines))


def profile(board: Board, bank: Bank, scene_file: Path) -> Profile:
    """Of the turn that plays the last tap."""
    clock = VirtualClock()
    link = NullLink(board, clock.now_s)
    session = open_session(link, board, clock.now_s)
    taps = recording()
    source = tracked(RecordingSource(taps, taps.axes(board), clock.now_s() + 0.1), board)
    assembly = assemble(LoopContext(board, clock, session, source), load_scene(scene_file, board), bank)
    assembly.selection.prepare()
    found = Profile()
    turn = EventLoop._turn

    def profiled(loop: EventLoop) -> float | None:
        nonlocal found
        before = assembly.counters.foci
        with Profile() as profile:
            next_s = turn(loop)
        if assembly.counters.foci == before + len(FINGERS):
            found.calls, found.changes, found.bytecodes, found.edges = (
                profile.calls,
                profile.changes,
                profile.bytecodes,
                profile.edges,
            )
        return next_s

    EventLoop._turn = profiled  # type: ignore[method-assign]
    try:
        assembly.loop.run(link.answer_alone)
    finally:
        EventLoop._turn = turn  # type: ignore[method-assign]
    assert assembly.counters.uploads == TAPS
    assert assembly.counters.foci == TAPS * len(FINGERS)
    return found


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(prog="python -m tests.workshop.benchmark.turn_calls", description=__doc__.partition("\n")[0])
    parser.add_argument("--list", action="store_true", help="also list the calls that go from one module to another")
    options = parser.parse_args()
    board = load_board(find_board("simulated"))
    with tempfile.TemporaryDirectory() as folder:
        bank_file, scene_file = Path(folder) / "ten.bank", Path(folder) / "scene.toml"
        build_bank(BankRequest(board, bank_file, 10e-3))
        scene_file.write_text(SCENE)
        with Bank.open(bank_file, board) as bank:
            counted = profile(board, bank, scene_file)
    if options.list:
        for (caller, called), times in sorted(counted.edges.items(), key=lambda edge: -edge[1]):
            print(f"{times:4} {caller.removeprefix('controller.')} -> {called.removeprefix('controller.')}")
    print(f"{counted.calls} calls, {counted.changes} changes of module, {counted.bytecodes} bytecodes")
    return 0


if __name__ == "__main__":
    sys.exit(main())

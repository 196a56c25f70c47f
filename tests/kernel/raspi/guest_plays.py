"""Runs in the emulated Pi: entries of the bank by `Session`, then the product's own loop, both through `SpiLink`.

usage: guest_plays.py FORM     of the package: only what is printed depends on it. 2 ns of the machine's time are one instruction.
"""

import sys
import time
from pathlib import Path

from controller.clocks import MonotonicClock
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.fpga.frames import Play
from controller.device.fpga.links.spi_link import SpiLink
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.touch.live_source import LiveSource
from controller.device.waveforms.selection import Selection
from controller.metrics import STAGES
from tests.workshop.benchmark.looped_panel import LoopedPanel

FORM = sys.argv[1]
TESTS = Path(__file__).parent / "tests"
EMISSIONS = 400
AT_MOST_S = 60
UPLOADED, RESIDENT = (0, 3, 7, 11), (2, 0, 3, 1, 1)  # cells, each in a slot of its own; slots
print(f"{FORM}: started and imported in {time.process_time():.2f} s of CPU", flush=True)


def play_entries(board, session, bank):
    """Entries uploaded and played, then played from their slots: by a trigger each. Prints the cells in order."""
    armed_s = session.arm()
    while time.monotonic() < armed_s:
        session.heartbeat()
    session.require_armed()
    selection = Selection(bank, board.bank.snap_mm * 1e-3, board.idle_word)
    played, begun = [], session.heartbeat().emissions
    for slot, cell in enumerate(UPLOADED):
        session.upload_and_play(Play(slot), selection.waveform(cell), stop=False)
        played.append(cell)
        finish(session, begun + len(played))
    for slot in RESIDENT:
        session.play(Play(slot), stop=False)
        played.append(UPLOADED[slot])
        finish(session, begun + len(played))
    ramped_s = session.disarm()
    while time.monotonic() < ramped_s:
        session.heartbeat()
    session.off()
    print(f"{FORM}: entries {' '.join(map(str, played))}", flush=True)


def finish(session, emissions):
    """Trigger what is queued, and wait for its end."""
    session.trigger()
    while session.heartbeat().emissions < emissions:
        pass


def play_loop(board, clock, session, bank):
    """Recordings round and round on a scene of many emissions. Prints what it counted, and the times of its stages."""
    recordings = sorted((TESTS / "device/touch/recordings").glob("*.ev*"))
    panel = LoopedPanel([find_board("simulated") / "demo.evemu", *recordings], clock.now_s() + 0.1)

    def progress(_):
        if counters.emissions >= EMISSIONS or clock.now_s() > last_s:
            panel.stopped = True

    source = tracked(LiveSource(panel, board), board)
    assembly = assemble(
        LoopContext(board, clock, session, source),
        load_scene(TESTS / "workshop/benchmark/scene.toml", board),
        bank,
        watch=Watch(progress),
    )
    counters = assembly.counters
    assembly.selection.prepare()
    for cell in bank.cells.nonzero()[0].tolist():  # as the service has it done beside the loop
        bank.responses.verify(cell)
    began_s = clock.now_s()
    last_s = began_s + AT_MOST_S
    armed = []
    assembly.loop.run(lambda: armed.append(clock.now_s()))
    print(f"{FORM}: armed {len(armed)} emissions {counters.emissions} uploads {counters.uploads} s {clock.now_s() - began_s:.2f}")
    names = ("heartbeats", "scheduled", "late", "prefetched", "host_silent", "outages")
    print(f"{FORM}: counted {' '.join(f'{name} {getattr(counters, name)}' for name in names)}")
    for what, latency in (("upload", counters.upload_latency), ("resident", counters.resident_latency)):
        for stage in STAGES:
            summary = getattr(latency, stage).summary_us()
            if summary["count"]:
                times = " ".join(f"{name} {summary[name]}" for name in ("p50", "p99", "worst"))
                print(f"{FORM}: {what} {stage} count {summary['count']} {times}")


def main():
    board = load_board(find_board("ulx3s"))
    clock = MonotonicClock()
    link = SpiLink(board.link, clock.now_s)
    session = open_session(link, board, clock.now_s)
    print(f"{FORM}: sck_hz {link.sck_hz:.0f} bufsiz {link.bufsiz}", flush=True)
    with Bank.open(Path("/root/panel.bank"), board) as bank:
        play_entries(board, session, bank)
        session.bring_up()
        play_loop(board, clock, session, bank)
    link.close()


main()

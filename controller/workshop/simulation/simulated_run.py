"""A run on the simulated panel: a recording through the event loop, against the gateware model or the compiled Verilog.

What the foci of a run were like is computed afterwards (`focus_evaluation`, `run_figures`), so that its computing time does not
affect latencies.
"""

import time
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from controller.clocks import MonotonicClock, VirtualClock
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.fpga.capture import Capture, merged
from controller.device.fpga.session import Session
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.playing.records import Played
from controller.device.loop.skips import ALL, Skips
from controller.device.loop.wiring import Assembly, assemble
from controller.device.scene.scene import Scene
from controller.device.service.bit_clock import BitClock
from controller.device.service.drivers import open_session, tracked
from controller.device.service.temperature import Thermometer
from controller.device.touch.recordings.recording import Recording, Track
from controller.device.touch.recordings.replay import RecordingSource
from controller.metrics import Counters, LatencyHistogram
from controller.workshop.gateware.gateware import GatewareFactory
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.simulated_link import SimulatedLink
from controller.workshop.gateware.wired_fpgas import SimulatedFpgas, open_simulated_panel
from controller.workshop.simulation.drift import Drift

SETTLE_S = 50e-3  # between arming and the first event of the recording
REAL_SETTLE_S = 0.3  # the same in real time, for a busy machine
REFERENCE_ROUNDS = 2000


@dataclass(frozen=True)
class Hardware:
    """What is simulated behind the loop."""

    gateware: GatewareFactory = GatewareModel  # makes the gateware: the model by default, or the compiled Verilog
    plate: Board | None = None  # whose plate and driver are behind the pins, if they are not the board's
    # Of the plate's frequencies; the board's temperature sensor, if it has one, says the temperature that this means
    drift: Drift | None = None


MODEL = Hardware()


@dataclass(frozen=True)
class Run:
    """Record of a run. The plate twin sees only `captures`; everything else is for the figures."""

    board: Board
    recording: Recording
    source: RecordingSource
    tracks: dict[int, Track]  # by the loop's finger number: all contacts of that finger joined
    counters: Counters
    capture: Capture  # of all FPGAs; its foci are those of the first
    played: list[Played]
    link: SimulatedLink | SimulatedFpgas
    start_s: float
    real_time: bool
    touch: dict[str, Any]  # figures of the tracker
    lookups: int
    response_mapped: bool
    reference: LatencyHistogram
    plate: Board  # whose plate is played on
    drift: Drift | None
    bit_clock: BitClock | None  # that follows the plate's temperature


def play(
    board: Board,
    scene: Scene,
    bank: Bank,  # holds the cells of the scene
    recording: Recording,  # touches; without any, nothing is played
    *,
    real_time: bool,  # False: virtual time, as fast as the machine can and deterministic
    ready: Callable[[], None] = lambda: None,  # called once the outputs are on
    skips: Skips = ALL,  # what of the loop's work is left out
    hardware: Hardware = MODEL,
) -> Run:
    """Replay a recording through the event loop into the gateware; raises FaultError or LinkError from the event loop."""
    clock = MonotonicClock() if real_time else VirtualClock()
    link = open_simulated_panel(board, clock.now_s, hardware.gateware)
    session = open_session(link, board, clock.now_s)
    played: list[Played] = []
    start_s = session.earliest_trigger_s() + board.limits.arming_s + (REAL_SETTLE_S if real_time else SETTLE_S)
    axes = recording.axes(board)
    tracks = recording.tracks(axes, start_s)
    if not tracks:  # without any touch nothing is played, fixed emitters included
        scene = Scene(())
    source = RecordingSource(recording, axes, start_s)
    contacts = {finger: [track] for finger, track in tracks.items()}
    tracker = tracked(source, board, lambda finger, contact: contacts[finger].append(tracks[contact]))
    bit_clock = _bit_clock(board, session, hardware.drift, lambda: clock.now_s() - start_s)
    assembly: Assembly

    def progress(now_s: float) -> None:  # what the service's housekeeping does about the temperature
        if bit_clock is not None and assembly.loop.outputs.on:
            bit_clock.follow(assembly.loop, now_s)

    context = LoopContext(board, clock, session, tracker)
    assembly = assemble(context, scene, bank, played=played.append, watch=Watch(progress), skips=skips)
    assembly.loop.run(ready)
    link.close()
    return Run(
        board=board,
        recording=recording,
        source=source,
        tracks={finger: Track.joined(finger, parts) for finger, parts in contacts.items()},
        counters=assembly.counters,
        capture=merged(link.take_captures()),
        played=played,
        link=link,
        start_s=start_s,
        real_time=real_time,
        touch=tracker.figures(),
        lookups=bank.counters.lookups,
        response_mapped=assembly.selection.composes,
        reference=copy_and_checksum(board.waveform.samples * 4),
        plate=hardware.plate or board,
        drift=hardware.drift,
        bit_clock=bit_clock,
    )


def _bit_clock(board: Board, session: Session, drift: Drift | None, time_s: Callable[[], float]) -> BitClock | None:
    """What follows the plate's temperature as it drifts, on a board with a sensor of it."""
    if drift is None or board.temperature is None:
        return None
    return BitClock(session, Thermometer(board.temperature, drift.sensor(board.temperature, time_s)), board.temperature.period_s)


def copy_and_checksum(size: int) -> LatencyHistogram:
    """Measure one copy and one CRC-32 of `size` bytes, which every upload needs: a lower bound of its host time."""
    histogram = LatencyHistogram()
    source = memoryview(bytes(np.random.default_rng(0).bytes(size)))
    target = memoryview(bytearray(size))
    for _ in range(REFERENCE_ROUNDS):
        started = time.perf_counter_ns()
        target[:] = source
        zlib.crc32(target)
        histogram.record(time.perf_counter_ns() - started)
    return histogram

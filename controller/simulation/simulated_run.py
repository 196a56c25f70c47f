"""A run on the simulated panel: a recording through the event loop, against the gateware model or the compiled Verilog.

What the foci of a run were like is computed afterwards (`focus_evaluation`, `run_figures`), so that its computing time does not
affect latencies.
"""

from __future__ import annotations

import time
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from controller.bank.reader import Bank
from controller.board.board import Board
from controller.clocks import MonotonicClock, VirtualClock
from controller.fpga.capture import Capture
from controller.gateware_model.gateware import GatewareFactory
from controller.gateware_model.model import GatewareModel
from controller.gateware_model.simulated_link import SimulatedLink
from controller.loop.records import Played
from controller.loop.skips import ALL, Skips
from controller.loop.wiring import Assembly, assemble
from controller.metrics import Counters, LatencyHistogram
from controller.scene.scene import Scene
from controller.service.bit_clock import BitClock
from controller.service.drivers import open_session, open_simulated, tracked
from controller.service.temperature import Thermometer
from controller.simulation.drift import Drift
from controller.touch.recording import Recording, Track
from controller.touch.replay import RecordingSource

SETTLE_S = 50e-3  # between arming and the first event of the recording
REAL_SETTLE_S = 0.3  # the same in real time, for a busy machine
REFERENCE_ROUNDS = 2000


@dataclass(frozen=True)
class Run:
    """Record of a run. The plate twin sees only `capture`; everything else is for the figures."""

    board: Board
    recording: Recording
    source: RecordingSource
    tracks: dict[int, Track]  # by the loop's finger number: all contacts of that finger joined
    counters: Counters
    capture: Capture
    played: list[Played]
    link: SimulatedLink
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
    bank: Bank,
    recording: Recording,
    *,
    real_time: bool,
    ready: Callable[[], None] = lambda: None,
    gateware: GatewareFactory = GatewareModel,
    skips: Skips = ALL,
    plate: Board | None = None,
    drift: Drift | None = None,
) -> Run:
    """Replay a recording through the event loop into the gateware.

    Parameters
    ----------
    board : Board
    scene : Scene
    bank : Bank
        Holds the cells of the scene.
    recording : Recording
        Touches; without any, nothing is played.
    real_time : bool
        False: virtual time, as fast as the machine can and deterministic.
    ready : callable
        Called once the outputs are on.
    gateware : GatewareFactory
        Makes the gateware: the model by default, or the compiled Verilog.
    skips : Skips
        What of the loop's work is left out.
    plate : Board, optional
        Whose plate and driver are behind the pins, if they are not the board's.
    drift : Drift, optional
        Of the plate's frequencies; the board's temperature sensor, if it has one, says the temperature that this means.

    Returns
    -------
    Run

    Raises
    ------
    FaultError, LinkError
        From the event loop.
    """
    clock = MonotonicClock() if real_time else VirtualClock()
    link = open_simulated(board, clock.now_s, gateware)
    session = open_session(link, board, clock.now_s)
    played: list[Played] = []
    start_s = session.earliest_trigger_s() + board.limits.arming_s + (REAL_SETTLE_S if real_time else SETTLE_S)
    axes = recording.axes(board)
    tracks = recording.tracks(axes, start_s)
    if not tracks:  # without any touch nothing is played, spots included
        scene = Scene(())
    source = RecordingSource(recording, axes, start_s)
    contacts = {finger: [track] for finger, track in tracks.items()}
    tracker = tracked(source, board, lambda finger, contact: contacts[finger].append(tracks[contact]))
    bit_clock = None
    if drift is not None and board.temperature is not None:
        sensor = drift.sensor(board.temperature, lambda: clock.now_s() - start_s)
        bit_clock = BitClock(session, Thermometer(board.temperature, sensor), board.temperature.period_s)
    assembly: Assembly

    def progress(now_s: float) -> None:  # what the service's housekeeping does about the temperature
        if bit_clock is not None and assembly.loop.outputs.on:
            bit_clock.follow(assembly.loop, now_s)

    told: dict[str, Any] = {"progress": progress} if bit_clock else {}
    assembly = assemble(board, scene, bank, clock, session, tracker, played=played.append, skips=skips, **told)
    assembly.loop.run(ready)
    link.close()
    return Run(
        board=board,
        recording=recording,
        source=source,
        tracks={finger: Track.joined(finger, parts) for finger, parts in contacts.items()},
        counters=assembly.counters,
        capture=link.take_capture(),
        played=played,
        link=link,
        start_s=start_s,
        real_time=real_time,
        touch=tracker.figures(),
        lookups=bank.counters.lookups,
        response_mapped=assembly.selection.composes,
        reference=copy_and_checksum(board.waveform.samples * 4),
        plate=board if plate is None else plate,
        drift=drift,
        bit_clock=bit_clock,
    )


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

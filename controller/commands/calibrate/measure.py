"""`haptic-panel calibrate measure`: measure the plate in place, with the panel's own FPGA and one sensor."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from controller.clocks import Clock, MonotonicClock, VirtualClock
from controller.commands.common.arguments import require_within
from controller.commands.common.named_board import board_of
from controller.commands.common.output import show
from controller.commands.common.tables import plain_table
from controller.console import tell
from controller.device.board.board import Board
from controller.device.board.identity import panel_identity, simulated_identity
from controller.device.service.drivers import open_link, open_session
from controller.errors import CalibrationError, LinkError, UsageError
from controller.programs import ProgramError, run_program

if TYPE_CHECKING:
    from controller.device.fpga.links.link import Link
    from controller.workshop.calibration.recording.in_place import InPlace, Recorder
    from controller.workshop.calibration.recording.simulated_recorder import SimulatedRecorder
    from controller.workshop.calibration.records.measurement_file import MeasurementFile
    from controller.workshop.gateware.simulated_link import SimulatedLink
    from controller.workshop.gateware.wired_fpgas import SimulatedFpgas

MOVE_S = 600.0  # that the program which moves the head may take
TRIES = 3  # of a point, before the measurement ends
SENSITIVITIES = {"v_per_m": "m", "v_per_m_s": "m/s", "v_per_m_s2": "m/s^2"}


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.add_argument("folder", metavar="FOLDER", help="of the measurement; one that was interrupted goes on where it was")
    step.add_argument("--points", metavar="FILE", required=True, help="positions from `calibrate plan --out`")
    sensor = step.add_mutually_exclusive_group()
    sensor.add_argument(
        "--alsa", metavar="NAME", help="sound card: the sensor on its first track, the drive of --sync on its second"
    )
    sensor.add_argument("--serial", metavar="TTY", help="sensor at a serial port, started by the FPGA's trigger")
    step.add_argument("--baud", type=int, default=921_600, metavar="N", help="with --serial (default: 921600)")
    step.add_argument("--rate-khz", type=float, default=192.0, metavar="F", help="of the sound card (default: 192)")
    step.add_argument("--full-scale", type=float, default=1.0, metavar="V", help="of the sound card, in V (default: 1)")
    step.add_argument(
        "--sync", type=int, metavar="Q", help="channel that the sound card's second track hears (default: the first of the board)"
    )
    how = step.add_mutually_exclusive_group()
    for name, unit in SENSITIVITIES.items():
        option = "--" + name.replace("_", "-")
        how.add_argument(option, type=float, metavar="S", help=f"the sensor's sensitivity: V per {unit.replace('^2', '²')}")
    step.add_argument(
        "--sensor-mass-mg",
        type=float,
        metavar="M",
        help="of what stands on the plate; 0: contactless, as on a simulated panel (default: found from the waves)",
    )
    step.add_argument("--drive", choices=["chirp", "noise"], default="chirp", help="1-bit sequence that is played (default: chirp)")
    step.add_argument("--record-ms", type=float, metavar="MS", help="length of a record (default: an emission and 8 decay times)")
    step.add_argument("--repetitions", type=int, default=4, metavar="N", help="of each emission (default: 4)")
    step.add_argument("--temperature-c", type=float, metavar="C", help="of the plate")
    step.add_argument(
        "--move", metavar="PROGRAM", help="moves the scanning head: called with x and y in mm, ends when the head is still"
    )
    step.add_argument("--yes", action="store_true", help="do not ask before each point")
    step.add_argument(
        "--plate", metavar="B", action="append", default=[], help="on a simulated panel: whose plate is measured, as for simulate"
    )
    step.add_argument("--noise", type=float, default=0.0, metavar="V", help="on a simulated panel: of the sensor, in m/s")
    step.set_defaults(command=measure)


def measure(options: argparse.Namespace) -> int:
    """Measure every point that the folder does not hold yet."""
    from controller.workshop.calibration.recording.excitation import drive_words, period_s, ringing_s
    from controller.workshop.calibration.recording.in_place import Excitation, InPlace, samples_before
    from controller.workshop.calibration.records.measurement_writer import claim, write_measurement, write_records
    from controller.workshop.calibration.records.points import read_points
    from controller.workshop.gateware.actual_panel import actual_panel
    from controller.workshop.gateware.wired_fpgas import open_simulated_panel

    board = board_of(options)
    _check(options, board)
    sync = min(actuator.channel for actuator in board.actuators) if options.sync is None else options.sync
    ring_s = ringing_s(board)
    record_s = board.waveform.duration_s + ring_s if options.record_ms is None else options.record_ms * 1e-3
    names, points_m = read_points(Path(options.points), board)
    words = drive_words(board, options.drive)
    clock: Clock = VirtualClock() if board.link.kind == "simulated" else MonotonicClock()
    simulation = open_simulated_panel(board, clock.now_s) if isinstance(clock, VirtualClock) else None
    recorder = _recorder(options)
    link: Link = simulation or open_link(board, clock.now_s, unhurried=True)
    try:
        sensor = _simulated_sensor(options, board, simulation, clock, sync) if simulation and not recorder else None
        frame = actual_panel(board).frame
        used = recorder or sensor
        if used is None:
            raise UsageError("which sensor? give --alsa NAME or --serial TTY")
        folder, settings = Path(options.folder), _settings(options, board, used, -1e6 * samples_before(used.rate_hz) / used.rate_hz)
        claim(folder, settings)
        write_measurement(folder, settings, names, points_m, words)
        files = [folder / settings.records.files.format(point=name) for name in names]
        missing = [index for index, file in enumerate(files) if not file.exists()]
        session = open_session(link, board, clock.now_s)
        excitation = Excitation(words, options.repetitions, period_s(board, ring_s), record_s)
        played = InPlace(session, board, clock, used, excitation, sync_channel=sync)
        for done, index in enumerate(missing, len(names) - len(missing)):
            if sensor is not None:
                sensor.place_m = frame.place_m(points_m[index])
            _move(options, names[index], done, len(names), *(points_m[index] * 1e3), ask=sensor is None)
            write_records(folder, settings, names[index], _measured(played, names[index]).astype("float32"))
    except KeyboardInterrupt:
        tell(f"the outputs are off; the same command goes on with what {options.folder} lacks")
        raise
    finally:
        if recorder is not None:
            recorder.close()
        link.close()
    figures = {
        "board": board.name,
        "folder": options.folder,
        "points": len(names),
        "measured_now": len(missing),
        "emissions": len(words),
        "repetitions": options.repetitions,
        "rate_hz": used.rate_hz,
        "record_ms": round(record_s * 1e3, 3),
        "seconds_a_point": round(played.period_s * len(words) * options.repetitions, 3),
    }
    show(options, figures, plain_table)
    return 0


def _simulated_sensor(
    options: argparse.Namespace, board: Board, link: SimulatedLink | SimulatedFpgas, clock: Clock, sync: int
) -> SimulatedRecorder:
    """A sensor on the simulated plate that is asked for."""
    from controller.workshop.calibration.recording.simulated_recorder import SimulatedRecorder

    return SimulatedRecorder(_real(options, board), link, clock.now_s, options.rate_khz * 1e3, "m/s", sync, options.noise)


def _measured(played: InPlace, name: str) -> Any:
    """Records of one point, at a second or third try if one fails."""
    for attempt in range(1, TRIES + 1):
        try:
            return played.measure()
        except (CalibrationError, LinkError) as error:
            if attempt == TRIES:
                raise type(error)(f"point {name}: {error}") from error
            tell(f"point {name}: {error}; once more")
    raise AssertionError


def _settings(options: argparse.Namespace, board: Board, recorder: Recorder, first_us: float) -> MeasurementFile:
    """What measurement.toml says."""
    from controller.workshop.calibration.recording.in_place import date_now
    from controller.workshop.calibration.records.measurement_file import MeasurementFile, RecordsTable, WordsDrive

    sensitivity = {name: getattr(options, name) for name in SENSITIVITIES if getattr(options, name) is not None}
    simulated = not (options.alsa or options.serial)
    return MeasurementFile(
        date=date_now(),
        sample_rate_hz=recorder.rate_hz,
        temperature_c=options.temperature_c,
        board_sha256=board.digest().hex(),
        panel=simulated_identity(_real(options, board)) if board.link.kind == "simulated" else panel_identity(),
        points="points.csv",
        records=RecordsTable(
            files="records/{point}.npy",
            unit="V" if sensitivity else "m/s",
            sensor_mass_mg=0.0 if simulated and options.sensor_mass_mg is None else options.sensor_mass_mg,
            repetitions=options.repetitions,
            first_sample_us=0.0 if recorder.triggered else first_us,
            **sensitivity,
        ),
        drive=WordsDrive.of(board),
    )


def _real(options: argparse.Namespace, board: Board) -> Board:
    """What is there of a simulated panel."""
    from controller.workshop.gateware.actual_panel import actual_panel
    from controller.workshop.simulation.other_plate import on_other_plate

    return on_other_plate(actual_panel(board).of(board), options.plate)


def _recorder(options: argparse.Namespace) -> Recorder | None:
    """The sensor that is asked for."""
    from controller.workshop.calibration.recording.recorders import AlsaRecorder, SerialRecorder

    if options.alsa:
        return AlsaRecorder(options.alsa, options.rate_khz * 1e3, options.full_scale)
    return SerialRecorder(options.serial, options.baud) if options.serial else None


def _move(options: argparse.Namespace, name: str, done: int, count: int, x_mm: float, y_mm: float, *, ask: bool) -> None:
    """Have the sensor moved; the outputs are off meanwhile.

    Raises CalibrationError if the program that moves the head fails, or nobody answers.
    """
    where = f"point {name} ({done + 1} of {count}): x = {x_mm:.2f} mm, y = {y_mm:.2f} mm"
    if options.move:
        try:
            run_program([options.move, f"{x_mm:.4f}", f"{y_mm:.4f}"], MOVE_S)  # no second try: nobody knows where the head stands
        except ProgramError as error:
            raise CalibrationError(f"{where}: the head was not moved: {error}") from error
    elif ask and not options.yes:
        tell(f"outputs are off; put the sensor on {where}, and press Enter")
        if not sys.stdin.readline():
            raise CalibrationError(f"{where}: nobody pressed Enter; with --yes nobody is asked")
    else:
        tell(where)


def _check(options: argparse.Namespace, board: Board) -> None:
    """Raise for options that make no sense."""
    simulated = board.link.kind == "simulated"
    if (options.plate or options.noise) and (not simulated or options.alsa or options.serial):
        raise UsageError("--plate and --noise are for the sensor of a simulated panel")
    given = any(getattr(options, name) is not None for name in SENSITIVITIES)
    if (options.alsa or options.serial) and not given:
        raise UsageError("give the sensor's sensitivity: --v-per-m, --v-per-m-s or --v-per-m-s2")
    if given and not (options.alsa or options.serial):
        raise UsageError("a sensitivity is of use with --alsa or --serial")
    ranges = {
        "rate_khz": (2e-3 * board.waveform.band_high_hz, 1e5),
        "full_scale": (1e-9, 1e6),
        "repetitions": (1, 1000),
        "baud": (9600, 12_000_000),
        "noise": (0, 1e3),
        "record_ms": (board.waveform.duration_ms, 1e3),
        "temperature_c": (-50, 150),
        "sensor_mass_mg": (0, 1e4),
    }
    require_within(options, ranges | dict.fromkeys(SENSITIVITIES, (1e-9, 1e12)))
    if options.sync is not None and options.sync not in {actuator.channel for actuator in board.actuators}:
        raise UsageError(f"--sync {options.sync}: board {board.name!r} has no such channel")

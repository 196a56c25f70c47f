"""`haptic-panel gateware waves`: the gateware's signals, for a wave viewer."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from controller.commands.bank import open_bank
from controller.commands.common.named_board import named_board
from controller.commands.common.output import must_be_writable, show
from controller.console import tell
from controller.device.board.board import of_one_fpga, simulated
from controller.device.scene.scene import load_scene
from controller.device.scene.scene_file import find_scene
from controller.device.service.drivers import recording_path
from controller.errors import ConfigError, UsageError

if TYPE_CHECKING:
    from controller.device.fpga.build_parameters import BuildParameters
    from controller.workshop.gateware.input_script import InputRecorder, InputScript


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.epilog = (
        "By default it shows the end of the first emission. The file has the pins and, in the scope `frames`, each frame on the "
        "wires (spi_kind, spi_sequence, spi_argument, and the result in the answer), the last one that was carried out (done_kind, "
        "done_slot, done_result) and the gate's state, by name. Open it with GTKWave or Surfer; neither is needed to write it."
    )
    step.add_argument("--scene", metavar="S", help="as for run: name beside the board's file, or path")
    step.add_argument("--replay", metavar="FILE", help="as for run: recording of a touch panel")
    step.add_argument("--bank", metavar="FILE", help="as for run")
    step.add_argument(
        "--script", metavar="FILE", help="instead: what was done to the pins; a conformance test that fails names its own"
    )
    step.add_argument("--emission", type=int, metavar="N", help="show 4 ms around the end of this emission (default: 1)")
    step.add_argument("--from-ms", type=float, metavar="A", help="or show these ms since reset")
    step.add_argument("--to-ms", type=float, metavar="B")
    step.add_argument("--inside", action="store_true", help="every signal of every module, not the pins alone")
    step.add_argument("--out", metavar="F", default="build/waves.fst", help="file to write (default: build/waves.fst)")
    step.set_defaults(command=gateware_waves)


def gateware_waves(options: argparse.Namespace) -> int:
    """Trace what a scene, a recording or a script does to the compiled Verilog."""
    from controller.workshop.gateware import waves

    _check(options)
    out = Path(options.out)
    must_be_writable(out)
    script = _script(options)
    ticks = _window(options, script)
    per_ms = script.parameters.clock_hz / 1e3
    most, takes_s = waves.most_bytes(ticks, inside=options.inside), waves.seconds(ticks, inside=options.inside)
    shown = f"{ticks.start / per_ms:.3f} to {ticks.stop / per_ms:.3f} ms, {len(ticks):,} ticks"
    if most > waves.TRACED_BYTES_MAX:
        raise ConfigError(
            f"{shown}: up to {most / 1e9:.1f} GB, and {waves.TRACED_BYTES_MAX / 1e9:g} are written at most: show less"
        )
    tell(f"{out}: {shown}, at most {most / 1e3:,.0f} kB; simulating, about {takes_s:.0f} s")
    waves.trace(script, ticks, out, lambda: tell("compiling the gateware with traces, about 20 s"), inside=options.inside)
    view = waves.write_view(out, ticks, 1e9 / per_ms)
    figures = {
        "file": str(out),
        "view": str(view),
        "bytes": out.stat().st_size,
        "from_ms": ticks.start / per_ms,
        "to_ms": ticks.stop / per_ms,
    }
    show(options, figures | {"ticks": len(ticks), "tick_ps": 1e9 / per_ms, "inside": options.inside}, _table)
    return 0


def _check(options: argparse.Namespace) -> None:
    if options.script and (options.scene or options.replay or options.bank):
        raise UsageError("--script has all that is done to the pins: leave out --scene, --replay and --bank")
    given = [value for value in (options.from_ms, options.to_ms) if value is not None]
    if given and options.emission is not None:
        raise UsageError("--emission, or --from-ms and --to-ms")
    if given and (len(given) != 2 or not 0 <= given[0] < given[1] < float("inf")):
        raise UsageError("--from-ms A --to-ms B: both, with 0 <= A < B")


def _script(options: argparse.Namespace) -> InputScript:
    """What is done to the pins: the file's steps, or those of a run against the model, which does the same at the same tick."""
    from controller.workshop.gateware.input_script import InputScript

    if options.script:
        return InputScript.read(Path(options.script))
    from controller.device.touch.recordings.recording import Recording
    from controller.workshop.gateware.input_script import InputRecorder
    from controller.workshop.simulation import simulated_run

    board = simulated(of_one_fpga(named_board(options.board)))
    scene_file = find_scene(board, options.scene)
    scene = load_scene(scene_file, board)
    recording = Recording.open(recording_path(board, options.replay))
    made: list[InputRecorder] = []

    def recorder(parameters: BuildParameters) -> InputRecorder:
        made.append(InputRecorder(parameters))
        return made[0]

    tell(f"playing {recording.name}, {recording.duration_s:.0f} s, with the model")
    with open_bank(options, board, scene, scene_file) as bank:
        simulated_run.play(board, scene, bank, recording, real_time=False, hardware=simulated_run.Hardware(recorder))
    return made[0].script


def _window(options: argparse.Namespace, script: InputScript) -> range:
    """Ticks that are shown."""
    from controller.workshop.gateware.waves import window_of_emission

    if options.from_ms is None:
        return window_of_emission(script, 1 if options.emission is None else options.emission)
    per_ms = script.parameters.clock_hz / 1e3
    ticks = range(round(options.from_ms * per_ms), min(round(options.to_ms * per_ms), script.end_tick))
    if not ticks:
        raise ConfigError(f"--from-ms {options.from_ms:g}: all that is simulated ends at {script.end_tick / per_ms:.3f} ms")
    return ticks


def _table(written: dict[str, Any]) -> str:
    shown = f"{written['from_ms']:.3f} to {written['to_ms']:.3f} ms in {written['ticks']:,} ticks of {written['tick_ps']:g} ps"
    file = written["file"]
    return f"{file}: {written['bytes']:,} bytes, {shown}\nopen it: gtkwave {written['view']}, or surfer {file}"

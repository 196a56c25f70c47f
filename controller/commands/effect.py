"""`haptic-panel effect`: effects from the files of haptic designers, and such files from effects."""

import argparse
from pathlib import Path
from typing import Any

from controller.commands.common.arguments import Declare
from controller.commands.common.named_board import board_of
from controller.console import say, tell
from controller.device.board.devices import MIN_AMPLITUDE
from controller.device.board.validation import nearest
from controller.errors import ConfigError, ControllerError, UsageError


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    command = declare(
        example="haptic-panel effect import click.ahap --out effects.toml",
        description="Effects of a scene from files that haptic designers make, and such files from effects.",
    )
    commands = command.add_subparsers(title="commands", metavar="COMMAND", required=True)
    _add_import(commands, common)
    _add_export(commands, common)


def _add_import(commands: Any, common: argparse.ArgumentParser) -> None:
    importing = commands.add_parser(
        "import",
        parents=[common],
        help="rhythms from designers' files",
        description="Print tables [effects.NAME] for a scene.toml, one for each file (.ahap, .haptic, .hjif, .haps, and vibration "
        "effects of Android, .xml), and report what was kept, left out or changed: a panel plays single pulses, as often as its "
        "board's duty allows, in place of a vibration.",
    )
    importing.add_argument("files", metavar="FILE", nargs="+")
    importing.add_argument("--out", metavar="FILE.toml", help="write the tables there, a new file, instead of on stdout")
    importing.add_argument(
        "--when",
        default="command",
        choices=("command", "press", "enter", "leave"),
        help="occasion of the effects (default: command)",
    )
    importing.add_argument("--low-hz", type=float, default=50.0, metavar="HZ", help="rate of the dullest vibration (default: 50)")
    importing.add_argument(
        "--high-hz", type=float, default=150.0, metavar="HZ", help="rate of the sharpest (default: 150, or what the duty allows)"
    )
    importing.set_defaults(command=import_clips)


def _add_export(commands: Any, common: argparse.ArgumentParser) -> None:
    exporting = commands.add_parser(
        "export",
        parents=[common],
        help="a designer's file from an effect",
        description="Write an effect of the library or of a scene as a file that designers' tools open: each of its pulses is a "
        "transient of .ahap, or an emphasis of .haptic. Effects of places (spacing_mm, always) have no such form.",
    )
    exporting.add_argument("effect", metavar="EFFECT", help="its name")
    exporting.add_argument("--out", metavar="FILE", required=True, help="a new file, .ahap or .haptic")
    exporting.add_argument("--scene", metavar="S", help="name beside the board's file, or path (default: the board's own)")
    exporting.set_defaults(command=export_effect)


def import_clips(options: argparse.Namespace) -> int:
    """Import files."""
    from controller.commands.common.output import show
    from controller.workshop.clips.importing import imported

    board = board_of(options)
    text, figures = imported([Path(file) for file in options.files], board, options.when, options.low_hz, options.high_hz)
    if options.out:
        _write(Path(options.out), text)
    if options.json or options.out:
        show(options, {"out": options.out, "clips": figures} | ({} if options.out else {"toml": text}), _table)
        return 0
    say(text, end="")
    for line in _table({"clips": figures}).splitlines():
        tell(line)
    return 0


def export_effect(options: argparse.Namespace) -> int:
    """Export an effect."""
    from controller.commands.common.output import show
    from controller.device.scene.scene import load_scene
    from controller.device.scene.scene_file import find_scene
    from controller.workshop.clips.exporting import WRITERS, exported

    out = Path(options.out)
    suffix = out.suffix.lower()
    if suffix not in WRITERS:
        raise UsageError(f"--out {out}: {suffix or 'a file without a suffix'} cannot be written; there are: {', '.join(WRITERS)}")
    board = board_of(options)
    scene = find_scene(board, options.scene)
    effects = load_scene(scene, board).effects
    if options.effect not in effects:
        raise ConfigError(
            f"{scene}: no effect {options.effect!r} that is played over time{nearest(options.effect, sorted(effects))}"
        )
    text, figures = exported(options.effect, effects[options.effect], suffix)
    _write(out, text)
    show(options, {"out": options.out} | figures, _exported_line)
    return 0


def _exported_line(figures: dict[str, Any]) -> str:
    silent = f"; {figures['silent']} silent pulses are left out" if figures["silent"] else ""
    return f"{figures['effect']}: {figures['pulses']} pulses, {figures['length_ms']:.0f} ms, in {figures['out']}{silent}"


def _write(file: Path, text: str) -> None:
    try:
        with file.open("x", encoding="utf-8") as out:
            out.write(text)
    except FileExistsError as error:
        raise ConfigError(f"--out {file}: exists already, and is left as it is: give another name") from error
    except OSError as error:
        raise ControllerError(f"--out {file}: cannot be written ({error.strerror})") from error


def _table(figures: dict[str, Any]) -> str:
    lines = []
    for clip in figures["clips"]:
        kept = f"{clip['taps_kept']} of {clip['taps']} taps and {clip['kept']} of {clip['wanted']} pulses of vibrations"
        changed = [
            f"{clip[key]} {said}"
            for key, said in (
                ("silent", "too weak"),
                ("too_close", "too close to another"),
                ("lifted", f"played at {MIN_AMPLITUDE:g}, the least"),
                ("slowed", "at the highest rate in place of a higher one"),
            )
            if clip[key]
        ]
        ignored = [f"ignored: {name} ({count})" for name, count in clip["ignored"].items()]
        lines.append(
            f"{clip['effect']}: {kept}, {clip['length_ms']:.0f} ms" + "".join(f"; {said}" for said in [*changed, *ignored])
        )
    return "\n".join(lines)

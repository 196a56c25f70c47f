"""`haptic-panel board`: check a board and its scene, and describe the keys of both files."""

import argparse
import json
from typing import Any

from controller.commands.board import bom
from controller.commands.common.arguments import Declare
from controller.commands.common.output import show
from controller.console import is_unicode, say
from controller.device.board.board import Board, board_file, load_board
from controller.device.board.lookup import find_board
from controller.device.board.reference import reference, relations_reference, schema
from controller.device.board.relations.checked import RELATIONS, judge
from controller.device.board.touch_panels import touch_records
from controller.device.fpga.play_messages import PlayMessages
from controller.device.fpga.registers import TRIGGER_LATENCY_TICKS
from controller.device.scene.effects.effects import EffectTable
from controller.device.scene.scene_file import find_scene, read_scene
from controller.device.scene.scene_tables import SceneTable
from controller.device.service.installation import is_installed
from controller.device.touch.recordings.recording import Recording
from controller.errors import ConfigError

NAMED = {"effects": EffectTable}  # tables of scene.toml by names of the user's choice


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    board = declare(
        example="haptic-panel board check simulated",
        description="A board is a folder whose board.toml describes a panel: plate, patches, driver stages, touch panel, FPGA and "
        "limits; its scene.toml says what the panel feels like.",
    )
    actions = board.add_subparsers(title="actions", metavar="ACTION", required=True)
    check = actions.add_parser(
        "check",
        parents=[common],
        help="read and check board.toml, its scene, recording and FPGA",
        description="Read and check board.toml, its scene, its recording and its fpga.toml, without any device: every key, and "
        "whether keys go together. Exit code 78 if one is invalid, or if together they are unsafe or cannot work; what is odd is a "
        "warning. `haptic-panel doctor` looks at the devices.",
    )
    check.add_argument("name", nargs="?", metavar="BOARD", help="as for --board")
    check.add_argument("--scene", metavar="S", help="name beside the board's file, or path (default: the board's own)")
    check.set_defaults(command=board_check)
    bom.declare(
        actions.add_parser(
            "bom",
            parents=[common],
            help="bill of materials: what to buy for the panel, with quantities and specifications",
            description="Bill of materials of a panel, from its board.toml and the reference stage (boards/stage): glass, discs, "
            "the parts of all stages, supplies, wires. No prices and few makers: most parts have many sources.",
        )
    )
    describe = actions.add_parser("reference", help="print every key of board.toml and scene.toml, as Markdown")
    describe.set_defaults(command=board_reference)
    schemas = actions.add_parser("schema", help="print the JSON schema of board.toml, for editors")
    schemas.add_argument("--scene", action="store_true", help="of scene.toml instead")
    schemas.set_defaults(command=board_schema)


def board_check(options: argparse.Namespace) -> int:
    """Check a board and its scene, and say what was found.

    Raises ConfigError or TouchError if board, scene or recording is invalid, or the board is refused as a whole.
    """
    folder = find_board(options.name or options.board)
    board = load_board(folder)
    if is_installed("workshop"):  # where bitstreams are built
        from controller.workshop.gateware.fpga_part import FILE, check_top, find_part

        if (folder / FILE).is_file():
            top, part = find_part(folder, None)
            check_top(board, top, part.clocks)
    scene_file = find_scene(board, options.scene)
    scene = read_scene(scene_file, board)
    recording = None
    if board.touch.recording:
        file = board.beside(board.touch.recording)
        if not file.is_file():
            raise ConfigError(f"{folder / 'board.toml'}: touch.recording = {board.touch.recording!r}: there is no file {file}")
        recording = Recording.open(file)
    figures = {
        "board": board.name,
        "file": str(folder / "board.toml"),
        "plate_mm": [board.plate.length_mm, board.plate.width_mm, board.plate.thickness_mm],
        "channels": len(board.actuators),
        "emission_ms": board.waveform.duration_s * 1e3,
        "touch": _tag(board.touch),
        "no_finger_mm": [list(rectangle) for rectangle in board.touch.no_finger_mm],
        "link": board.link.kind,
        "temperature": board.temperature.kind if board.temperature else None,
        "application_socket": board.application_socket.path if board.application_socket else None,
        "scene": str(scene_file),
        "regions": len(scene.regions),
        "effects": sorted(scene.playable),
        "recording": recording.name if recording else None,
        "first_word_ms": _first_word_ms(board),
        "warnings": list(judge(board).odd),
    }
    show(options, figures, _table)
    return 0


def board_reference(_: argparse.Namespace) -> int:
    """Print the reference that is committed as device/board/reference.md."""
    say(reference_text(), end="")
    return 0


def board_schema(options: argparse.Namespace) -> int:
    """Print the JSON schema that is committed as boards/board.schema.json or boards/scene.schema.json."""
    say(schema_text(scene=options.scene, ascii_only=not is_unicode()), end="")
    return 0


def reference_text() -> str:
    """Every key of board.toml and scene.toml, as Markdown."""
    board = reference("board.toml", board_file(touch_records()))
    return "\n".join([board, relations_reference(RELATIONS), reference("scene.toml", SceneTable, NAMED)])


def schema_text(*, scene: bool, ascii_only: bool = False) -> str:
    """JSON schema of board.toml, or of scene.toml."""
    found = schema(SceneTable, NAMED) if scene else schema(board_file(touch_records()))
    return json.dumps(found, indent=1, ensure_ascii=ascii_only) + "\n"


def _first_word_ms(board: Board) -> dict[str, float]:
    """Times from a touch to its first drive word, in ms, but for the host's: touch panel, wire (an upload or a play), trigger."""
    upload_bytes, play_bytes = PlayMessages(memoryview(b""), board).sizes_bytes()
    fpgas = len(board.fpga_boards)  # one after the other
    times_s = {
        "panel": board.touch.lag_s,
        "upload": fpgas * board.link.wire_s(upload_bytes),
        "play": fpgas * board.link.wire_s(play_bytes),
        "trigger": TRIGGER_LATENCY_TICKS / board.link.clock_hz,
    }
    return {part: time_s * 1e3 for part, time_s in times_s.items()}


def _tag(table: Any) -> str:
    return str(table.__struct_config__.tag)


def _table(figures: dict[str, Any]) -> str:
    length_mm, width_mm, thickness_mm = figures["plate_mm"]
    devices = [f"touch panel {figures['touch']}", f"link {figures['link']}"]
    devices += [f"{name.replace('_', ' ')} {figures[name]}" for name in ("temperature", "application_socket") if figures[name]]
    lines = [
        f"{figures['file']}: board {figures['board']!r}, plate {length_mm:g} × {width_mm:g} × {thickness_mm:g} mm,"
        f" {figures['channels']} channels, emissions of {figures['emission_ms']:g} ms",
        f"devices: {', '.join(devices)}",
        f"{figures['scene']}: {figures['regions']} regions, {len(figures['effects'])} effects that a command can play",
    ]
    if figures["no_finger_mm"]:
        lines.append(f"no finger in {len(figures['no_finger_mm'])} rectangles (touch.no_finger_mm)")
    panel, upload, play, trigger = figures["first_word_ms"].values()
    lines.append(
        f"touch to first drive word, but for the host: panel {panel:g} ms, wire {upload * 1e3:,.0f} µs"
        f" ({play * 1e3:.0f} if resident), trigger {trigger * 1e3:.3g} µs"
    )
    if figures["recording"]:
        lines.append(f"recording: {figures['recording']}")
    lines += [f"WARNING: {warning}" for warning in figures["warnings"]]
    count = len(figures["warnings"])
    odd = f", with {count} warning{'s' * (count > 1)}" if count else ""
    return "\n".join([*lines, f"PASS: every key is valid, and they go together{odd}"])

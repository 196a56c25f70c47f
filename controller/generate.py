"""Write every generated file of the checkout: registers and frames in Verilog, references, schemas, completion, manual, diagrams.

    .venv/bin/python -m controller.generate            # write what differs
    .venv/bin/python -m controller.generate --check    # write nothing; exit code 1 if anything differs

All texts are made before the first is written, and a file is written beside the old one and renamed: a slip in a record leaves
every file as it was. What takes minutes is made again only where its source has changed.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Final

from controller.commands.common.arguments import Parser
from controller.console import program, say
from controller.errors import UsageError

ROOT: Final = Path(__file__).parents[1]


def registers(root: Path) -> dict[Path, str]:
    """Registers and frames, in the Verilog and its README."""
    from controller.workshop.gateware.register_table import rewritten

    return rewritten(root / "fpga_rtl")


def board_files(root: Path) -> dict[Path, str]:
    """Reference and JSON schemas of board.toml and scene.toml."""
    from controller.commands.board import reference_text, schema_text

    schemas = {root / f"boards/{name}.schema.json": schema_text(scene=name == "scene") for name in ("board", "scene")}
    return schemas | {root / "controller/device/board/reference.md": reference_text()}


def protocol(root: Path) -> dict[Path, str]:
    """JSON schema of the application socket's messages."""
    from controller.device.application_socket.protocol.schema import protocol_schema_text

    return {root / "controller/device/application_socket/protocol/protocol.schema.json": protocol_schema_text()}


def command_line(root: Path) -> dict[Path, str]:
    """Completion and manual page."""
    from controller.commands.shell.files import shell_files

    return {root / "controller/commands/shell" / name: text for name, text in shell_files().items()}


def timing(root: Path) -> dict[Path, str]:
    """Timing diagrams of the Verilog."""
    from controller.workshop.gateware.timing_diagram import diagrams

    return diagrams(root / "fpga_rtl/timing")


def stage(root: Path) -> dict[Path, str]:
    """Figures and waveforms of the reference power stage."""
    from controller.workshop.benchmark.stage.power_stage import with_figures
    from controller.workshop.benchmark.stage.stage_waveforms import pictures

    folder = root / "boards/stage"
    return pictures(folder) | {folder / "README.md": with_figures((folder / "README.md").read_text(encoding="utf-8"))}


GENERATORS: Final[Mapping[str, Callable[[Path], dict[Path, str]]]] = {
    "registers": registers,
    "board": board_files,
    "protocol": protocol,
    "command-line": command_line,
    "timing": timing,
    "stage": stage,
}


def made(root: Path, names: Sequence[str] = tuple(GENERATORS)) -> dict[Path, str]:
    """The text that each generated file has to have.

    Raises UsageError if a record, or the file that it is written into, has a slip, or a package is missing.
    """
    texts: dict[Path, str] = {}
    for name in names:
        try:
            texts |= GENERATORS[name](root)
        except ModuleNotFoundError as error:
            raise UsageError(f"{name}: {error.name} is missing: sh controller/set_up.sh test") from error
        except (OSError, ValueError) as error:
            raise UsageError(f"{name}: {error}") from error
    return texts


def differing(texts: Mapping[Path, str]) -> dict[Path, str]:
    """Those that are not what their file holds."""
    return {path: text for path, text in texts.items() if not path.exists() or path.read_bytes() != text.encode()}


def replace(path: Path, text: str) -> None:
    """Write a file as a whole, or leave it as it is."""
    beside = path.with_name(f".{path.name}.new")
    beside.write_text(text, encoding="utf-8")
    beside.replace(path)


@program
def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Write, or compare, the files; 1 if `--check` finds a difference."""
    parser = Parser(prog="python -m controller.generate", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--check", action="store_true", help="write nothing; exit code 1 if a file would change")
    parser.add_argument("names", nargs="*", metavar="WHAT", help=f"only these: {', '.join(GENERATORS)} (default: all)")
    options: argparse.Namespace = parser.parse_args(arguments)
    if unknown := set(options.names) - set(GENERATORS):
        parser.error(f"{min(unknown)!r} is not generated; there are {', '.join(GENERATORS)}")
    other = differing(made(root, options.names or tuple(GENERATORS)))
    for path, text in other.items():
        if not options.check:
            replace(path, text)
        say(f"{path}: {'differs from its source' if options.check else 'written'}")
    return int(options.check and bool(other))


if __name__ == "__main__":
    sys.exit(main())

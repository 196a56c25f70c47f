"""`haptic-panel update make-release`: everything that a device of some boards needs, in one folder, ready to be signed."""

from __future__ import annotations

import argparse
import os
import shlex
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from controller.commands.common.output import show
from controller.device.bank.file_format import VERSION as BANK_FORMAT
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import data_folder, find_board
from controller.device.board.paths import user_cache
from controller.device.fpga.bitstreams.bitstream import differences, read_identity
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.registers import PROTOCOL_VERSION
from controller.device.update.manifest import SETTINGS_FORMAT, Manifest, this_platform
from controller.errors import GatewareError, UpdateError, UsageError
from controller.programs import ProgramError, run_program

if TYPE_CHECKING:
    from controller.workshop.publish.lock_file import Target

DISTRIBUTION = "haptic-panel"
GIT_S = 60.0  # for an answer


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.add_argument("out", type=Path, metavar="OUT", help="folder to make")
    step.add_argument("--version", required=True, metavar="V", help="version of the release and all that is in it, such as 1.2.0")
    step.add_argument("--counter", required=True, type=int, metavar="N", help="larger than that of the release before")
    step.add_argument("--board", nargs="+", default=[], metavar="B", help="boards with their scenes: names, or folders")
    step.add_argument("--bank", nargs="+", default=[], type=Path, metavar="FILE", help="banks of these boards")
    step.add_argument(
        "--gateware",
        nargs="+",
        default=[],
        type=Path,
        metavar="FILE",
        help="bitstreams that are not beside their board.toml, by the names that boards load: PANEL.bit of PANEL",
    )
    step.add_argument(
        "--platform", default=this_platform(), metavar="P", help="such as aarch64-cp311 (default: that of this computer and Python)"
    )
    step.add_argument(
        "--wheels", type=Path, metavar="FOLDER", help="take wheels from here, without a network (default: fetch, build)"
    )
    step.add_argument(
        "--mypyc",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="compile the event loop, which halves the host's work, or leave it interpreted (default: compile)",
    )
    step.add_argument(
        "--minimum-counter",
        type=int,
        default=0,
        metavar="N",
        help="counter of the oldest release that it may follow (default: any)",
    )
    step.set_defaults(command=make_release)


def make_release(options: argparse.Namespace) -> int:
    """Make the folder of a release."""
    from controller.workshop.publish.lock_file import Target
    from controller.workshop.publish.release_banks import bank_made_by, bank_pieces, banks_for
    from controller.workshop.publish.release_folder import write_release
    from controller.workshop.publish.sbom import sbom
    from controller.workshop.publish.wheel_version import check_version

    check_version(options.version)
    if options.out.exists():
        raise UpdateError(f"{options.out}: exists: a release is never overwritten, remove it or name another folder")
    target = Target.of(options.platform)
    systemd, verilog = data_folder("systemd"), data_folder("fpga_rtl")
    time_s = _time_s(systemd.parent)
    boards = _boards(options.board)
    contents: dict[str, Path] = {}
    made_by: dict[str, dict[str, str]] = {}
    for name, board in boards.items():
        contents |= {f"boards/{name}/{path}": file for path, file in _files(board.folder)}
    pieces = {}
    for given in options.bank:
        for path, file in banks_for(given, boards):
            if path in pieces:
                raise UsageError(f"{file}: is a second bank for {path}: give one for each board")
            contents[path], pieces[path] = file, bank_pieces(file)
            made_by[path] = bank_made_by(file)
    contents |= _gateware(options.gateware, boards)
    made_by |= {path: _gateware_made_by(file) for path, file in contents.items() if path.startswith("gateware/")}
    with tempfile.TemporaryDirectory() as scratch:
        simulated = any(board.link.kind == "simulated" for board in boards.values())
        own, others = _wheels(options, target, systemd, time_s, Path(scratch), workshop=simulated)
        bill = sbom(options.version, time_s, own, others, contents, made_by)
        about = Manifest(
            version=options.version,
            counter=options.counter,
            python=f"3.{target.minor}",
            architecture=target.architecture,
            protocol=PROTOCOL_VERSION,
            gateware_hash=f"{build_hash(verilog):08x}",
            bank_format=BANK_FORMAT,
            settings_format=SETTINGS_FORMAT,
            boards={name: board.digest().hex() for name, board in boards.items()},
            minimum_counter=options.minimum_counter,
            built_s=time_s,
            files=[],
        )
        wheels = {f"wheels/{wheel.name}": wheel for wheel in (*others, own)}
        manifest = write_release(options.out, about, {**contents, **wheels, "sbom.cdx.json": bill}, pieces)
    figures = {
        "folder": str(options.out),
        "files": len(manifest.files),
        "bytes": manifest.total_bytes,
        "platform": manifest.platform,
    }
    show(options, figures, lambda said: "{folder}: {files} files, {bytes:,} bytes, for {platform}".format(**said))
    return 0


def _wheels(
    options: argparse.Namespace, target: Target, systemd: Path, time_s: int, scratch: Path, *, workshop: bool
) -> tuple[Path, list[Path]]:
    """This project's wheel, with the version of the release, and the others; `workshop`: with that wing."""
    from controller.workshop.publish import lock_file, wheel_folder
    from controller.workshop.publish.wheel_version import with_version

    tools, cache = systemd / "build.lock", user_cache()
    wanted = lock_file.wanted(lock_file.read_lock(systemd / "requirements.lock"), target)
    folder = options.wheels or wheel_folder.fetched(wanted, target, tools, cache)
    others = list(lock_file.choose(wanted, target, folder).values())
    own = lock_file.own_wheel(DISTRIBUTION, target, options.wheels) if options.wheels else None
    project = systemd.parent / "pyproject.toml"
    if own is None:
        if not project.is_file():
            raise UpdateError(f"{project}: is not there: make releases in a checkout, or have {DISTRIBUTION}'s wheel in --wheels")
        wheel_folder.must_be_here(target, DISTRIBUTION)
        own = wheel_folder.built_here(project.parent, time_s, tools, cache, scratch, mypyc=options.mypyc, workshop=workshop)
    wheel_folder.check_wing(own, workshop=workshop)
    (versioned := scratch / "versioned").mkdir()
    return with_version(own, options.version, versioned), others


def _time_s(checkout: Path) -> int:
    """Time of the release, in s since 1970: $SOURCE_DATE_EPOCH, else that of the last commit."""
    reported = os.environ.get("SOURCE_DATE_EPOCH")
    if reported is None:
        command = ["git", "-C", str(checkout), "log", "-1", "--format=%ct"]
        try:
            reported = run_program(command, GIT_S, package="git").out.strip()
        except ProgramError as error:
            raise UpdateError(
                f"{checkout}: no checkout whose last commit gives the release its time ({error}): set SOURCE_DATE_EPOCH"
            ) from error
    if not reported.isdecimal():
        raise UpdateError(f"{checkout}: is no checkout whose last commit gives the release its time: set SOURCE_DATE_EPOCH")
    return int(reported)


def _boards(names: Sequence[str]) -> dict[str, Board]:
    """Boards by the names of their folders, which name their banks too."""
    boards: dict[str, Board] = {}
    for name in names:
        board = load_board(find_board(name))
        if board.key in boards:
            raise UsageError(f"{board.folder}: is the second board called {board.key}: their folders need different names")
        boards[board.key] = board
    return boards


def _files(folder: Path) -> Iterator[tuple[str, Path]]:
    """Files of a board; what begins with a dot is not part of it."""
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder)
        if any(part.startswith(".") for part in name.parts):
            continue
        if path.is_symlink():
            raise UpdateError(f"{path}: is a link: a board of a release has files alone, put a copy there")
        if path.is_file():
            yield str(name), path


def _gateware_made_by(file: Path) -> dict[str, str]:
    """What a bitstream tells of how it was built; nothing if it is none that this project has built."""
    try:
        identity = read_identity(file)
    except GatewareError:
        return {}
    return {"device": identity.device, "sources": identity.sources} | {
        f"tool:{name}": reported for name, reported in identity.tools.items()
    }


def _gateware(files: Sequence[Path], boards: Mapping[str, Board]) -> dict[str, Path]:
    """Bitstreams by the names under which boards load them; each is one that the bring-up of its boards takes.

    One beside a board.toml goes with the files of its board.
    """
    found = {file.name: file for file in files}
    if len(found) < len(files):
        raise UsageError("two bitstreams have the same name: boards know them by their names")
    for name, board in boards.items():
        for number, one in enumerate(board.fpga_boards if board.gateware else ()):
            loaded = Path(one.bitstream).name
            file = found.get(loaded, board.folder / loaded)
            if loaded not in found and not file.is_file():
                of = ["--fpga", str(number)] if number else []
                build = shlex.join(["haptic-panel", "gateware", "build", "--board", board.called, *of])
                raise UpdateError(f"board {name} loads {loaded}: give it with --gateware, or put it beside its board.toml: {build}")
            if complaints := differences(read_identity(file), one, build_hash(data_folder("fpga_rtl"))):
                raise UpdateError(f"{file}: bring-up of board {name} would refuse it: {'; '.join(complaints)}")
    return {f"gateware/{name}": file for name, file in found.items()}

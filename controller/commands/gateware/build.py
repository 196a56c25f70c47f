"""`haptic-panel gateware build`: a board's bitstream."""

from __future__ import annotations

import argparse
import hashlib
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from controller.commands.common.named_board import add_fpga, named_board, with_one_fpga
from controller.commands.common.output import must_be_writable, show
from controller.console import tell
from controller.device.board.lookup import find_board
from controller.device.fpga.bitstreams.bitstream import Figures, figures_path
from controller.errors import GatewareError, UsageError

if TYPE_CHECKING:
    from controller.workshop.gateware.bitstream_build import FpgaDesign, PlacedDesign


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    add_fpga(step)
    step.add_argument("--top", metavar="B", help="board whose top.v and pins are built (default: the board itself)")
    step.add_argument("--device", metavar="D", help="size of the FPGA, such as 85k (default: the first of fpga.toml)")
    which = step.add_mutually_exclusive_group()
    which.add_argument("--seed", type=int, metavar="N", help="of the placement (default: that of fpga.toml)")
    which.add_argument("--seeds", type=int, metavar="N", help="place with each seed from 1 to N, and keep the fastest")
    step.add_argument("--out", metavar="F", help="the bitstream (default: build/BOARD.bit; of a further FPGA BOARD.fpgaN.bit)")
    step.add_argument("--work", metavar="FOLDER", help="keep netlist, placement and reports of the tools there")
    step.add_argument("--unproven", action="store_true", help="do not prove the safety island with these limits before")
    step.set_defaults(command=gateware_build)


def gateware_build(options: argparse.Namespace) -> int:
    """Build a bitstream, and write its figures beside it."""
    from controller.workshop.gateware.bitstream_build import FpgaDesign, pack, synthesise
    from controller.workshop.gateware.fpga_part import check_top, find_part
    from controller.workshop.gateware.island_proof import prove_island

    folder = find_board(options.board)
    board = with_one_fpga(named_board(options.board), options.fpga)
    top, part = find_part(folder, options.top)
    check_top(board, top, part.clocks)
    device = options.device or part.devices[0]
    if device not in part.devices:
        raise UsageError(f"--device: {top.name} is built for {' or '.join(part.devices)}, not for {device!r}")
    seeds = [part.seed if options.seed is None else options.seed] if options.seeds is None else list(range(1, options.seeds + 1))
    if not seeds or min(seeds) < 1:
        raise UsageError("--seed and --seeds: a whole number from 1")
    of = f".fpga{options.fpga}" if options.fpga else ""
    out = Path(options.out or f"build/{board.key}{'' if device == part.devices[0] else f'-{device}'}{of}.bit")
    must_be_writable(out)
    design = FpgaDesign.of(board, top, part, device)
    if not options.unproven:
        tell(f"proving the safety island with the limits of {board.name}")
        prove_island(design.parameters, trace=out.with_suffix(".vcd"))
    with _work_folder(options.work) as work:
        tell(f"synthesising {design.top} with the limits of {board.name}")
        synthesise(design, work)
        fastest, tried = _fastest_placement(design, work, seeds)
        data = pack(design, fastest, work)
    figures = Figures(
        identity=design.identity(fastest.seed),
        sha256=hashlib.sha256(data).hexdigest(),
        bytes=len(data),
        clock_mhz=fastest.clock_mhz,
        fmax_mhz=fastest.fmax_mhz,
        longest_path=fastest.longest_path,
        cells=fastest.cells,
        miso_ns=fastest.miso_ns,
    )
    _write(out, data)
    _write(figures_path(out), msgspec.json.format(msgspec.json.encode(figures, order="sorted")) + b"\n")
    show(options, {"file": str(out), "seeds_mhz": tried} | msgspec.to_builtins(figures), _table)
    return 0


def _fastest_placement(design: FpgaDesign, work: Path, seeds: Sequence[int]) -> tuple[PlacedDesign, dict[str, float | None]]:
    """The fastest of all seeds, and how fast each is; None for one that misses its clock."""
    from controller.workshop.gateware.bitstream_build import place

    fastest: PlacedDesign | None = None
    failed: GatewareError | None = None
    tried: dict[str, float | None] = {}
    for seed in seeds:
        tell(f"placing and routing for {design.device}, seed {seed}; takes minutes")
        try:
            found = place(design, seed, work)
        except GatewareError as error:
            if len(seeds) > 1:
                tell(str(error))
            tried[str(seed)], failed = None, error
            continue
        tried[str(seed)] = found.fmax_mhz
        if len(seeds) > 1:
            tell(f"seed {seed}: {found.fmax_mhz} MHz, {found.longest_path}")
        if fastest is None or found.fmax_mhz > fastest.fmax_mhz:
            fastest = found
    if fastest is None:
        assert failed is not None  # there is a seed
        raise failed
    return fastest, tried


@contextmanager
def _work_folder(wanted: str | None) -> Iterator[Path]:
    """A folder for files between the tools, which stays only if it was asked for."""
    if wanted:
        Path(wanted).mkdir(parents=True, exist_ok=True)
        yield Path(wanted)
    else:
        with tempfile.TemporaryDirectory(prefix="haptic-panel-") as folder:
            yield Path(folder)


def _write(path: Path, data: bytes) -> None:
    """Replace a file as a whole."""
    beside = path.with_name(f".{path.name}.new")
    beside.write_bytes(data)
    beside.replace(path)


def _table(built: dict[str, Any]) -> str:
    used = ", ".join(f"{kind} {used:,} of {there:,}" for kind, (used, there) in built["cells"].items())
    speed = f"{built['fmax_mhz']} MHz of {built['clock_mhz']:g}, seed {built['identity']['seed']}"
    miso = "" if built["miso_ns"] is None else f"; MISO {built['miso_ns']} ns behind the fall of SCK"
    return (
        f"{built['file']}: {built['bytes']:,} bytes, SHA-256 {built['sha256']}\n"
        f"{speed}; longest path: {built['longest_path']}{miso}\n{used}"
    )

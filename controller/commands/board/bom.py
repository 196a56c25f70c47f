"""`haptic-panel board bom`: what to buy for a board, and the circuit of its stages for KiCad."""

import argparse
import csv
import io
from pathlib import Path
from typing import Any

from controller.commands.common.output import show
from controller.console import say, tell
from controller.device.board.board import load_board, of_one_fpga
from controller.device.board.lookup import find_board
from controller.errors import ConfigError

MADE_FROM = "board.toml of {board} and boards/stage of this software; the circuit was simulated, not built"


def declare(bom: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    bom.add_argument("name", nargs="?", metavar="BOARD", help="as for --board")
    bom.add_argument("--csv", action="store_true", help="print comma-separated values, for a spreadsheet")
    bom.add_argument("--netlist", metavar="FILE", help="write the circuit of all stages and their supply switch, for KiCad (.net)")
    bom.set_defaults(command=board_bom)


def board_bom(options: argparse.Namespace) -> int:
    """Print the bill of materials; write the netlist."""
    from controller.workshop.bill.bill import bill, supply_w
    from controller.workshop.bill.circuit import circuit
    from controller.workshop.bill.kicad import kicad_netlist

    board = of_one_fpga(load_board(find_board(options.name or options.board)))
    if options.netlist:
        file = Path(options.netlist)
        try:
            file.write_text(kicad_netlist(circuit(board), MADE_FROM.format(board=board.name)), encoding="utf-8")
        except OSError as error:
            raise ConfigError(f"{file}: cannot be written ({error.strerror})") from error
        tell(f"{file}: in KiCad's board editor, File, Import, Netlist; footprints are those of its own libraries")
    items = [item._asdict() for item in bill(board)]
    figures = {"board": board.name, "items": items, "supply_w": round(supply_w(board), 3)}
    if options.csv and not options.json:
        say(_csv(items), end="")
    else:
        show(options, figures, _table)
    return 0


def _csv(items: list[dict[str, Any]]) -> str:
    text = io.StringIO()
    table = csv.DictWriter(text, list(items[0]), lineterminator="\n")
    table.writeheader()
    table.writerows(items)
    return text.getvalue()


def _table(figures: dict[str, Any]) -> str:
    lines, group = list[str](), ""
    for item in figures["items"]:
        if item["group"] != group:
            group = item["group"]
            lines += ["", group] if lines else [group]
        amount = f"{item['quantity']:g}" + {"pieces": "", "mm3": " mm³"}.get(item["unit"], f" {item['unit']}")
        references = f" [{item['references']}]" if item["references"] else ""
        lines.append(f"{amount:>9}  {item['item']:<24}{item['specification']}{references}")
    return "\n".join(lines)

"""`haptic-panel calibrate fleet`: the banks of many panels, from a folder of their measurements."""

import argparse
from pathlib import Path
from typing import Any

from controller.commands.calibrate.bank import bank_options, declare_bank
from controller.commands.common.named_board import board_of
from controller.commands.common.output import show
from controller.commands.common.worker_options import add_worker_options, workers_of
from controller.console import tell


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.add_argument("folder", type=Path, metavar="DIR", help="with a folder for each panel, in which is a measurement.toml")
    step.add_argument(
        "--out", type=Path, required=True, metavar="BANKS", help="folder for NAME.bank of each panel, and report.json"
    )
    declare_bank(step)
    add_worker_options(step)
    step.set_defaults(command=calibrate_fleet)


def calibrate_fleet(options: argparse.Namespace) -> int:
    """Build all banks; 1 if a panel was refused."""
    from controller.workshop.calibration.banks import fleet
    from controller.workshop.calibration.banks.plate_bank import PlateBank

    common = PlateBank(board_of(options), options.folder, **bank_options(options))
    try:
        report = fleet.calibrate_fleet(options.folder, options.out, common, workers_of(options))
    except KeyboardInterrupt:
        tell("what is done is kept: the same command goes on from there")
        raise
    show(options, report, _table)
    return 1 if report["broken"] else 0


def _table(report: dict[str, Any]) -> str:
    lines = [f"{'panel':<24}{'points':>7}{'kept':>8}{'least':>8}{'frequency':>11}{'cells':>8}{'notes':>7}"]
    for name, panel in report["panels"].items():
        left = panel["left_out_kept"]
        lines.append(
            f"{name:<24}{panel['points']:>7}{left['median']:>8.4f}{left['least']:>8.3f}{panel['frequency_scale'][0]:>11.5f}"
            f"{panel['cells']:>8,}{len(panel['notes']):>7}"
        )
    for name, spread in report["spread"].items():
        lines.append(f"{name.replace('_', ' ')}: {spread['least']:g} to {spread['largest']:g}, median {spread['median']:g}")
    lines += [f"BROKEN {name}: {why}" for name, why in report["broken"].items()]
    kept = report["workers"]["kept"]
    lines.append(f"{len(report['panels'])} banks, {kept} of them from before; {len(report['broken'])} broken")
    return "\n".join(lines)

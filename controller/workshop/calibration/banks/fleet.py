"""Banks of a whole fleet: a folder of panels' measurements becomes one of banks, each checked, and one report.

A panel is done when its bank is there as it was written; the same call computes what is missing, changed, or was refused.
"""

import errno
import hashlib
import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from controller.device.bank.file_format import creator
from controller.device.bank.inspection import verify_bank
from controller.durable import write_durably
from controller.errors import ControllerError, UsageError, WorkersError
from controller.workshop.calibration.banks.plate_bank import PlateBank, build, fit
from controller.workshop.calibration.records.measurement_file import NAME
from controller.workshop.workers.map_kept import map_kept
from controller.workshop.workers.workers import ALONE, Workers

KEPT: Final = ".calibrated"  # file in the folder of banks: what is done
REPORT: Final = "report.json"


@dataclass(frozen=True)
class Panel:
    """A panel of a fleet, and the bank that is wanted of it."""

    name: str
    wanted: PlateBank


def calibrate_fleet(folder: Path, out: Path, common: PlateBank, workers: Workers = ALONE) -> dict[str, Any]:
    """Build the bank of each panel, `out`/NAME.bank, and the report beside them, which is returned.

    A panel is a folder in `folder` that has a measurement.toml; `common` is what all banks have in common. Panels that are refused
    are in the report, a line each. Raises UsageError if there is no panel, or banks would lie among measurements; WorkersError,
    also if the disk is full.
    """
    panels = _panels(folder, out, common)
    items = {_number(panel): panel for panel in panels}
    found = map_kept(calibrate_panels, items, out / KEPT, workers, what=folder.name, unit="panel", still_holds=_still_holds)
    results = {panel.name: json.loads(found.results[number]) for number, panel in items.items()}
    for panel in panels:  # of a worker on another computer; one that was thought lost may have written the same once more since
        if "broken" not in (result := results[panel.name]) and not Path(result["path"]).is_file():
            results[panel.name] = {"broken": f"{result['path']}: is not on this computer: let all workers mount the folder"}
    done = {name: result for name, result in results.items() if "broken" not in result}
    report = {
        "board": common.board.name,
        "panels": done,
        "broken": {name: result["broken"] for name, result in results.items() if "broken" in result},
        "spread": _spread(list(done.values())),
        "workers": found.figures(),
    }
    text = json.dumps({name: value for name, value in report.items() if name != "workers"}, indent=1)
    write_durably(out / REPORT, text.encode() + b"\n")
    return report


def calibrate_panels(panels: Sequence[Panel]) -> list[bytes]:
    """The bank of each panel, checked: its figures as JSON, or why there is none."""
    return [json.dumps(_calibrated(panel)).encode() for panel in panels]


def _calibrated(panel: Panel) -> dict[str, Any]:
    try:
        fitted = fit(panel.wanted)
        built = build(panel.wanted, fitted, progress=False)
        verify_bank(built.path)
        state = built.path.stat()
    except (ControllerError, OSError) as error:
        said = " ".join(str(error).split())
        if _is_full_disk(error):
            raise WorkersError(f"{said}: make room; what was done is kept: the same command goes on there") from error
        return {"broken": said}
    report = {"path": str(built.path), "cells": built.report.cells, "bytes": state.st_size, "written_ns": state.st_mtime_ns}
    if optimised := built.report.optimised:
        report["optimised"] = optimised
    return report | fitted.figures | {"notes": built.notes}


def _is_full_disk(error: BaseException | None) -> bool:
    """Whether that is the cause: no matter of one panel, whatever is computed for the others would be lost too."""
    if isinstance(error, OSError):
        return error.errno in {errno.ENOSPC, errno.EDQUOT}
    return error is not None and _is_full_disk(error.__cause__)


def _panels(folder: Path, out: Path, common: PlateBank) -> list[Panel]:
    try:
        names = sorted(path.name for path in folder.iterdir() if (path / NAME).is_file())
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"{error.filename}: {error.strerror}: give a folder of measurement folders, and one for banks") from error
    if not names:
        raise UsageError(f"{folder}: no folder in it has a {NAME}: give the folder that has one folder for each panel")
    if out.resolve().is_relative_to(folder.resolve()) and (out / NAME).exists():
        raise UsageError(f"--out {out}: is a panel's measurement: give another folder")
    return [Panel(name, replace(common, folder=folder / name, out=(out / f"{name}.bank").resolve())) for name in names]


def _number(panel: Panel) -> int:
    """A number of what determines a panel's bank: board, options, version, and name, size and time of the measurement's files."""
    parts = [creator(), panel.name, repr(panel.wanted)]
    for root, _, names in sorted(os.walk(panel.wanted.folder)):
        for name in sorted(names):
            file = Path(root, name)
            parts.append(f"{file.relative_to(panel.wanted.folder)} {_state(file)}")
    return int.from_bytes(hashlib.sha256("\0".join(parts).encode()).digest()[:8], "little")


def _state(file: Path) -> str:
    """Size and time of a file; why there are none, of a link that leads nowhere or what is gone meanwhile."""
    try:
        state = file.stat()
    except OSError as error:
        return str(error.errno)
    return f"{state.st_size} {state.st_mtime_ns}"


def _still_holds(result: bytes) -> bool:
    """Whether a kept result is a bank that is there; what was refused is tried again."""
    kept = json.loads(result)
    return "broken" not in kept and _is_there(kept)


def _is_there(result: Mapping[str, Any]) -> bool:
    try:
        state = Path(result["path"]).stat()
    except OSError:
        return False
    return (state.st_size, state.st_mtime_ns) == (result["bytes"], result["written_ns"])


def _spread(done: Sequence[Mapping[str, Any]]) -> dict[str, dict[str, float]]:
    """Least, median and largest of what tells panels apart."""
    values = {
        "left_out_kept": [result["left_out_kept"]["median"] for result in done],
        "frequency_scale": [result["frequency_scale"][0] for result in done],
    }
    names = ("least", "median", "largest")
    return {
        name: dict(zip(names, np.quantile(some, (0.0, 0.5, 1.0)).round(5).tolist(), strict=True))
        for name, some in values.items()
        if some
    }

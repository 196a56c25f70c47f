"""Solved plates in the user's cache, by the hash of what they were computed from and of the code that computed them.

A file that cannot be read, whatever the reason, is computed again; one that cannot be written is not.
"""

import hashlib
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from controller.device.board.paths import state_folder
from controller.workshop.physics.modes import mode_count, one_dimensional_basis, ritz
from controller.workshop.physics.modes.ritz import ModeClass, PlateShape, PlateSolution

KEPT_FILES = 12  # of 30 to 90 MB for the paper's plate; the one not used for longest goes first
WORTH_KEEPING = 1_000_000  # coefficients: a solution with fewer is computed in a fifth of a second


def solved(plate: PlateShape, highest_k: float) -> PlateSolution:
    """All modes up to a wavenumber, from the cache if they are there; parameters and errors as of `ritz.solve`."""
    path = state_folder() / "modes" / f"{_key(plate, highest_k)}.npz"
    found = _read(path, plate, highest_k)
    if found is None:
        found = ritz.solve(plate, highest_k)
        if sum(modes.coefficients.size for modes in found.classes) >= WORTH_KEEPING:
            with suppress(OSError):
                _write(path, found)
    return found


def _key(plate: PlateShape, highest_k: float) -> str:
    digest = hashlib.sha256(repr((plate, highest_k)).encode())
    for module in (ritz, one_dimensional_basis, mode_count):
        digest.update(Path(str(module.__file__)).read_bytes())
    return digest.hexdigest()


def _read(path: Path, plate: PlateShape, highest_k: float) -> PlateSolution | None:
    try:
        with path.open("rb") as raw, np.load(raw, allow_pickle=False) as file:  # checks the CRC of each array
            count = int(file["classes"])
            parts = [{name: file[f"{name}{number}"] for name in ("x", "y", "k4", "shapes", "foam")} for number in range(count)]
            condition = float(file["condition"])
        path.touch()
    except Exception:  # what archives of arrays raise for damaged bytes is no fixed set
        return None
    pairs = ritz.bases(plate, highest_k, [(part["x"], part["y"]) for part in parts])
    classes = (ModeClass(x, y, part["k4"], part["shapes"], part["foam"]) for (x, y), part in zip(pairs, parts, strict=True))
    return PlateSolution(tuple(classes), condition)


def _write(path: Path, solution: PlateSolution) -> None:
    arrays: dict[str, Any] = {"classes": np.array(len(solution.classes)), "condition": np.array(solution.condition)}
    for number, modes in enumerate(solution.classes):
        values = (modes.x.coefficients, modes.y.coefficients, modes.wavenumber4, modes.coefficients, modes.foam_share)
        arrays |= {f"{name}{number}": value for name, value in zip(("x", "y", "k4", "shapes", "foam"), values, strict=True)}
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile(prefix=".modes-", dir=path.parent, delete=False) as file:
        temporary = Path(file.name)
        try:
            np.savez(file, allow_pickle=False, **arrays)
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
    by_age = sorted(path.parent.glob("*.npz"), key=lambda old: old.stat().st_mtime, reverse=True)
    for old in by_age[KEPT_FILES:]:
        old.unlink(missing_ok=True)

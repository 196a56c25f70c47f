"""Results of points on disk, by the hash of what they follow from: an interrupted calibration goes on where it was."""

import hashlib
import os
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from controller.device.board.board import Board
from controller.device.board.paths import state_folder
from controller.errors import ConfigError
from controller.workshop.calibration.transfer_functions.transfers import Transfers

FORMAT = "1"  # of the files, and of the method


def calibration_cache(board: Board, folder: Path) -> Path:
    """Folder for results of a measurement's points."""
    try:
        name = hashlib.sha256(str(folder.resolve()).encode()).hexdigest()[:16]
    except (OSError, RuntimeError) as error:
        raise ConfigError(f"{folder}: {error}") from error
    return state_folder(board) / "calibration" / name


class PointCache:
    """Transfer functions of points in a folder. A file that is damaged counts as absent; one that cannot be written is left out.

    Without a folder nothing is kept; `common` is what all points depend on: hashes of common files, the clock.
    """

    def __init__(self, folder: Path | None, common: Iterable[str]) -> None:
        self._folder = folder
        self._common = "\n".join((FORMAT, *common))
        self._used: set[str] = set()

    def find(self, point: str, hashes: Iterable[str]) -> Transfers | None:
        """Result of a point whose files have these hashes."""
        if self._folder is None:
            return None
        file = self._folder / self._name(point, hashes)
        try:
            with np.load(file, allow_pickle=False) as arrays:
                transfer, resolved, reported = arrays["transfer"], arrays["resolved"], arrays["reported"]
        except Exception:  # numpy and zipfile raise anything on damaged files
            return None
        variance, coherence = reported[0], reported[1]
        residual, clipped = reported[2, :2].tolist()
        return Transfers(transfer, resolved, variance, coherence, residual, int(clipped))

    def keep(self, point: str, hashes: Iterable[str], found: Transfers) -> None:
        """Keep a result."""
        if self._folder is None:
            return
        file = self._folder / self._name(point, hashes)
        reported = np.stack([found.variance, found.coherence, np.zeros_like(found.variance)])
        reported[2, :2] = found.residual, found.clipped
        part = file.with_suffix(f".{os.getpid()}.part")
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            with part.open("wb") as data:
                np.savez(data, transfer=found.transfer, resolved=found.resolved, reported=reported)
            part.replace(file)
        except OSError:
            part.unlink(missing_ok=True)

    def forget_others(self) -> None:
        """Remove results that were neither found nor kept: of files that have changed since."""
        for file in () if self._folder is None or not self._folder.is_dir() else self._folder.glob("*.npz"):
            if file.name not in self._used:
                file.unlink(missing_ok=True)

    def _name(self, point: str, hashes: Iterable[str]) -> str:
        name = hashlib.sha256("\n".join((self._common, point, *hashes)).encode()).hexdigest() + ".npz"
        self._used.add(name)
        return name

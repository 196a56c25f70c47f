"""What commands print: figures as a table or as JSON, progress, the picture asked for."""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    Subparsers = argparse._SubParsersAction[argparse.ArgumentParser]  # the type has no public name


def show(options: argparse.Namespace, figures: dict[str, Any], table: Callable[[dict[str, Any]], str]) -> None:
    """Print figures on stdout: one JSON object with --json, else a table."""
    print(json.dumps(figures, allow_nan=False) if options.json else table(figures))


def progress_bar(what: str) -> Callable[[int, int], None]:
    """A progress bar on stderr for work over 2 s, told of what is done and the total; silent when stderr is no terminal.

    The package for it belongs to the offline tools, which a device may lack: without it there is none.
    """
    try:
        from tqdm import tqdm
    except ModuleNotFoundError:
        return lambda _done, _total: None

    bar = tqdm(desc=what, disable=None, delay=2, leave=False)

    def progress(done: int, total: int) -> None:
        bar.total = total
        bar.update(done - bar.n)
        if done >= total:
            bar.close()

    return progress


def picture_path(options: argparse.Namespace) -> Path | None:
    """File asked for with --plot, refused before any work if it could not be written."""
    if not options.plot:
        return None
    from controller.physics.plot import check_picture

    check_picture(Path(options.plot))
    return Path(options.plot)

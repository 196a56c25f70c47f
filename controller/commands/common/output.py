"""Output of commands: figures as a table or as JSON, progress bars, and the file of --plot."""

import argparse
import json
import os
import shutil
import sys
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import Any

from controller.console import say
from controller.errors import ConfigError

NARROWEST = 40  # characters of a terminal that lines are broken for


def show(options: argparse.Namespace, figures: dict[str, Any], table: Callable[[dict[str, Any]], str]) -> None:
    """Print figures on stdout: one JSON object with --json, else a table, no wider than the terminal."""
    say(json.dumps(figures, allow_nan=False) if options.json else fitted(table(figures)))


def fitted(text: str) -> str:
    """The lines of a text, each broken where it is wider than the terminal; where stdout is none, as they are."""
    if not sys.stdout or not sys.stdout.isatty():
        return text
    wrap = textwrap.TextWrapper(
        max(shutil.get_terminal_size().columns, NARROWEST),
        expand_tabs=False,
        replace_whitespace=False,
        break_on_hyphens=False,
        subsequent_indent="  ",
    )
    return "\n".join("\n".join(wrap.wrap(line)) for line in text.splitlines())


def progress_bar(what: str) -> Callable[[int, int], None]:
    """A function to call with the amount done and the total: a bar on stderr for work that takes more than 2 s.

    It does nothing if stderr is not a terminal, or without tqdm.
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


def must_be_writable(out: Path) -> None:
    """Refuse, before minutes of work, a file of --out that cannot be written after it."""
    out.parent.mkdir(parents=True, exist_ok=True)
    if out.is_dir() or not os.access(out.parent, os.W_OK):
        raise ConfigError(f"{out}: cannot be written; give another file with --out")


def picture_path(options: argparse.Namespace) -> Path | None:
    """File given with --plot; checked before any work, so that it can be written later."""
    if options.plot is None:
        return None
    from controller.workshop.physics.pictures.plot import check_picture

    check_picture(Path(options.plot))
    return Path(options.plot)

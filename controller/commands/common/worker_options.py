"""Options of commands whose work many processes or machines can share."""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING

from controller.commands.common.arguments import require_within
from controller.errors import UsageError

if TYPE_CHECKING:
    from controller.workshop.workers.workers import Workers

UNLESS_OPTIMISED = "; without --optimise this process"
RANGES = {"workers": (1, 256), "worker_memory_mb": (200, 1e6)}  # Python, NumPy and this package alone take 100 MB


def add_worker_options(command: argparse.ArgumentParser, but: str = "") -> None:
    """Declare them; `but` says where the default is another."""
    group = command.add_argument_group(f"who computes (default: a process for each core{but})")
    group.add_argument("--workers", type=int, metavar="N", help="processes of this computer; 1: this process itself")
    group.add_argument("--dask", metavar="ADDRESS", help="workers of this dask scheduler, tcp://HOST:PORT or tls://HOST:PORT")
    group.add_argument(
        "--scheduler-file",
        type=Path,
        metavar="FILE",
        help="workers of the scheduler that wrote this file (dask scheduler --scheduler-file)",
    )
    group.add_argument(
        "--worker-memory-mb", type=float, metavar="M", help="memory that each of --workers may take; one that takes more is ended"
    )


def workers_of_bank(options: argparse.Namespace) -> Workers:
    """As `workers_of`; where none is asked for and nothing is optimised, this process (`UNLESS_OPTIMISED`)."""
    from controller.workshop.workers.workers import ALONE

    given = (options.optimise, options.workers, options.dask, options.scheduler_file, options.worker_memory_mb)
    return ALONE if given == (None,) * len(given) else workers_of(options)


def workers_of(options: argparse.Namespace) -> Workers:
    """Who is to compute; raises UsageError if options contradict each other."""
    from controller.workshop.workers.workers import Workers

    given = [name for name in ("workers", "dask", "scheduler_file") if getattr(options, name) is not None]
    if len(given) > 1:
        raise UsageError(f"{' and '.join('--' + name.replace('_', '-') for name in given)}: give one of them")
    require_within(options, RANGES)
    if options.worker_memory_mb is not None and given not in ([], ["workers"]):
        raise UsageError("--worker-memory-mb: for processes of this computer (elsewhere: dask worker --memory-limit)")
    return Workers(options.workers or len(os.sched_getaffinity(0)), options.dask, options.scheduler_file, options.worker_memory_mb)

"""What a benchmark ran on: processor, linear algebra, versions, commit."""

import os
import platform
from pathlib import Path
from typing import Any

import numpy as np
import scipy
from threadpoolctl import threadpool_info

from controller import __version__
from controller.device import kernel
from controller.programs import ProgramError, run_program


def environment() -> dict[str, Any]:
    """Describe this machine and this program, in plain values."""
    blas = [
        f"{pool.get('internal_api')} {pool.get('version')} {pool.get('architecture', '')}".strip()
        for pool in threadpool_info()
        if pool.get("user_api") == "blas"
    ]
    return {
        "processor": _processor(),
        "machine": platform.machine(),
        "cores": os.cpu_count(),
        "load_average": os.getloadavg()[0],
        "system": platform.platform(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "scipy": scipy.__version__,
        "blas": sorted(set(blas)),
        "blas_threads": 1,
        "kernel": "compiled" if kernel.COMPILED else "NumPy",
        "haptic_panel": __version__,
        "commit": _commit(),
    }


def _processor() -> str:
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return platform.processor()
    for key in ("model name", "Model"):  # Model: the computer, on ARM
        for line in text.splitlines():
            name, _, value = line.partition(":")
            if name.strip() == key:
                return value.strip()
    return platform.processor()


def _commit() -> str | None:
    """Commit of the checkout this runs from, with a plus sign if tracked files differ from it; None elsewhere."""
    root = Path(__file__).parents[3]
    if not (root / ".git").exists():
        return None
    try:
        reported = [
            run_program(["git", "-C", root, *words], 10.0).out.strip()
            for words in (["rev-parse", "--short=12", "HEAD"], ["status", "--porcelain", "--untracked-files=no"])
        ]
    except ProgramError:
        return None
    return reported[0] + "+" * bool(reported[1])

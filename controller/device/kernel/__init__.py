"""Inner loops of the device on buffers that the caller owns: points to drive words, waveforms to frames.

They are compiled where the package was built with a C compiler, else `twin` and `words_twin` serve, with the same integers.
`HAPTIC_PANEL_KERNEL=numpy` or `=compiled` in the environment chooses one; a compiled one that is missing is then an error.
`=narrow` is the compiled one with vectors of 128 bits, also on processors that have AVX2.
"""

from __future__ import annotations

import contextlib
import importlib
import os
from pathlib import Path
from types import ModuleType

from controller.device.kernel.bank_twin import (
    GROUP_SAMPLES,
    LARGEST_EQUALISER,
    MAX_BLOCK_SAMPLES,
    MAX_FOCI,
    MAX_SAMPLES,
    PLAN,
    REST_SAMPLES,
    BankBuffers,
    Point,
    room_bytes,
)
from controller.device.kernel.null_twin import MAX_NULLS, null_places
from controller.device.kernel.twin import (
    SHORT_FRAME_BYTES,
    load_frames_bytes,
    pack_loads,
    renumber_loads,
    seal_short_frames,
    start_program,
    statuses_good,
    unpack_loads,
)
from controller.device.kernel.words_twin import compose
from controller.errors import UsageError

__all__ = [
    "COMPILED",
    "GROUP_SAMPLES",
    "LARGEST_EQUALISER",
    "MAX_BLOCK_SAMPLES",
    "MAX_FOCI",
    "MAX_NULLS",
    "MAX_SAMPLES",
    "PLAN",
    "REST_SAMPLES",
    "SHORT_FRAME_BYTES",
    "BankBuffers",
    "Point",
    "compose",
    "load_frames_bytes",
    "null_places",
    "pack_loads",
    "renumber_loads",
    "room_bytes",
    "seal_short_frames",
    "start_program",
    "statuses_good",
    "unpack_loads",
]

_SOURCE = Path(__file__).with_name("kernel.c")  # there in a checkout only


def _compiled(wanted: str) -> ModuleType | None:
    """The compiled kernel that is used, as wide as the processor has vectors; in a checkout it is not older than its source."""
    if wanted not in ("", "compiled", "narrow", "numpy"):
        raise UsageError(f"HAPTIC_PANEL_KERNEL={wanted}: compiled, narrow, numpy, or unset for what is there")
    if wanted == "numpy":
        return None
    try:
        compiled = importlib.import_module("controller.device.kernel._kernel")
    except ImportError as error:
        if wanted:
            raise UsageError(f"HAPTIC_PANEL_KERNEL={wanted}, but the package was built without a C compiler: {error}") from error
        return None
    if getattr(compiled, "HAS_AVX2", False) and wanted != "narrow":  # one older than its source may not say
        with contextlib.suppress(ImportError):  # a checkout that was built in part: the narrow one serves
            compiled = importlib.import_module("controller.device.kernel._kernel_avx2")
    file = compiled.__file__
    if file and _SOURCE.exists() and _SOURCE.stat().st_mtime > Path(file).stat().st_mtime:
        if wanted:
            raise UsageError(f"{file} is older than kernel.c: pip install -e . again")
        return None
    return compiled


_KERNEL = _compiled(os.environ.get("HAPTIC_PANEL_KERNEL", ""))
COMPILED = _KERNEL is not None

if _KERNEL:  # what kernel.c has takes the place of the twin's, whose types it has
    globals().update({name: made for name, made in vars(_KERNEL).items() if name in __all__})

"""python-evdev without asyncio, whose import would take longer than all others of a driver and serve nothing here.

The library falls back to its plain reader (`evdev.eventio`) where the one for asyncio (`evdev.eventio_async`) cannot be imported.
"""

from __future__ import annotations

import contextlib
import sys

ASYNC_READER = "evdev.eventio_async"

sys.modules.setdefault(ASYNC_READER, None)  # type: ignore[arg-type] # None: its import is an ImportError
with contextlib.suppress(ImportError):
    import evdev
if sys.modules[ASYNC_READER] is None:
    del sys.modules[ASYNC_READER]  # whoever else wants it may import it
import evdev  # noqa: E402 - for a version that has no plain reader; where the library is missing, the error says so

__all__ = ["evdev"]

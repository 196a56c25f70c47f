"""What the library of WebSockets reports."""

from __future__ import annotations

import logging

from controller.log import Priority, log


def library_log() -> logging.Logger:
    """What the library reports, as lines of our log without tracebacks; its mere events are left out."""
    logger = logging.getLogger("haptic-panel.page")
    if not logger.handlers:
        handler = logging.Handler(logging.ERROR)
        handler.emit = _to_log  # type: ignore[method-assign]
        logger.addHandler(handler)
        logger.propagate = False
    return logger


def _to_log(record: logging.LogRecord) -> None:
    error = record.exc_info[1] if record.exc_info else None
    log(f"{record.getMessage()}{f': {type(error).__name__}: {error}' if error else ''}", Priority.ERROR)

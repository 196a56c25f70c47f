"""How the screen's pixels lie on the plate: as the settings say, else as a page with four taps has found, kept over restarts."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

import msgspec

from controller.device.page.settings import PageSettings, Row
from controller.durable import write_durably
from controller.log import Priority, log
from controller.regular_file import read_regular

BYTES_MAX: Final = 4096
PIXEL_MM: Final = 0.01, 5.0  # from pixel to pixel; a telephone has 0.05 mm, a television 1 mm
FURTHEST_MM: Final = 10_000.0


class ScreenPlace(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Lengths in mm from device pixels, from the screen's upper left corner: x_mm = a x + b y + c, and so y_mm."""

    x_mm_from_pixels: Row
    y_mm_from_pixels: Row

    def wrong(self) -> str:
        """What cannot be; empty: nothing."""
        (a, b, c), (d, e, f) = self.x_mm_from_pixels, self.y_mm_from_pixels
        if not all(map(math.isfinite, (a, b, c, d, e, f))):
            return "must be finite numbers"
        if max(abs(c), abs(f)) > FURTHEST_MM:
            return f"the screen's corner would be more than {FURTHEST_MM:g} mm off the plate's"
        least, most = PIXEL_MM
        for axis, (along_x, along_y) in (("x", (a, d)), ("y", (b, e))):
            if not least <= (pixel_mm := math.hypot(along_x, along_y)) <= most:
                return f"pixels would be {pixel_mm:.4g} mm apart along the screen's {axis}: must be {least:g} to {most:g}"
        if abs(a * e - b * d) < 0.5 * math.hypot(a, d) * math.hypot(b, e):
            return "the screen's axes would be less than 30 degrees apart"
        return ""


class Screen:
    """The place in force, kept in a file whose folder is made when it has to be."""

    def __init__(self, settings: PageSettings, file: Path) -> None:
        self._file = file
        self._watchers: set[Callable[[], None]] = set()
        self.given = settings.x_mm_from_pixels is not None
        self.place = _kept(file)  # None: nobody has said
        if settings.x_mm_from_pixels is not None and settings.y_mm_from_pixels is not None:
            self.place = ScreenPlace(settings.x_mm_from_pixels, settings.y_mm_from_pixels)

    def watch(self, changed: Callable[[], None]) -> Callable[[], None]:
        """Have a page's connection called at each change; call what is returned when it ends."""
        self._watchers.add(changed)
        return lambda: self._watchers.discard(changed)

    def keep(self, message: dict[str, Any]) -> str:
        """Take over what a page has found; why not, or empty."""
        if self.given:
            return "the bridge's settings say where the screen lies: leave out x_mm_from_pixels and y_mm_from_pixels there"
        try:
            place = msgspec.convert({key: value for key, value in message.items() if key not in ("kind", "id")}, ScreenPlace)
        except msgspec.ValidationError as error:
            return str(error)
        if wrong := place.wrong():
            return wrong
        try:
            self._file.parent.mkdir(parents=True, exist_ok=True)
            write_durably(self._file, msgspec.json.encode(place))
        except OSError as error:
            return f"{self._file}: cannot be written ({error.strerror})"
        self.place = place
        for changed in tuple(self._watchers):
            changed()
        return ""


def _kept(file: Path) -> ScreenPlace | None:
    """What was kept; a file that is damaged counts as none, and is reported."""
    try:
        place = msgspec.json.decode(read_regular(file, BYTES_MAX), type=ScreenPlace)
    except FileNotFoundError:
        return None
    except (OSError, ValueError) as error:
        log(f"{file}: left out: {error}", Priority.WARNING)
        return None
    if wrong := place.wrong():
        log(f"{file}: left out: {wrong}", Priority.WARNING)
        return None
    return place

"""What the builder of a panel is asked: glass, how it is held, discs, touch panel and FPGA board."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Annotated, Any, Final, Literal

import msgspec
from msgspec import Meta

from controller.device.board.plate.parts import Parts
from controller.device.board.plate.plate import Plate
from controller.device.board.records import Record, read_tables
from controller.device.board.touch_panels import touch_record

GLASSES: Final = Path(__file__).with_name("glasses.toml")
AXES: Final = ("x_mm_from_axes", "y_mm_from_axes")
HELD: Final[dict[str, dict[str, Any]]] = {  # keys of [plate], by how the glass is held
    "foam": {"edges": "foam", "foam": {"stiffness_n_m3": 1e9, "width_mm": 9.0}},
    "free": {"edges": "free"},
    "simply_supported": {"edges": "simply_supported"},
    "clamped": {"edges": "clamped"},
}

ExtentMm = Annotated[float, Meta(ge=20, le=4000)]


class SetupAnswers(Record, frozen=True, kw_only=True):
    """Answers of the builder; those with a default need not be given.

    Attributes:
    length_mm: Extent of the glass along x.
    width_mm: Extent of the glass along y.
    thickness_mm: Thickness of the glass.
    glass: Kind of glass: aluminosilicate, borosilicate or soda_lime.
    held: How the glass is held at its edges.
    screen_length_mm: Extent along x of the touch panel's active area, in the middle of the glass; 0: all of it.
    screen_width_mm: The same along y.
    disc: Piezo disc: 7BB-12-9, 7BB-15-6, 7BB-20-6, 7BB-27-4 or FT-20T-6.5A.
    discs: Number of discs, each cut in four.
    rim_mm: From the edge of the glass to the rim of a disc.
    resistor_w: Power rating of a stage's resistor, of which half may be used.
    waveform: Drive words that a finger feels most, or the paper's own: felt or paper.
    fpga: FPGA board, and the computer that it is wired to: a Raspberry Pi 4 (ulx3s, colorlight_i5, tang_primer_20k) or 5 (the
        same with _pi5 behind); or a panel to rehearse with (simulated).
    touch: Kind of touch panel.
    """

    length_mm: ExtentMm
    width_mm: ExtentMm
    thickness_mm: Annotated[float, Meta(ge=0.1, le=20)]
    glass: Literal["aluminosilicate", "borosilicate", "soda_lime"] = "soda_lime"
    held: Literal["foam", "free", "simply_supported", "clamped"] = "foam"
    screen_length_mm: Annotated[float, Meta(ge=0, le=4000)] = 0.0
    screen_width_mm: Annotated[float, Meta(ge=0, le=4000)] = 0.0
    disc: str = "7BB-12-9"
    discs: Annotated[int, Meta(ge=1, le=8)] = 8
    rim_mm: Annotated[float, Meta(ge=0, le=500)] = 3.0
    resistor_w: Annotated[float, Meta(ge=0.05, le=10)] = 0.5
    waveform: Literal["felt", "paper"] = "felt"
    fpga: Literal[
        "ulx3s", "ulx3s_pi5", "colorlight_i5", "colorlight_i5_pi5", "tang_primer_20k", "tang_primer_20k_pi5", "simulated"
    ] = "ulx3s"
    touch: Literal["ft5x06", "gt911", "linux_input", "serial_panel"] = "linux_input"

    def __post_init__(self) -> None:
        Parts(disc=self.disc)
        for name, extent_mm in (("length_mm", self.length_mm), ("width_mm", self.width_mm)):
            if getattr(self, f"screen_{name}") > extent_mm:
                raise ValueError(f"screen_{name} = {getattr(self, f'screen_{name}'):g} is above the glass's {name} = {extent_mm:g}")

    @property
    def plate(self) -> Plate:
        """The plate of these answers."""
        return msgspec.convert(self.plate_keys, Plate)

    @property
    def plate_keys(self) -> dict[str, Any]:
        """Keys of [plate]."""
        size = {name: getattr(self, name) for name in ("length_mm", "width_mm", "thickness_mm")}
        return {**size, **glasses()[self.glass], **HELD[self.held], "decay_time_ms": 1.0, "theory": "mindlin"}

    @property
    def axes(self) -> dict[str, list[float]]:
        """The touch axes of a panel whose active area is in the middle of the glass."""
        found = {}
        for index, (name, extent_mm) in enumerate((("length_mm", self.length_mm), ("width_mm", self.width_mm))):
            active_mm = getattr(self, f"screen_{name}") or extent_mm
            found[AXES[index]] = [active_mm if index == axis else 0.0 for axis in (0, 1)] + [round((extent_mm - active_mm) / 2, 3)]
        return found


@cache
def glasses() -> dict[str, dict[str, float]]:
    """Material keys of [plate], by kind of glass."""
    return read_tables(GLASSES)


def wanted_of(kind: str) -> tuple[msgspec.structs.FieldInfo, ...]:
    """Keys of [touch] that a kind of touch panel needs besides its axes."""
    record = touch_record(kind)
    assert record is not None
    return tuple(field for field in msgspec.structs.fields(record) if field.required and field.name not in AXES)

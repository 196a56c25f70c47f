"""What is wrong with a simulated panel, beside its board.toml, and what is there then."""

from pathlib import Path
from typing import Annotated, Any, Final

import msgspec
from msgspec import Meta

from controller.device.board.board import Board
from controller.device.board.records import Record
from controller.workshop.gateware.actual_panel import SensorFrame, rewired

SHIPPED: Final = Path(__file__).with_suffix(".toml")
FLASH: Final = "flash.bit"
Factor = Annotated[float, Meta(gt=0, le=10)]


class WrongPanel(Record, frozen=True, kw_only=True):
    """Differences from board.toml; the meaning of each stands in `wrong_panel.toml`."""

    empty_fpga: bool = False
    swapped: tuple[tuple[int, int], ...] = ()
    dead: tuple[int, ...] = ()
    dead_interrupt: bool = False
    resistance: Factor = 1.0
    capacitance: Factor = 1.0
    longer_mm: float = 0.0
    wider_mm: float = 0.0
    plate: dict[str, Any] = msgspec.field(default_factory=dict)
    frame: SensorFrame = SensorFrame()

    def text(self, board: Board) -> str:
        """The file that says what is there of a board that is wrong like this."""
        driver = board.driver
        plate = {"length_mm": board.plate.length_mm + self.longer_mm, "width_mm": board.plate.width_mm + self.wider_mm}
        stages = {
            "resistance_ohm": driver.resistance_ohm * self.resistance,
            "capacitance_f": driver.capacitance_f * self.capacitance,
        }
        patches = rewired(board, self.swapped, self.dead)
        return "\n".join([
            "# What is there of this simulated panel, where it is not as board.toml says",
            "actuators = [",
            *(f"    {{ {', '.join(_keys(msgspec.structs.asdict(one)))} }}," for one in patches),
            "]",
            *_table("plate", plate | self.plate),
            *_table("driver", stages),
            *_table("frame", msgspec.structs.asdict(self.frame)),
            *_table("touch", {"interrupt": not self.dead_interrupt}),
            *(_table("fpga", {"flash": FLASH}) if self.empty_fpga else ()),
            "",
        ])  # fmt: skip


def _table(name: str, keys: dict[str, Any]) -> list[str]:
    """A table of TOML; what TOML and JSON write alike."""
    return ["", f"[{name}]", *_keys(keys)]


def _keys(keys: dict[str, Any]) -> list[str]:
    return [f"{key} = {msgspec.json.encode(value).decode()}" for key, value in keys.items()]

"""Writes the folder of a new board: board.toml, scene, and what its bitstream is built from; it holds all that it names.

What follows from the FPGA board, [link], [gateware] and the FPGA's own files, is that of the shipped board. The folder is made
under another name, checked as a whole, and renamed.
"""

from __future__ import annotations

import math
import re
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from controller.device.board.board import Board, load_board
from controller.device.board.lookup import data_folder
from controller.device.board.panel import Driver, Waveform
from controller.device.board.plate.parts import Parts, followed
from controller.device.board.records import as_record, read_tables
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.device.board.relations.stage_heat import worst_edge_j
from controller.device.board.touch_panels import touch_record
from controller.device.scene.scene_file import find_scene, read_scene
from controller.device.setup.answers import SetupAnswers
from controller.device.setup.placement import actuators_around
from controller.errors import ConfigError

SIMULATED: Final = "simulated"
ON_A_PI_5: Final = "_pi5"  # behind the name of an FPGA board
ACTUAL: Final = "actual.toml"  # what is really there of a simulated panel
EMPTY: Final = """# What is there of this simulated panel, where it is not as board.toml says (workshop/gateware/actual_panel.py)
[fpga]
flash = "flash.bit"  # written by `gateware load`; not there: the FPGA is empty, as it is delivered
"""
KEPT: Final = ("waveform", "link", "gateware", "application_socket")
SLOPE: Final = "slope = -1  # felt 16 % more, 18 % fewer edges; 2.7 dB(A) louder, contrast 26 for 31; 0: the paper's\n"
PITCH: Final = 0.6  # of half the shortest wave: that of the simulated board
NAME: Final = re.compile(r"[a-z0-9][a-z0-9_-]{0,63}")


def write_board(folder: Path, answers: SetupAnswers, touch: Mapping[str, Any]) -> Board:
    """Write the folder of a board, and read it back.

    `folder` does not exist yet; its name becomes the board's. `touch` has the keys of [touch] besides kind and axes. Raises
    ConfigError if the folder exists, cannot be written or has no name for a board, or if the board would be refused.
    """
    if not NAME.fullmatch(folder.name):
        raise ConfigError(f"{folder}: a board's folder has a name of lower case letters, digits, - and _")
    if folder.exists() or folder.is_symlink():
        raise ConfigError(f"{folder}: exists already; give another folder, or remove it first")
    text = board_text(folder.name, answers, touch)
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=f".{folder.name}-", dir=folder.parent) as made:
            board = Path(made) / folder.name
            board.mkdir()
            (board / "board.toml").write_text(text, encoding="utf-8")
            shutil.copy(data_folder("boards") / "simulated" / "plate.toml", board / "scene.toml")
            if answers.fpga == SIMULATED:
                (board / ACTUAL).write_text(EMPTY, encoding="utf-8")
            for file in _fpga_files(_fpga_folder(answers)):
                shutil.copy(file, board)
            read = load_board(board)
            read_scene(find_scene(read), read)
            board.rename(folder)
    except OSError as error:
        raise ConfigError(f"{folder}: cannot be written ({error.strerror})") from error
    return load_board(folder)


def _fpga_folder(answers: SetupAnswers) -> Path:
    """Folder of the FPGA board: its top.v, pins and loader."""
    name = "ulx3s" if answers.fpga == SIMULATED else answers.fpga.removesuffix(ON_A_PI_5)
    return data_folder("boards") / name


def _fpga_files(folder: Path) -> list[Path]:
    """What a bitstream is made of, besides the Verilog of all."""
    return [file for file in sorted(folder.iterdir()) if file.name in ("top.v", "fpga.toml") or file.stem == "pins"]


def board_text(name: str, answers: SetupAnswers, touch: Mapping[str, Any]) -> str:
    """Text of board.toml; raises ConfigError if keys of [touch] are invalid, or the discs do not fit on the glass."""
    fpga = _fpga_folder(answers)
    shipped = (fpga.with_name("ulx3s_pi5") if answers.fpga.endswith(ON_A_PI_5) else fpga) / "board.toml"
    tables, sections = read_tables(shipped), _sections(shipped.read_text(encoding="utf-8"))
    own = _sections((fpga / "board.toml").read_text(encoding="utf-8"))
    sections["gateware"] = own["gateware"]
    clock = re.compile(r"^clock_hz = .*$", re.MULTILINE)
    sections["link"] = clock.sub(clock.findall(own["link"])[0], sections["link"])
    if answers.fpga == SIMULATED:
        link = {key: tables["link"][key] for key in ("clock_hz", "sck_hz", "slots")}
        sections["link"] = _table("link", {"kind": SIMULATED, "device": ACTUAL, **link})
        del sections["gateware"]
    if answers.waveform == "felt":
        sections["waveform"] = sections["waveform"].rstrip() + "\n" + SLOPE
    waveform = as_record(f"{shipped}: waveform.", tables["waveform"], Waveform)
    parts = Parts(disc=answers.disc)
    actuators = actuators_around(answers.length_mm, answers.width_mm, parts, answers.discs, answers.rim_mm)
    plate, supply_v = answers.plate, tables["driver"]["supply_v"]
    driver = followed(parts, plate, waveform, {"supply_v": supply_v})["driver"]
    pitch_mm = math.floor(10 * PITCH * 1e3 * bending_wavelength_m(plate, waveform.band_high_hz) / 2) / 10
    panel = {"kind": answers.touch, **touch, **answers.axes}
    record = touch_record(answers.touch)
    assert record is not None
    as_record("touch.", {key: value for key, value in panel.items() if key != "kind"}, record)
    return "\n".join([
        f"# haptic-panel setup: {answers.discs} discs {answers.disc} on {answers.glass} glass; keys: haptic-panel board reference",
        f'name = "{name}"',
        'scene = "scene.toml"',
        "",
        "# Quadrants of discs, half of which idle high; the origin is a corner of the glass, x along its length",
        "actuators = [",
        *(f"    {_inline(actuator)}," for actuator in actuators),
        "]",
        "",
        _table("plate", answers.plate_keys),
        _table("parts", {"disc": answers.disc}, "Capacitance, moment, R and L follow from it"),
        _table("driver", {"supply_v": supply_v}, _bought(driver)),
        _table("bank", {"pitch_mm": pitch_mm, "snap_mm": round(pitch_mm / 10, 3)}),
        _table("touch", panel, "Axes as drawn, until calibrate-touch has measured them"),
        *(sections[one].rstrip() + "\n" for one in KEPT if one in sections),
        _limits(sections["limits"], tables["limits"], driver, answers, len(actuators)),
    ])  # fmt: skip


def _bought(driver: Mapping[str, float]) -> str:
    millihenry, nanofarad = driver["inductance_h"] * 1e3, driver["capacitance_f"] * 1e9
    return f"Each stage: {driver['resistance_ohm']:g} ohm and {millihenry:g} mH into {nanofarad:g} nF"


def _limits(text: str, shipped: Mapping[str, float], driver: Mapping[str, float], answers: SetupAnswers, channels: int) -> str:
    """[limits] of the shipped board, with what follows from the stages: edges that the resistors bear, and the duty within them."""
    permitted_w = answers.resistor_w * shipped["derating"]
    rate_hz = _down(permitted_w / worst_edge_j(Driver(**driver)))
    changed = {
        "resistor_rating_w": answers.resistor_w,
        "max_channel_edge_rate_hz": rate_hz,
        "max_total_edge_rate_hz": _down(0.9 * channels * rate_hz),
        "max_duty": min(1.0, _down(rate_hz / shipped["max_edge_rate_hz"])),
    }
    kept = [(line.partition(" ")[0], line) for line in text.splitlines() if line and not line.startswith("#")]
    return "\n".join([*(f"{key} = {_value(changed[key])}" if key in changed else line for key, line in kept), ""])


def _down(value: float) -> float:
    """Two digits of a number, rounded down."""
    step = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{math.floor(value / step + 1e-9) * step:.2g}")


def _sections(text: str) -> dict[str, str]:
    """The tables of a TOML file, each with its heading and comments."""
    parts = re.split(r"^(?=\[(\w+)\])", text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def _table(name: str, keys: Mapping[str, Any], comment: str = "") -> str:
    return "\n".join(
        [*([f"# {comment}"] if comment else []), f"[{name}]", *(f"{key} = {_value(value)}" for key, value in keys.items()), ""]
    )


def _inline(keys: Mapping[str, Any]) -> str:
    return "{ " + ", ".join(f"{key} = {_value(value)}" for key, value in keys.items()) + " }"


def _value(value: Any) -> str:
    """A value as TOML has it."""
    match value:
        case bool():
            return str(value).lower()
        case str():
            return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
        case dict():
            return _inline(value)
        case list():
            return "[" + ", ".join(_value(one) for one in value) + "]"
        case float():
            return f"{value:g}" if float(f"{value:g}") == value and abs(value) < 1e5 else repr(value)
        case _:
            return str(value)

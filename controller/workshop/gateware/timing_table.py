"""Timing tables: input changes and expected output changes of the gateware's pins, tick by tick, written by hand.

`fpga_rtl/timing/*.timing.toml` holds them; tests/conformance/test_timing.py performs each on every back-end and
`timing_diagram` draws it. A file names ticks, and has one [case.<name>] for each table:

    [ticks]
    first = 6                       # first word on the pins
    [case.two_words]
    title = "..."
    why = "..."                     # the fault that it would reveal
    bit_ticks = 4                   # or 4.25
    slots = { 0 = "0x11 0x22*8" }   # stored before tick 0: a word, another one 8 times
    plays = ["slot=0 emissions=1"]      # accepted before tick 0
    settings = { RAMP_SAMPLES = 4 } # registers written before arming
    setup = "armed"                 # or "off"
    table = '''
    0:       trigger
    first:   -> channel=0x11
    first+2*bit: -> channel=idle focus
    '''

Rows are `tick: inputs -> outputs`. Tick 0 is arbitrary, `bit` is a bit period. `trigger` is a pulse (`trigger=2`: of two
ticks) and `focus` the rising edge of one; the others are levels from that tick on. `frame="NOP"` is a frame whose chip select
rises at that tick; `@7` in it is tick 7 of the FPGA's clock. Signals that a row does not name do not change.
"""

import hashlib
import re
import shlex
import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

INPUTS: Final = ("trigger", "permit", "temperature", "frame")
OUTPUTS: Final = ("channel", "hv_enable", "focus", "waiting", "fault")
PULSES: Final = ("trigger", "focus")
SETUPS: Final = ("off", "armed")
IDLE: Final = "idle"

_OPTIONAL: Final[dict[str, type]] = {"slots": dict, "plays": list, "settings": dict}
_NEEDED: Final[dict[str, Any]] = {"title": str, "why": str, "setup": str, "bit_ticks": (int, float), "table": str}


@dataclass(frozen=True)
class Change:
    """A change of one pin at one tick: `value` is a number, `idle`, the text of a frame, or empty for a pulse."""

    tick: int
    signal: str
    value: str


@dataclass(frozen=True)
class Case:
    """One table."""

    name: str  # name, title, why: key and title of the table; the fault that it would reveal
    title: str
    why: str
    setup: str  # "off" or "armed": state at tick 0
    bit_ticks: float  # bit period
    inputs: tuple[Change, ...]  # inputs, outputs: in the order of their ticks
    outputs: tuple[Change, ...]
    slots: dict[int, tuple[int, ...]] = field(default_factory=dict)  # drive words of each slot that is stored before tick 0
    plays: tuple[str, ...] = ()  # arguments of each PLAY accepted before tick 0
    settings: dict[str, int] = field(default_factory=dict)  # value of each register written before arming

    @property
    def last_tick(self) -> int:
        """Tick of the last change."""
        return max(change.tick for change in (*self.inputs, *self.outputs))

    @property
    def digest(self) -> str:
        """Hash of the whole table, stored in its picture."""
        return hashlib.sha256(repr(self).encode()).hexdigest()[:16]


def load_cases(folder: Path) -> list[Case]:
    """Read every case of all `*.timing.toml` files of a folder, in the order of files and of their text.

    Raises ValueError, naming file and case, if a table cannot be read or two have the same name.
    """
    cases: list[Case] = []
    for path in sorted(folder.glob("*.timing.toml")):
        tables = tomllib.loads(path.read_text())
        for name, entries in tables.get("case", {}).items():
            try:
                cases.append(read_case(name, entries, tables.get("ticks", {})))
            except ValueError as error:
                raise ValueError(f"{path.name}, {name}: {error}") from error
    names = [case.name for case in cases]
    if len(set(names)) != len(names):
        raise ValueError(f"{folder}: two tables have the same name")
    return cases


def read_case(name: str, entries: dict[str, Any], ticks: dict[str, int]) -> Case:
    """Read one case.

    `name` is its key in the file, `entries` its TOML table, `ticks` are named ticks of the file. Raises ValueError if an entry is
    missing, unknown or of another type, or a row cannot be read.
    """
    for key, kind in _NEEDED.items():
        if not isinstance(entries.get(key), kind):
            raise ValueError(f"{key!r} has to be there, of type {getattr(kind, '__name__', 'number')}")
    if unknown := set(entries) - set(_NEEDED) - set(_OPTIONAL):
        raise ValueError(f"unknown: {', '.join(sorted(unknown))}")
    if entries["setup"] not in SETUPS:
        raise ValueError(f"setup is {' or '.join(SETUPS)}, not {entries['setup']!r}")
    inputs, outputs = read_table(entries["table"], {"bit": int(entries["bit_ticks"])} | ticks)
    return Case(
        name=name,
        title=entries["title"],
        why=entries["why"],
        setup=entries["setup"],
        bit_ticks=entries["bit_ticks"],
        inputs=inputs,
        outputs=outputs,
        slots={int(slot): drive_words(words) for slot, words in entries.get("slots", {}).items()},
        plays=tuple(entries.get("plays", ())),
        settings=dict(entries.get("settings", {})),
    )


def read_table(text: str, ticks: dict[str, int]) -> tuple[tuple[Change, ...], tuple[Change, ...]]:
    """Read the rows of a table, `tick: inputs -> outputs`, with comments after `#`, into its inputs and outputs.

    `ticks` are named ones. Raises ValueError, naming the row, if it cannot be read or comes before the one above it.
    """
    inputs: list[Change] = []
    outputs: list[Change] = []
    before: int | None = None
    for row in filter(None, (line.split("#")[0].strip() for line in text.splitlines())):
        when, colon, what = row.partition(":")
        given, _, shown = what.partition("->")
        if not colon or not (given + shown).strip():
            raise ValueError(f"row {row!r} is not `tick: inputs -> outputs`")
        tick = read_tick(when, ticks)
        if before is not None and tick <= before:
            raise ValueError(f"row {row!r} is not later than the one above it")
        before = tick
        inputs += [_change(tick, word, INPUTS) for word in shlex.split(given)]
        outputs += [_change(tick, word, OUTPUTS) for word in shlex.split(shown)]
    if not inputs:
        raise ValueError("nothing is done in this table")
    return tuple(inputs), tuple(outputs)


def drive_words(text: str) -> tuple[int, ...]:
    """Read the words of a waveform, such as `0x11 0x22*8`; raises ValueError if one of them is not a number."""
    parts = [part.partition("*") for part in text.split()]
    return tuple(int(word, 0) for word, _, times in parts for _ in range(int(times or 1)))


def read_tick(text: str, ticks: dict[str, int]) -> int:
    """Evaluate a sum of numbers and named `ticks`, such as `first+2*bit`.

    Raises ValueError if a name is unknown, or the text is not a sum.
    """
    compact = text.replace(" ", "")
    if not re.fullmatch(r"(\d+\*)?\w+([+-](\d+\*)?\w+)*", compact):
        raise ValueError(f"{text!r} is not a tick")
    total = 0
    for sign, times, term in re.findall(r"([+-]?)(?:(\d+)\*)?(\w+)", compact):
        if not term.isdigit() and term not in ticks:
            raise ValueError(f"{term!r} is none of the named ticks {', '.join(ticks)}")
        value = int(times or 1) * (int(term) if term.isdigit() else ticks[term])
        total += -value if sign == "-" else value
    return total


def _change(tick: int, word: str, signals: tuple[str, ...]) -> Change:
    signal, equals, value = word.partition("=")
    if signal not in signals:
        raise ValueError(f"{signal!r} is none of {', '.join(signals)}")
    if signal == "focus" and equals:
        raise ValueError(f"{word!r}: focus is a pulse and has no value")
    if signal not in PULSES and not equals:
        raise ValueError(f"{word!r}: {signal} needs a value")
    if (signal == "channel" and value != IDLE) or (signal == "trigger" and equals):
        int(value, 0)
    elif signal not in (*PULSES, "channel", "frame") and value not in {"0", "1"}:
        raise ValueError(f"{word!r}: {signal} is 0 or 1")
    return Change(tick, signal, value)

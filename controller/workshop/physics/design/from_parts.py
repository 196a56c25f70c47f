"""Numbers of a design that follow from its discs, its glass and its band: patch size, C, L, R and moment.

Each has its rule (`board.parts`). What the board has of it says by how much its own part differs from the rule, and this ratio is
kept: the moment of the paper's panel was fitted, a patch's capacitance may have been measured. A number that is given stands.
"""

from collections.abc import Callable, Mapping
from typing import Final

from controller.device.board.board import Board
from controller.device.board.plate.parts import Parts, inductance_h, resistance_ohm
from controller.device.board.plate.plate import Plate

FOLLOWING: Final = ("size_mm", "capacitance_f", "inductance_h", "resistance_ohm", "moment_n_per_v")
ASSUMED: Final = Parts(disc="7BB-12-9")  # of a board without [parts]: the paper's


def from_parts(
    board: Board, own: Mapping[str, float], plate: Plate, middle_hz: float, given: Mapping[str, float], parts: Parts | None
) -> dict[str, float]:
    """The numbers that follow for the design's `plate` and `parts` (None: as the board); `own` are the board's, `given` stand."""
    of_board = board.parts or ASSUMED
    kept = {name: value for name, value in given.items() if name in FOLLOWING}
    if parts is None and "size_mm" not in kept:
        kept["size_mm"] = own["size_mm"]
    ratios = {}
    for name in FOLLOWING:
        others = {other: own[other] for other in FOLLOWING if other != name}
        ratios[name] = own[name] / by_rule(of_board, board.plate, board.waveform.middle_hz, others, board)[name]
    return by_rule(parts or of_board, plate, middle_hz, kept, board, ratios)


def by_rule(
    parts: Parts,
    plate: Plate,
    middle_hz: float,
    given: Mapping[str, float],
    board: Board,
    ratios: Mapping[str, float] | None = None,
) -> dict[str, float]:
    """Numbers by the parts' rules, each times its ratio, but for those given."""
    found = dict(given)
    on = parts.on(plate)
    rules: dict[str, Callable[[], float]] = {
        "size_mm": lambda: parts.size_mm,
        "capacitance_f": lambda: parts.capacitance_f(found["size_mm"]),
        "inductance_h": lambda: inductance_h(found["capacitance_f"], middle_hz),
        "resistance_ohm": lambda: resistance_ohm(found["inductance_h"], found["capacitance_f"]),
        "moment_n_per_v": lambda: on.disc_moment_n_per_v if board.patches else on.moment_n_per_v,
    }
    for name in FOLLOWING:
        if name not in found:
            found[name] = rules[name]() * (ratios or {}).get(name, 1.0)
    return found

"""Search for panels that are felt: glass, discs and the fewest channels that reach a felt amplitude."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, Final, NamedTuple

import msgspec

from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS
from controller.device.board.plate.parts import Parts, catalogue
from controller.errors import ConfigError
from controller.workshop.physics.design.design_figures import design_figures
from controller.workshop.physics.design.design_inputs import inputs_of
from controller.workshop.physics.design.from_parts import ASSUMED
from controller.workshop.physics.design.panel_estimate import PanelEstimate

SEARCHED: Final = ("thickness", "channels", "disc")
GLASS_MM: Final = (0.3, 0.4, 0.5, 0.55, 0.7, 0.85, 1.1, 1.3, 1.6, 2.0, 3.0, 4.0)  # thicknesses that are sold
MOST_ROWS: Final = 12
SHOWN: Final = ("spot_mm", "contrast_outside", "resistors_w", "edge_limit_khz")


def find_designs(
    board: Board,
    changes: Mapping[str, float],
    parts: Parts | None,
    searched: Sequence[str],
    felt_um: float,
    prices: Mapping[str, float] | None = None,  # of a channel with its stage ("channel"), of a disc by its name, or of any ("disc")
) -> list[dict[str, Any]]:
    """At most `MOST_ROWS` panels that reach a felt amplitude of `felt_um`: those of the fewest channels, of these the strongest.

    `changes` are numbers that stand; `searched`, of `SEARCHED`, may differ; if no panel reaches it, the strongest alone is
    returned. With `prices` the cheapest come first, and a disc without a price is not searched. `parts` None: as the board. Raises
    ConfigError if a number stands and is searched, what is searched or has a price is unknown, or no panel is possible.
    """
    _check(changes, parts, searched, prices)
    discs = [msgspec.structs.replace(parts or board.parts or ASSUMED, disc=name) for name in catalogue() if _priced(name, prices)]
    found: list[_Found] = []
    refused = ""
    for one in discs if "disc" in searched else [parts]:
        for thickness_mm in GLASS_MM if "thickness" in searched else [None]:
            numbers = changes if thickness_mm is None else {**changes, "thickness_mm": thickness_mm}
            try:
                found.append(_fewest(board, numbers, one, felt_um) if "channels" in searched else _as_given(board, numbers, one))
            except ConfigError as error:
                refused = str(error)
    if not found:
        raise ConfigError(f"--find: no such panel is possible ({refused})")
    best = sorted((one for one in found if one.felt_um >= felt_um), key=lambda one: (one.numbers.get("channels"), -one.felt_um))
    rows = [_row(board, one, prices) for one in (best if prices else best[:MOST_ROWS]) or [max(found, key=lambda one: one.felt_um)]]
    return sorted(rows, key=lambda row: (row.get("cost", 0), row["channels"], row["resistors_w"]))[:MOST_ROWS]


class _Found(NamedTuple):
    felt_um: float
    numbers: Mapping[str, float]
    parts: Parts | None


def _as_given(board: Board, numbers: Mapping[str, float], parts: Parts | None) -> _Found:
    return _Found(PanelEstimate(board, inputs_of(board, numbers, parts)).felt_um, numbers, parts)


def _fewest(board: Board, numbers: Mapping[str, float], parts: Parts | None, felt_um: float) -> _Found:
    """The fewest whole discs that reach it, or as many as the FPGA drives: the amplitude goes with their number."""
    sectors = (parts or board.parts or ASSUMED).sectors
    most = CHANNELS // sectors * sectors
    all_of_them = _as_given(board, {**numbers, "channels": most}, parts)
    discs = math.ceil(felt_um / all_of_them.felt_um * most / sectors - 1e-9)
    return _as_given(board, {**numbers, "channels": min(max(discs, 1) * sectors, most)}, parts)


def _priced(disc: str, prices: Mapping[str, float] | None) -> bool:
    return not prices or not prices.keys() - {"channel"} or disc in prices or "disc" in prices


def _check(changes: Mapping[str, float], parts: Parts | None, searched: Sequence[str], prices: Mapping[str, float] | None) -> None:
    for name in prices or {}:
        if name not in (known := ("channel", "disc", *catalogue())):
            raise ConfigError(f"--price {name}: must be one of {', '.join(known)}")
    for name in searched:
        if name not in SEARCHED:
            raise ConfigError(f"--find {','.join(searched)}: {name!r} cannot be searched: one or more of {','.join(SEARCHED)}")
    stand = {"thickness": "thickness_mm" in changes, "channels": "channels" in changes, "disc": parts is not None}
    for name in searched:
        if stand[name]:
            raise ConfigError(f"--find {','.join(searched)}: {name} is given too: leave out one of both")


def _row(board: Board, found: _Found, prices: Mapping[str, float] | None) -> dict[str, Any]:
    figures = design_figures(board, found.numbers, found.parts)
    given, of = figures["inputs"], found.parts or board.parts or ASSUMED
    disc, discs = of.disc if isinstance(of.disc, str) else "own", math.ceil(given["channels"] / of.sectors)
    costs = prices or {}
    cost = discs * costs.get(disc, costs.get("disc", 0.0)) + given["channels"] * costs.get("channel", 0.0)
    return {
        "thickness_mm": given["thickness_mm"],
        "disc": disc,
        "discs": discs,
        "channels": given["channels"],
        **({"cost": cost} if prices else {}),
        "felt_um": figures["felt_um"],
        **{name: figures[name] for name in SHOWN},
        **{name: given[name] for name in ("resistance_ohm", "inductance_h", "capacitance_f")},
        "warnings": figures["warnings"],
    }

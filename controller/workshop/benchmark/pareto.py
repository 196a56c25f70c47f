"""The Pareto front of costs and errors: settings of which no other has both less cost and less error."""

from collections.abc import Sequence
from typing import Any

Figures = dict[str, Any]
AXES = ("time", "memory", "wire", "stage energy")


def pareto_front(costs: Sequence[float], errors: Sequence[float]) -> list[int]:
    """Indices, by ascending cost, of the settings that no other one dominates; of equal settings all.

    One setting dominates another if neither its cost nor its error is larger and one of both is smaller.

    Raises ValueError if there are not as many errors as costs.
    """
    by_cost = sorted(zip(costs, errors, range(len(costs)), strict=True))
    front: list[int] = []
    least = cost_of_least = float("inf")
    for cost, error, index in by_cost:
        if error < least or (error == least and cost == cost_of_least):
            front.append(index)
            least, cost_of_least = error, cost
    return front


def cost(setting: Figures, axis: str, family: str) -> float | None:
    """Cost of a setting on one of `AXES`, for scenes of a family; None if it was not measured."""
    if axis == "memory":
        return float(setting["memory_bytes"])
    if axis == "wire":
        return float(setting["wire_bytes"])
    if axis == "stage energy":
        found = setting["families"].get(family)
        return found and float(found["stage_j"]["median"])
    timing = setting["time_us"].get(family.partition(" ")[0])
    return timing and float(timing["median_us"])


def main_error(family: str) -> str:
    """The error by which methods are compared first: of one finger in the band, of several the worst one over the best method."""
    return "bound_loss" if family.startswith("1 ") else "best_loss"


def front(settings: Sequence[Figures], axis: str, family: str) -> list[int]:
    """Indices of the settings on the Pareto front of a cost and the median of the main error, by ascending cost."""
    error = main_error(family)
    evaluated = [index for index, setting in enumerate(settings) if family in setting["families"]]
    costs = [(index, cost(settings[index], axis, family)) for index in evaluated]
    costly = [(index, value) for index, value in costs if value is not None]
    errors = [settings[index]["families"][family][error]["median"] for index, _ in costly]
    return [costly[place][0] for place in pareto_front([value for _, value in costly], errors)]

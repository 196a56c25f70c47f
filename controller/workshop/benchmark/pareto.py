"""The Pareto front of costs and errors: settings of which no other has both less cost and less error."""

from __future__ import annotations

from collections.abc import Sequence


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

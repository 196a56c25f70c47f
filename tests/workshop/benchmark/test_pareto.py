"""The Pareto front: what is on it is beaten by nothing, and what is not is beaten by something on it."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.workshop.benchmark.pareto import pareto_front

NUMBERS = st.integers(0, 6).map(float)


def beats(one, other):
    return one[0] <= other[0] and one[1] <= other[1] and one != other


@given(st.lists(st.tuples(NUMBERS, NUMBERS)))
def test_the_front_is_what_nothing_beats(settings):
    front = pareto_front([cost for cost, _ in settings], [error for _, error in settings])
    assert set(front) == {index for index, some in enumerate(settings) if not any(beats(other, some) for other in settings)}
    assert [settings[index][0] for index in front] == sorted(settings[index][0] for index in front)
    assert len(set(front)) == len(front)


def test_costs_without_errors_are_refused():
    with pytest.raises(ValueError, match="zip"):
        pareto_front([1.0], [])

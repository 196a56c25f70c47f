"""Arrays by the kind of their numbers, and in blocks; a shape stands in the docstring of what has one."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Reals = NDArray[np.floating[Any]]
Complex = NDArray[np.complex128]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]
Words = NDArray[np.uint32]


def blocks(count: int, at_once: int) -> Iterator[slice]:
    """Slices that divide `count` items into blocks of `at_once`, the last one of what is left."""
    return (slice(first, min(first + at_once, count)) for first in range(0, count, at_once))

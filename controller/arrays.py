"""Arrays by the kind of their numbers; a shape stands in the docstring of what has one."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Reals = NDArray[np.floating[Any]]
Complex = NDArray[np.complex128]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]
Words = NDArray[np.uint32]

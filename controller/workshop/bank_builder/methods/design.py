"""What every method of finding drive words takes and gives.

The bank's entries, the composition on the device, and the methods of `waveform_design` all stand behind `DesignMethod`; bank
builder and benchmark take any of them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Reals
from controller.device.kernel import Point

Place = tuple[float, float]  # x_m, y_m


@dataclass(frozen=True, slots=True)
class WaveformDesign:
    """Drive words, and what the method that made them expects of them."""

    words: NDArray[np.uint32]  # (sample,): drive words, first played first
    # (point,): at each point at T, from rest at the idle word; negative where the point is kicked downwards
    displacement_m: Reals
    nulls_m: Reals  # (null,): largest absolute displacement at each null near T


class DesignMethod(Protocol):
    """A method of finding drive words."""

    @property
    def name(self) -> str:
        """One to four words for tables and legends."""

    def design(self, points: Sequence[Point], nulls: Sequence[Place] = ()) -> WaveformDesign:
        """Find drive words for one emission, with places (`nulls`) that shall stay still near T.

        Amplitudes are above 0 to 1, each a share of what the point would get if all points were composed at full amplitude. Raises
        ValueError if there is no point, if numbers are not finite or beyond their range, or if the method cannot do what is asked:
        nulls, or less than full amplitude.
        """

"""Which waveforms are worth sending ahead of a moving finger: those of predictions that keep coming true."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from controller.device.scene.emission import Emission
from controller.device.waveforms.selection import Key, Selection
from controller.metrics import Counters

# This many predictions in a row come true, sent or not, before one is sent; one more of several fingers
PREFETCH_AFTER_HITS: Final = 2


class PrefetchRecord:
    """The newest prediction, how many came true, and which slots hold waveforms that were sent ahead.

    `prefetched` and `prefetch_wasted` are counted.
    """

    def __init__(self, counters: Counters) -> None:
        self._counters = counters
        self.predicted: tuple[int, Key] | None = None  # the newest prediction: finger, and the waveform that it will ask for
        self._hits = 0  # in a row
        self.unplayed: set[int] = set()  # slots whose waveform was sent ahead, and has not been played

    def predict(self, finger: int, key: Key, selection: Selection, fingers: int) -> bool:
        """Take note of a prediction; whether the record is good enough to send its waveform ahead, with this many fingers down."""
        if self.predicted is not None and not self._is_hit(finger, key, selection):
            self._hits = 0
        self.predicted = finger, key
        return self._hits >= PREFETCH_AFTER_HITS + (fingers > 1)

    def compare(self, emissions: Sequence[Emission], key: Key, selection: Selection) -> None:
        """Compare what is played now with the prediction that there is, if that was for one of these fingers."""
        assert self.predicted is not None
        predicted = self.predicted[0]
        for emission in emissions:
            if emission.finger == predicted:
                self._hits = self._hits + 1 if self._is_hit(emissions[0].finger, key, selection) else 0
                self.predicted = None
                return

    def sent(self, slot: int) -> None:
        """A waveform was sent ahead into a slot; it counts as wasted until it is played."""
        self.unplayed.add(slot)
        self._counters.prefetched += 1
        self._counters.prefetch_wasted += 1

    def played(self, slot: int) -> None:
        """The waveform of an unplayed slot is played."""
        self.unplayed.remove(slot)
        self._counters.prefetch_wasted -= 1

    def _is_hit(self, finger: int | None, key: Key, selection: Selection) -> bool:
        """Whether the waveform predicted last serves for this."""
        assert self.predicted is not None
        predicted_finger, predicted = self.predicted
        return finger == predicted_finger and (key == predicted or selection.reusable(key, predicted))

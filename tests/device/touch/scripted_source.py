"""A source that gives the samples of a script: the tracker's interface, without a decoder before it."""

from collections import Counter

from controller.device.touch.source import Counts, TouchSample


def touch(finger, x_mm, y_mm=50.0, size_mm=0.0):
    """A contact in a script's report."""
    return TouchSample(finger, x_mm * 1e-3, y_mm * 1e-3, 0.0, True, size_mm * 1e-3)


class ScriptedSource:
    """Reports as `(time_s, contacts)`: those that are new or moved give samples, those missing are released, as a decoder does."""

    def __init__(self, *reports):
        self.counts = Counts()
        self.warnings = Counter()
        self.touched = False
        self._reports = list(reports)
        self._down = {}

    def fileno(self):
        return None

    def next_time_s(self):
        return self._reports[0][0] if self._reports else None

    def read(self, now_s):
        self.touched = False
        if not self._reports or self._reports[0][0] > now_s:
            return ()
        time_s, contacts = self._reports.pop(0)
        there = {contact.finger: contact for contact in contacts}
        gone = [self._down.pop(finger)._replace(contact=False) for finger in list(self._down) if finger not in there]
        changed = [contact for finger, contact in there.items() if self._down.get(finger) != contact]
        self._down.update(there)
        self.touched = bool(there)
        return tuple(sample._replace(time_s=time_s) for sample in gone + changed)

    def close(self):
        self._reports.clear()


def played(tracker, until_s=float("inf")):
    """All samples of a tracker, read whenever it wants to be."""
    samples = []
    while (at_s := tracker.next_time_s()) is not None and at_s <= until_s:
        samples += tracker.read(at_s)
    return samples

"""A chip of gpio-sim, the kernel's own: named lines whose outputs are read and whose inputs are pulled through sysfs."""

from pathlib import Path

CONFIG = Path("/sys/kernel/config/gpio-sim")


class GpioLines:
    """A live chip `label` with lines from offset 0 on, which here have these names; `named` False: there they have none.

    gpio-sim merges edges closer than about 20 ms: it shows levels and slow edges, not pulses.
    """

    def __init__(self, label, names, named=True):
        self._folder = CONFIG / label
        bank = self._folder / "bank0"
        self._offsets = {name: offset for offset, name in enumerate(names)}
        bank.mkdir(parents=True)
        (bank / "num_lines").write_text(str(len(names)))
        (bank / "label").write_text(label)
        for name, offset in self._offsets.items():
            (bank / f"line{offset}").mkdir()
            if named:
                (bank / f"line{offset}" / "name").write_text(name)
        (self._folder / "live").write_text("1")
        self.chip = (bank / "chip_name").read_text().strip()
        self._device = Path("/sys/devices/platform", (self._folder / "dev_name").read_text().strip(), self.chip)

    def value(self, name):
        """Level of a line as anyone sees it: 0 or 1."""
        return int((self._device / f"sim_gpio{self._offsets[name]}" / "value").read_text())

    def pull(self, name, level):
        """Drive an input from outside."""
        (self._device / f"sim_gpio{self._offsets[name]}" / "pull").write_text("pull-up" if level else "pull-down")

    def close(self):
        """Unplug the chip."""
        _unplug(self._folder)


def unplug_all():
    """Unplug all chips of this machine; there are none where the kernel has no gpio-sim."""
    for folder in CONFIG.glob("*"):
        _unplug(folder)


def _unplug(folder):
    (folder / "live").write_text("0")
    bank = folder / "bank0"
    for made in [*bank.glob("line*"), bank, folder]:
        made.rmdir()

"""Lines of GPIO chips by name and by number, and what is said where there is none; real chips: tests/kernel/guest_link.py."""

import errno
from types import SimpleNamespace

import gpiod
import pytest
from tables import each_row

from controller.device.board import gpio_chip
from controller.device.board.gpio_chip import find_chip, find_lines, request_lines
from controller.errors import LinkError

PI_4 = ("ID_SDA", "ID_SCL", *[f"GPIO{number}" for number in range(2, 28)], *["-"] * 26)


class Chips:
    """Takes the place of gpiod: chips by path, each a label, the names of its lines, and who uses which."""

    LineSettings = gpiod.LineSettings

    def __init__(self, folder, monkeypatch):
        self._folder, self._chips = folder, {}
        monkeypatch.setattr(gpio_chip, "DEVICES", folder)
        monkeypatch.setattr(gpio_chip, "gpiod", self)

    def add(self, label, names, used=None):
        path = self._folder / f"gpiochip{len(self._chips)}"
        path.touch()
        self._chips[str(path)] = (label, tuple(names), used or {})
        return path

    def Chip(self, path):  # noqa: N802
        if path not in self._chips:
            raise PermissionError(errno.EACCES, "Permission denied")
        return Chip(*self._chips[path])


class Chip:
    def __init__(self, label, names, used):
        self._label, self._names, self._used = label, names, used

    def __enter__(self):
        return self

    def __exit__(self, *error):
        pass

    def get_info(self):
        return SimpleNamespace(label=self._label, num_lines=len(self._names))

    def get_line_info(self, number):
        assert type(number) is int  # by name gpiod takes the first of several
        return SimpleNamespace(name=self._names[number], used=number in self._used, consumer=self._used.get(number))

    def request_lines(self, config, consumer):
        assert all(type(number) is int for number in config)
        return SimpleNamespace(config=config, consumer=consumer)


@pytest.fixture
def chips(tmp_path, monkeypatch):
    return Chips(tmp_path, monkeypatch)


def numbers(*lines, label="soc"):
    return request_lines(label, dict.fromkeys(lines, gpiod.LineSettings()), "test", LinkError)[1]


def refusal(*lines, label="soc"):
    with pytest.raises(LinkError) as caught:
        numbers(*lines, label=label)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_a_line_is_given_by_its_name_or_by_its_number(chips):
    chips.add("soc", PI_4)
    assert numbers("GPIO25", "GPIO24", "1", "40") == {"GPIO25": 25, "GPIO24": 24, "1": 1, "40": 40}
    chips.add("unnamed", [None] * 54)
    assert numbers("25", "0", label="unnamed") == {"25": 25, "0": 0}


def test_a_name_of_digits_goes_before_a_number(chips):
    chips.add("soc", ["", "7", "", "", "", "", "", "", ""])
    assert numbers("7", "8") == {"7": 1, "8": 8}


@each_row(
    ("names", "line", "words"),
    [
        ([""] * 54, "GPIO25", 'its lines have no names; a line without a name is given by its number, "0" to "53"'),
        ([""] * 54, "54", "no line named '54'"),
        ([""] * 54, "-1", "no line named '-1'"),
        ([""] * 54, "9" * 5000, "no line named"),
        ([""] * 54, "\N{ARABIC-INDIC DIGIT THREE}", "no line named"),
        ([""] * 54, "0x19", "no line named"),
        (PI_4, "GPIO225", "names like it: GPIO25"),
        (PI_4, "-", "26 lines of GPIO chip 'soc' are named '-': give the number of one: \"28\", \"29\""),
        (["", "", "GPIO0_A2"], "GPIO25", "names like it: GPIO0_A2; a line without a name"),
    ],
    afresh=[chips],
)
def test_a_line_that_is_not_there_is_refused_with_what_there_is(chips, names, line, words):
    chips.add("soc", names)
    assert words in refusal(line)


def test_two_lines_that_are_one_are_refused(chips):
    chips.add("soc", PI_4)
    assert refusal("GPIO25", "25") == "lines 'GPIO25' and '25' of GPIO chip 'soc' are one line: its number 25"


@pytest.mark.parametrize(("consumer", "words"), [("spi0 CS0", "in use by spi0 CS0"), ("", "in use by the kernel")])
def test_a_line_in_use_is_refused_by_name_and_by_number(chips, consumer, words):
    chips.add("soc", PI_4, {25: consumer})
    assert words in refusal("GPIO25")
    assert words in refusal("25")


def test_several_chips_with_one_label_are_refused_and_one_of_them_is_given_by_its_path(chips, tmp_path):
    one, two = chips.add("pcf8574", [""] * 8), chips.add("pcf8574", [""] * 8)
    said = refusal("3", label="pcf8574")
    assert f"2 GPIO chips have the label 'pcf8574': {one}, {two}; give the path" in said
    assert numbers("3", label=str(two)) == {"3": 3}
    (tmp_path / "gpiochip9").symlink_to(one)  # as a Pi 5 has it: two names of one chip
    chips._chips[str(tmp_path / "gpiochip9")] = chips._chips[str(one)]
    del chips._chips[str(two)]
    assert find_chip("pcf8574", LinkError) == one


def test_a_label_that_is_not_there_is_refused_with_those_that_are(chips, tmp_path):
    chips.add("soc", PI_4)
    (tmp_path / "gpiochip7").touch()
    said = refusal("3", label="other")
    assert "no GPIO chip has the label 'other'; there are: soc; not permitted: " in said
    assert "gpiochip7 (Permission denied)" in said


def test_numbers_are_found_without_a_request(chips):
    chips.add("soc", PI_4, {25: "spi0 CS0"})
    with gpio_chip.gpiod.Chip(str(find_chip("soc", LinkError))) as chip:
        assert find_lines(chip, "soc", ["GPIO25", "1"], LinkError) == {"GPIO25": 25, "1": 1}

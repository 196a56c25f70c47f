"""Reports of the chips' data sheets, decoded; the drivers themselves: test_i2c_drivers.py, and tests/kernel/guest_panels.py."""

import functools
import operator
from collections import Counter

import pytest
from hypothesis import given
from hypothesis import strategies as st
from peers.ft5x06_chip import Ft5x06Chip
from peers.gt911_chip import STATUS, Gt911Chip
from peers.i2c_chip import READ, BusHangs, NotAcknowledged

from controller.device.touch.drivers.contact_events import MAX_CONTACTS, ReportedContact
from controller.device.touch.panels import ft5x06, gt911

places = st.dictionaries(
    st.integers(0, 9), st.tuples(st.integers(0, 4095), st.integers(0, 4095)).filter(lambda place: place != (0, 0)), max_size=10
)


def registers(chip, register, size):
    return chip.transfer([(chip.address, 0, register), (chip.address, READ, size)])


def ft5x06_report(chip, points=10):
    return registers(chip, b"\x00", 3 + 6 * points)


def gt911_report(chip, points=10):
    return registers(chip, b"\x81\x4e", 1 + 8 * points)


@given(places)
def test_every_contact_of_an_ft5x06_is_read(held):
    chip = Ft5x06Chip()
    chip.touch(held)
    warnings = Counter()
    assert ft5x06.REPORT.contacts(ft5x06_report(chip), warnings) == [
        ReportedContact(number, *place) for number, place in held.items()
    ]
    assert not warnings


@given(places, st.integers(0, 9))
def test_a_short_read_is_enough_or_says_that_it_is_not(held, points):
    chip = Ft5x06Chip()
    chip.touch(held)
    found = ft5x06.REPORT.contacts(ft5x06_report(chip, points), Counter())
    assert (found is None) == (points < len(held))
    goodix = Gt911Chip(contacts=10)
    goodix.touch(held)
    found = gt911.REPORT.contacts(gt911_report(goodix, points), Counter())
    assert (found is None) == (points < len(held))


def test_a_lifted_finger_of_an_ft5x06_is_not_listed_whether_or_not_the_chip_lists_it():
    chip = Ft5x06Chip()
    chip.touch({0: (10, 20), 1: (30, 40)})
    chip.touch({1: (30, 40)})
    report = bytearray(ft5x06_report(chip))
    assert ft5x06.REPORT.contacts(report, Counter()) == [ReportedContact(1, 30, 40)]
    report[2] = 2  # some firmware counts the lifted one
    assert ft5x06.REPORT.contacts(report, Counter()) == [ReportedContact(1, 30, 40)]


def test_the_ghost_at_the_corner_is_counted_and_left_out():
    chip = Ft5x06Chip()
    chip.ghosts = 2
    chip.touch({3: (1, 0)})
    warnings = Counter()
    assert ft5x06.REPORT.contacts(ft5x06_report(chip), warnings) == [ReportedContact(3, 1, 0)]
    assert warnings == {"ghost_points": 2}
    goodix = Gt911Chip()
    goodix.touch({0: (0, 0), 1: (0, 1)})
    assert gt911.REPORT.contacts(gt911_report(goodix), warnings) == [ReportedContact(1, 0, 1, 20)]
    assert warnings == {"ghost_points": 3}


@given(
    st.dictionaries(st.integers(0, 9), st.tuples(st.integers(1, 65535), st.integers(0, 65535)), max_size=10), st.integers(0, 65535)
)
def test_every_contact_of_a_gt911_is_read_with_its_size(held, size):
    chip = Gt911Chip(contacts=10)
    chip.touch(held, size)
    found = gt911.REPORT.contacts(gt911_report(chip), Counter())
    assert found == [ReportedContact(number, *place, size) for number, place in held.items()]


@given(st.binary(min_size=26, max_size=26))
def test_any_bytes_are_a_report_of_an_m06_or_refused(report):
    with pytest.raises(ValueError, match="header"):
        ft5x06.contacts_of_m06(b"\0" + report[1:], Counter())
    body = b"\xaa\xaa\x1a" + report[3:25]
    checksum = functools.reduce(operator.xor, body)
    for number, x, y, size in ft5x06.contacts_of_m06(body + bytes([checksum]), Counter()):
        assert 0 <= number < MAX_CONTACTS
        assert 0 < x + y < 8192
        assert size == 0
    with pytest.raises(ValueError, match="checksum"):
        ft5x06.contacts_of_m06(body + bytes([checksum ^ 1]), Counter())


@pytest.mark.parametrize("layout", [ft5x06.REPORT, gt911.REPORT])
@given(report=st.binary(min_size=100, max_size=100))
def test_any_bytes_are_contacts_that_can_be_or_refused(layout, report):
    try:
        found = layout.contacts(report, Counter())
    except ValueError:
        count = report[layout.count_at] & 0x0F
        assert count > MAX_CONTACTS
        return
    for number, x, y, size in found:
        assert 0 <= number < MAX_CONTACTS
        assert (x, y) != (0, 0)
        assert 0 <= min(x, y, size) <= max(x, y, size) <= 65535


def test_the_peer_gt911_takes_its_address_from_the_interrupt_pin_and_waits_to_be_cleared():
    chip = Gt911Chip()
    chip.pins(reset=False, interrupt=True)
    with pytest.raises(NotAcknowledged):
        gt911_report(chip)
    chip.pins(reset=True, interrupt=True)
    assert chip.address == 0x14
    assert registers(chip, b"\x81\x40", 4) == b"911\0"
    assert chip.touch({0: (1, 2)})
    assert not chip.touch({0: (3, 4)})
    chip.transfer([(0x14, 0, b"\x81\x4e\x00")])
    assert chip.registers[STATUS] == 0
    assert chip.touch({0: (3, 4)})


def test_the_peers_faults_are_those_of_a_bus():
    chip = Ft5x06Chip()
    chip.nacks = 1
    with pytest.raises(NotAcknowledged):
        ft5x06_report(chip)
    assert len(ft5x06_report(chip)) == 63
    chip.garbage = 0xFF
    assert set(ft5x06_report(chip)) == {0xFF}
    chip.hangs = True
    with pytest.raises(BusHangs):
        ft5x06_report(chip)

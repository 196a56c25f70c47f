import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.touch.axes import AxisRange, PanelAxes
from controller.device.touch.decoder import Decoder
from controller.device.touch.drivers.contact_events import MAX_CONTACTS, ContactEvents, ReportedContact, describe
from controller.device.touch.event_codes import Protocol, protocol_of_device

ABS, KEY, SYN = 3, 1, 0
SLOT, MAJOR, X, Y, ID, TOUCH = 0x2F, 0x30, 0x35, 0x36, 0x39, 0x14A
REPORT = (SYN, 0, 0)


def reported(events):
    return [(code, value) if kind == ABS else (kind, code, value) for kind, code, value, _ in events]


def test_a_contact_begins_moves_and_ends_as_the_kernel_would_tell_it():
    panel = ContactEvents(sized=True)
    assert reported(panel.report([ReportedContact(2, 100, 200, 7)], 1.5)) == [
        (SLOT, 2), (ID, 0), (MAJOR, 7), (X, 100), (Y, 200), (KEY, TOUCH, 1), REPORT,
    ]  # fmt: skip
    assert reported(panel.report([ReportedContact(2, 100, 201, 7)], 1.6)) == [(Y, 201), REPORT]
    assert panel.report([ReportedContact(2, 100, 201, 7)], 1.7) == []
    events = panel.report([], 1.8)
    assert reported(events) == [(ID, -1), (KEY, TOUCH, 0), REPORT]
    assert {event[3] for event in events} == {1.8}


def test_another_contact_of_the_same_number_has_another_tracking_id_and_its_slot_keeps_the_place():
    panel = ContactEvents(sized=True)
    panel.report([ReportedContact(0, 5, 6)], 0.0)
    panel.report([], 0.1)
    assert reported(panel.report([ReportedContact(0, 5, 6)], 0.2)) == [(ID, 1), (KEY, TOUCH, 1), REPORT]


def test_slots_are_named_when_they_change():
    panel = ContactEvents(sized=True)
    panel.report([ReportedContact(0, 1, 1), ReportedContact(1, 2, 2)], 0.0)
    both = [ReportedContact(0, 1, 9), ReportedContact(1, 2, 9)]
    assert reported(panel.report(both, 0.1)) == [(SLOT, 0), (Y, 9), (SLOT, 1), (Y, 9), REPORT]
    assert reported(panel.report([ReportedContact(1, 2, 9)], 0.2)) == [(SLOT, 0), (ID, -1), REPORT]
    assert panel.down == 1


def test_tracking_ids_begin_again_after_the_last_one():
    panel = ContactEvents(sized=True)
    ids = []
    for _ in range(65537):
        ids.append(panel.report([ReportedContact(0, 1, 1)], 0.0)[1 if not ids else 0][2])
        panel.report([], 0.0)
    assert ids[-2:] == [65535, 0]


def test_the_description_is_that_of_a_panel_with_ten_slots():
    panel = describe("chip", 3, 799, 479, sized=True)
    assert protocol_of_device(panel.axes) is Protocol.B
    ranges = {SLOT: (0, MAX_CONTACTS - 1), ID: (0, 65535), X: (0, 799), Y: (0, 479), MAJOR: (0, 65535)}
    assert {code: (axis.minimum, axis.maximum) for code, axis in panel.axes.items()} == ranges
    assert (panel.name, panel.bus, panel.vendor, panel.product, panel.version) == ("chip", 0x18, 0, 0, 3)
    assert (MAJOR in panel.axes) != (MAJOR in describe("chip", 3, 799, 479, sized=False).axes)
    assert set(panel.codes[ABS]) == set(panel.axes)


jitter = st.integers(0, 10)  # of a contact from report to report, in tenths of a millimetre: a hand goes no farther
contacts = st.builds(
    lambda number, x, y, size: ReportedContact(number, 210 * number + x, 147 * number + y, size),
    st.integers(0, MAX_CONTACTS - 1),
    jitter,
    jitter,
    st.integers(0, 90),
)


@given(st.lists(st.lists(contacts, max_size=MAX_CONTACTS, unique_by=lambda contact: contact.number), max_size=20))
def test_a_decoder_sees_exactly_the_contacts_of_each_report(reports):
    board = load_board(data_folder("boards") / "simulated")
    decoder = Decoder(PanelAxes(board, AxisRange(0, 2100), AxisRange(0, 1480)), Protocol.B)
    panel = ContactEvents(sized=True)
    for listed in reports:
        events = panel.report(listed, 0.0)
        assert len(events) <= 5 * MAX_CONTACTS + 2  # a list of at most 512 bytes
        for kind, code, value, time_s in events:
            decoder.feed(kind, code, value, time_s)
        places = sorted((round(x_m * 1e4), round(y_m * 1e4)) for _, x_m, y_m in decoder.fingers())
        assert places == sorted((contact.x, contact.y) for contact in listed)
        assert panel.down == len(listed)
    assert not decoder.warnings


def test_a_number_beyond_the_slots_is_the_callers_mistake():
    with pytest.raises(IndexError):
        ContactEvents(sized=True).report([ReportedContact(MAX_CONTACTS, 1, 1)], 0.0)


def test_a_panel_that_tells_no_extents_has_none():
    events = ContactEvents(sized=False).report([ReportedContact(0, 1, 1)], 0.0)
    assert MAJOR not in {code for _, code, _, _ in events}
    assert (MAJOR, 0) in reported(ContactEvents(sized=True).report([ReportedContact(0, 1, 1)], 0.0))

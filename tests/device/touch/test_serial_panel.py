"""The driver at one end of a pseudo-terminal, an Elo panel from its manual at the other."""

import os

import pytest
from hypothesis import given
from hypothesis import strategies as st
from peers.elo_panel import INITIAL, STREAM, UNTOUCH, packet, touch

from controller.device.touch.live_source import LiveSource
from controller.device.touch.panels.serial_panel import (
    MAX_COORDINATE,
    RETRY_S,
    STUCK_TIMEOUT_S,
    EloTouch,
    SerialPanel,
    SmartSetParser,
)
from controller.device.touch.reports import FAULTS
from controller.errors import TouchError


def settings(device):
    return EloTouch(device=device, x_mm_from_axes=(210.0, 0.0, 0.0), y_mm_from_axes=(0.0, 148.0, 0.0))


class Port:
    """A port that can be unplugged and plugged in again under the same name."""

    def __init__(self, folder):
        self._link = folder / "panel"
        self.name = str(self._link)
        self.plug_in()

    def plug_in(self):
        self.far_end, self._near_end = os.openpty()
        self._link.symlink_to(os.ttyname(self._near_end))

    def unplug(self):
        self._link.unlink()
        os.close(self.far_end)
        os.close(self._near_end)

    def send(self, data):
        os.write(self.far_end, data)


@pytest.fixture
def port(tmp_path):
    return Port(tmp_path)


@pytest.fixture
def source(port, board):
    opened = LiveSource(SerialPanel(settings(port.name)), board)
    yield opened
    opened.close()


def samples(source, now_s):
    """Everything there is at this time, as (finger, x in mm, y in mm, contact)."""
    found = [*source.read(now_s)]
    while (next_s := source.next_time_s()) is not None and next_s <= now_s:
        found += source.read(now_s)
    return [(s.finger, round(s.x_m * 1e3, 1), round(s.y_m * 1e3, 1), s.contact) for s in found]


def test_a_finger_comes_moves_and_goes(port, source):
    assert source.fileno() is not None
    assert samples(source, 1.0) == []
    port.send(touch(0, MAX_COORDINATE, INITIAL) + touch(39, MAX_COORDINATE, STREAM))
    assert samples(source, 1.1) == [(0, 0, 148, True), (0, 2, 148, True)]
    port.send(touch(39, MAX_COORDINATE, UNTOUCH) + touch(MAX_COORDINATE, 0, INITIAL) + touch(MAX_COORDINATE, 0, UNTOUCH))
    assert samples(source, 1.2) == [(0, 2, 148, False), (1, 210, 0, True), (1, 210, 0, False)]
    assert source.next_time_s() is None
    assert not source.warnings


def test_one_call_gives_one_report_and_a_packet_may_come_in_pieces(port, source):
    port.send(touch(1, 1, INITIAL) + touch(2, 2) + touch(3, 3)[:4])
    assert len(source.read(0.0)) == 1
    assert source.next_time_s() == 0.0
    assert len(source.read(0.0)) == 1
    assert source.read(0.0) == ()
    port.send(touch(3, 3)[4:])
    assert len(source.read(0.1)) == 1


def test_packets_that_are_no_touches_are_passed_over(port, source):
    port.send(packet("I", 1, 2, 3) + packet("A") + touch(1, 1, INITIAL) + packet("A"))
    assert [s[3] for s in samples(source, 0.0)] == [True]
    assert not source.warnings


def test_after_garbage_it_is_in_step_again(port, source):
    damaged = bytearray(touch(9, 9))
    damaged[4] ^= 1
    port.send(b"noise U" + touch(1, 1, INITIAL) + damaged + b"UUU" + touch(2, 2))
    assert len(samples(source, 0.0)) == 2
    assert source.warnings == {"bytes_skipped": 7 + 10 + 3}


def test_a_finger_whose_going_was_lost_does_not_stay(port, source):
    port.send(touch(1, 1, INITIAL))
    samples(source, 1.0)
    assert source.next_time_s() == 1.0 + STUCK_TIMEOUT_S
    assert samples(source, 1.0 + STUCK_TIMEOUT_S - 0.01) == []
    assert [s[3] for s in samples(source, 1.0 + STUCK_TIMEOUT_S)] == [False]
    assert source.warnings == {"contact_stuck": 1}
    port.send(touch(1, 1, STREAM))
    assert [(s[0], s[3]) for s in samples(source, 2.0)] == [(1, True)]


def test_a_port_that_goes_lifts_the_finger_and_one_that_comes_back_is_opened(port, source):
    port.send(touch(1, 1, INITIAL))
    assert len(samples(source, 1.0)) == 1
    port.unplug()
    assert [(s[0], s[3]) for s in samples(source, 1.1)] == [(0, False)]
    assert source.fileno() is None
    assert not source.present
    assert source.next_time_s() == pytest.approx(1.1 + RETRY_S)
    assert samples(source, 1.1 + RETRY_S) == []
    port.plug_in()
    assert samples(source, 1.2 + RETRY_S) == []  # too early
    assert not source.present
    assert samples(source, 1.2 + 2 * RETRY_S) == []
    assert source.present
    port.send(touch(1, 1, INITIAL))
    assert [(s[0], s[3]) for s in samples(source, 3.0)] == [(1, True)]
    assert source.warnings == {"panel_lost": 1}
    assert source.counts.contacts == 2


def test_half_a_packet_from_before_a_loss_is_forgotten(port, source):
    port.send(touch(1, 1, INITIAL)[:7])
    samples(source, 1.0)
    port.unplug()
    samples(source, 1.1)
    port.plug_in()
    samples(source, 2.0)
    port.send(touch(5, 5, INITIAL))
    assert len(samples(source, 2.1)) == 1
    assert source.warnings == {"panel_lost": 1}


@pytest.mark.parametrize(("device", "words"), [("/dev/absent", "no serial port"), ("/dev/null", "could not be opened|not be")])
def test_a_port_that_cannot_be_opened_is_named(device, words):
    with pytest.raises(TouchError, match=words) as caught:
        SerialPanel(settings(device))
    assert device in str(caught.value)


@given(st.lists(st.one_of(st.binary(max_size=25), st.builds(touch, st.integers(0, 4095), st.integers(0, 4095))), max_size=12))
def test_packets_are_found_however_the_bytes_are_cut(pieces):
    whole, cut = SmartSetParser(), SmartSetParser()
    stream = b"".join(pieces)
    whole.feed(stream)
    found = []
    while (one := whole.next_packet()) is not None:
        found.append(one)
    again = []
    for k in range(len(stream)):
        cut.feed(stream[k : k + 1])
        while (one := cut.next_packet()) is not None:
            again.append(one)
    assert found == again
    assert whole.skipped_bytes == cut.skipped_bytes
    assert 0 <= len(stream) - whole.skipped_bytes - 10 * len(found) < 10


@given(st.binary(max_size=40).filter(lambda noise: b"U" not in noise), st.integers(0, 4095), st.integers(0, 4095))
def test_noise_costs_no_packet_after_it(noise, x, y):
    parser = SmartSetParser()
    parser.feed(noise + touch(x, y))
    assert parser.next_packet() == touch(x, y)
    assert parser.skipped_bytes == len(noise)


def test_a_wrong_checksum_is_noticed():
    parser = SmartSetParser()
    good = touch(100, 200)
    parser.feed(good[:-1] + bytes([good[-1] ^ 0x10]))
    assert parser.next_packet() is None


def test_a_port_with_another_baud_rate_or_protocol_is_said_once_until_a_packet_comes(port, source):
    for k in range(30):
        port.send(b"\x80\x7f\x00\xff\x81" * 2)
        assert samples(source, 1.0 + k) == []
    assert source.warnings == {"bytes_skipped": 300, "no_packets": 1}
    port.send(touch(1, 1, INITIAL))
    assert len(samples(source, 40.0)) == 1
    for k in range(15):
        port.send(b"\x80\x7f\x00\xff\x81" * 2)
        samples(source, 41.0 + k)
    assert source.warnings["no_packets"] == 2
    assert "no_packets" in FAULTS

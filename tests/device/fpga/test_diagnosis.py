"""The diagnosis of an answer that is no status names the wire or setting at fault."""

from hypothesis import given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device.fpga import frames
from controller.device.fpga.diagnosis import BITS, diagnose
from controller.device.fpga.frames import FRAME_BYTES
from controller.device.fpga.registers import Fault, Result, State
from controller.device.fpga.status import Status, pack_status

SENT = bytearray(FRAME_BYTES)
frames.pack_nop(SENT, 0, 77)
NUMBERS = st.integers(0, (1 << 32) - 1)
STATUSES = st.builds(
    Status,
    st.just(Result.OK),
    st.integers(0, 255),
    st.sampled_from([State.ARMED, State.HEARTBEAT | State.RUN_PERMIT]),
    st.just(Fault(0)),
    NUMBERS,
    NUMBERS,
    st.integers(0, (1 << 64) - 1),
    NUMBERS,
    st.integers(0, 8),
    st.integers(0, 255),
    st.integers(0, 65535),
)


def packed(status):
    answer = bytearray(FRAME_BYTES)
    pack_status(answer, 0, status)
    return bytes(answer)


def wire(value):
    return (value & (1 << BITS) - 1).to_bytes(FRAME_BYTES, "big")


def reported(answer):
    return diagnose(answer, bytes(SENT))


def test_a_stuck_line_is_identified_by_its_level():
    assert "only zeros came back" in reported(bytes(FRAME_BYTES))
    assert "only ones came back" in reported(b"\xff" * FRAME_BYTES)


@given(shift=st.integers(0, 16), late=st.booleans())
def test_an_echo_of_the_sent_bytes_means_that_the_data_wires_are_joined(shift, late):
    bits = int.from_bytes(SENT, "big")
    assert "our own bytes came back" in reported(wire(bits >> shift if late else bits << shift))


def test_a_frame_of_zeros_is_not_reported_as_an_echo():
    assert "only zeros" in diagnose(bytes(36), bytes(36))


@given(STATUSES, st.integers(1, 16), st.integers(0, 1))
def test_a_late_status_is_found_at_its_shift(status, shift, level):
    late = int.from_bytes(packed(status), "big") >> shift
    if level:  # the line waits high
        late |= ((1 << shift) - 1) << BITS - shift
    assert f"came {shift} bit{'s' * (shift > 1)} late" in reported(wire(late))


@given(STATUSES, st.integers(1, 16))
def test_an_early_status_is_found_at_its_shift(status, shift):
    assert f"came {shift} bit{'s' * (shift > 1)} early" in reported(wire(int.from_bytes(packed(status), "big") << shift))


@given(st.integers(1, 8), st.binary(min_size=FRAME_BYTES - 2, max_size=FRAME_BYTES - 2))
def test_a_sync_word_alone_at_some_shift_is_no_shifted_status(shift, rest):
    answer = reported(wire(int.from_bytes(b"\xa5\x5a" + rest, "big") >> shift))
    assert " late:" not in answer
    assert " early:" not in answer


@settings(max_examples=20)
@given(STATUSES, st.integers(16, 250))
def test_a_clock_too_many_or_too_few_is_ringing(status, place):
    bits = int.from_bytes(packed(status), "big")
    low = BITS - place
    head, tail = bits >> low, bits & (1 << low) - 1
    twice = head << low | ((tail >> low - 1) << low - 1) | tail >> 1
    lost = head << low | (tail << 1 & (1 << low) - 1)
    assert "came twice: SCK rings" in reported(wire(twice))
    assert "did not come: SCK rings" in reported(wire(lost))


@settings(max_examples=20)
@given(STATUSES)
def test_inverted_and_mirrored_answers_are_named(status):
    answer = packed(status)
    assert "inverted" in reported(bytes(byte ^ 0xFF for byte in answer))
    assert "last bit first" in reported(bytes(int(f"{byte:08b}"[::-1], 2) for byte in answer))


@settings(max_examples=20)
@given(STATUSES, st.lists(st.integers(16, BITS - 1), min_size=2, max_size=20, unique=True))
def test_damaged_bits_are_damage_and_no_shift(status, places):
    bits = int.from_bytes(packed(status), "big")
    for place in places:
        bits ^= 1 << BITS - 1 - place
    answer = reported(wire(bits))
    assert "damaged on its way" in answer or "SCK rings" in answer  # runs of flips can be a slip in truth
    assert " late" not in answer
    assert " early" not in answer


@given(st.binary(min_size=FRAME_BYTES, max_size=FRAME_BYTES))
def test_noise_is_never_taken_for_a_status(noise):
    assert not any(said in reported(noise) for said in (" late:", " early:", "inverted", "last bit", "SCK rings", "whole"))


def test_another_device_is_reported_with_its_first_bytes():
    assert "begins with 12 34 56 78" in reported(b"\x12\x34\x56\x78" * 9)


@each_row("place", [0, 8, 15])
def test_a_wrong_sync_word_alone_is_no_status(place):
    answer = int.from_bytes(packed(Status(Result.OK, 1, State(0), Fault(0), 0, 0, 0, 0)), "big")
    assert "no status" in reported(wire(answer ^ 1 << BITS - 1 - place))

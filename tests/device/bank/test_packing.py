import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tables import each_row

from controller.device.bank.packing import CHANNELS, SCALE_BITS, channel_bits, drive_words, edges, quantise

levels = st.one_of(st.sampled_from([0.0, -0.0, 2.0**-149, -(2.0**-149)]), st.floats(-1, 1, width=32))
responses = arrays(np.float32, st.tuples(st.integers(1, 40), st.just(CHANNELS)), elements=levels)
idle_words = st.integers(0, 2**CHANNELS - 1)


def test_channel_q_of_the_first_sample_in_drive_order_is_bit_q_of_the_first_word():
    drive_order = np.full((2, CHANNELS), -1.0)
    drive_order[0, 5] = 0.25
    assert drive_words(drive_order).tolist() == [1 << 5, 0]


def test_words_are_little_endian_in_memory():
    drive_order = np.full((1, CHANNELS), -1)
    drive_order[0, 8] = 1
    assert drive_words(drive_order).tobytes() == b"\x00\x01\x00\x00"


@given(responses, idle_words)
def test_every_bit_is_the_sign_and_an_exact_zero_plays_the_idle_bit(drive_order, idle_word):
    idle = [idle_word >> q & 1 for q in range(CHANNELS)]
    expected = np.where(drive_order == 0, idle, drive_order > 0)
    assert np.array_equal(channel_bits(drive_words(drive_order, idle_word)), expected)


@given(responses, idle_words)
def test_no_other_waveform_reaches_a_larger_sum(drive_order, idle_word):
    drive = channel_bits(drive_words(drive_order, idle_word)) * 2.0 - 1.0
    reached = np.sum(drive * drive_order, dtype=np.float64)
    assert reached == np.sum(np.abs(drive_order), dtype=np.float64)
    weakest = np.unravel_index(np.argmax(np.abs(drive_order)), drive_order.shape)
    if drive_order[weakest] != 0:
        drive[weakest] *= -1  # one wrong bit is noticed
        assert not np.array_equal(channel_bits(drive_words(drive_order, idle_word)), drive > 0)


@given(arrays(np.uint32, st.integers(0, 40)))
def test_packing_and_unpacking_are_inverse(words):
    assert np.array_equal(drive_words(channel_bits(words).astype(np.int8) * 2 - 1), words)


@given(responses)
def test_eight_bits_hold_a_response_to_half_a_step(drive_order):
    step, scale = quantise(drive_order)
    peak = np.abs(drive_order).max()
    assert scale == pytest.approx(peak / 127, rel=2**-12, abs=1e-38)
    assert np.abs(step * np.float64(scale) - drive_order).max() <= 0.5001 * max(scale, peak / 127) + 2e-36  # below that: denormal
    assert np.abs(step).max() <= 127
    assert np.array_equal(step == 0, step * scale == 0)


@given(responses)
def test_a_scale_has_few_bits_and_is_not_below_the_peak(drive_order):
    """Machines whose linear algebra rounds otherwise come to the same one, but for one peak in a thousand."""
    _, scale = quantise(drive_order)
    assert scale == 0 or 127 * scale >= np.abs(drive_order).max()
    mantissa, _ = np.frexp(scale)
    assert mantissa * 2**SCALE_BITS == np.rint(mantissa * 2**SCALE_BITS)


@each_row("bad", [np.zeros(CHANNELS), np.zeros((3, 31)), np.full((3, CHANNELS), np.nan), np.full((1, CHANNELS), np.inf)])
def test_refuses_what_cannot_be_played(bad):
    with pytest.raises(ValueError, match="response"):
        drive_words(bad)
    with pytest.raises(ValueError, match="response"):
        quantise(bad)


@pytest.mark.parametrize("idle_word", [-1, 1 << 32])
def test_refuses_an_idle_word_that_is_not_32_bits(idle_word):
    with pytest.raises(ValueError, match="idle word"):
        drive_words(np.zeros((1, CHANNELS)), idle_word)


@given(st.integers(1, 1200), st.integers(0, 2**32 - 1))
def test_edges_are_the_changes_of_each_channels_level(length, seed):
    words = np.random.default_rng(seed).integers(0, 2**32, length, np.uint32)
    words[::2] &= 0xFFFF_FFF0  # the last channels of every second sample: up to a change each sample
    words[1::2] |= 0xF
    assert edges(words).tolist() == np.abs(np.diff(channel_bits(words).astype(int), axis=0)).sum(axis=0).tolist()


def test_edges_are_counted_for_each_channel():
    words = np.array([0b000, 0b001, 0b011, 0b010, 0b010], "<u4")
    assert edges(words).tolist() == [2, 1] + [0] * 30

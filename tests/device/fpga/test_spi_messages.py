"""spidev messages fit the kernel's buffer, with each frame under its own chip select."""

import ctypes
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.board.devices import divided_hz
from controller.device.fpga.links.spi_messages import DMA_ALIGN_BYTES, TRANSFERS_MAX, SpiMessages, message_request, split
from controller.errors import LinkError

UPLOAD = [512] * 8 + [36] * 4
LENGTHS = st.lists(st.integers(1, 512), min_size=1, max_size=60)


class Transfer(ctypes.Structure):
    """struct spi_ioc_transfer of linux/spi/spidev.h."""

    _fields_ = [
        ("tx_buf", ctypes.c_uint64),
        ("rx_buf", ctypes.c_uint64),
        ("len", ctypes.c_uint32),
        ("speed_hz", ctypes.c_uint32),
        ("delay_usecs", ctypes.c_uint16),
        ("bits_per_word", ctypes.c_uint8),
        ("cs_change", ctypes.c_uint8),
        ("tx_nbits", ctypes.c_uint8),
        ("rx_nbits", ctypes.c_uint8),
        ("word_delay_usecs", ctypes.c_uint8),
        ("pad", ctypes.c_uint8),
    ]


def transfers(array):
    return [Transfer.from_buffer_copy(array, at) for at in range(0, len(array), ctypes.sizeof(Transfer))]


def buffers(size=60 * 512):
    return memoryview(bytearray(size)), memoryview(bytearray(size))


@each_row(
    ("bufsiz", "counts"),
    [(4096, [8, 4]), (8192, [12]), (4608, [12]), (4607, [11, 1]), (512, [1] * 8 + [4])],
)
def test_an_upload_is_split_at_frames_and_with_a_large_buffer_not_at_all(bufsiz, counts):
    assert split(UPLOAD, bufsiz) == counts


@given(LENGTHS, st.integers(512, 70_000))
def test_every_message_fits_and_no_frame_is_lost(lengths, bufsiz):
    counts = split(lengths, bufsiz)
    assert sum(counts) == len(lengths)
    first = 0
    for count in counts:
        piece = lengths[first : first + count]
        assert 1 <= count <= TRANSFERS_MAX
        assert sum(-(-length // DMA_ALIGN_BYTES) * DMA_ALIGN_BYTES for length in piece) <= bufsiz
        first += count


def test_a_buffer_too_small_for_a_frame_says_what_to_do():
    with pytest.raises(LinkError, match=r"options spidev bufsiz=8192.*spidev\.bufsiz=8192"):
        split([36, 512], 511)


@given(LENGTHS)
def test_transfers_point_at_the_frames_and_chip_select_rises_behind_each(lengths):
    sent, received = buffers()
    tx, rx = (ctypes.addressof(ctypes.c_char.from_buffer(view)) for view in (sent, received))
    offset = 0
    for request, array, size in SpiMessages(sent, received, 4096).for_lengths(lengths):
        piece = transfers(array)
        assert request == message_request(len(piece))
        assert sum(one.len for one in piece) == size
        assert [one.cs_change for one in piece] == [1] * (len(piece) - 1) + [0]
        for one in piece:
            assert (one.tx_buf, one.rx_buf, one.len) == (tx + offset, rx + offset, lengths.pop(0))
            assert one.speed_hz == one.delay_usecs == one.bits_per_word == one.tx_nbits == one.rx_nbits == one.word_delay_usecs == 0
            offset += one.len
    assert not lengths


def test_a_pattern_is_made_once_and_their_number_is_bounded():
    messages = SpiMessages(*buffers(), 4096)
    made = messages.for_lengths(UPLOAD)
    assert messages.for_lengths(list(UPLOAD)) is made
    for length in range(1, 513):
        messages.for_lengths([length])
    assert len(messages._known) <= 64


def test_frames_beyond_the_buffer_are_a_mistake_of_the_caller():
    with pytest.raises(ValueError, match="frames of 72 bytes"):
        SpiMessages(*buffers(71), 4096).for_lengths([36, 36])


def test_the_ioctl_has_the_kernels_number():
    assert message_request(1) == 0x40206B00  # SPI_IOC_MESSAGE(1), as strace prints it
    assert message_request(12) == 0x41806B00
    assert struct.calcsize("@QQIIHBBBBBB") == ctypes.sizeof(Transfer) == 32


@each_row(
    ("source_hz", "asked_hz", "sck_hz"),
    [
        (500_000_000, 25_000_000, 25e6),
        (500_000_000, 30_000_000, 500e6 / 18),  # Pi 4
        (400_000_000, 25_000_000, 25e6),
        (200_000_000, 30_000_000, 25e6),  # Pi 5
        (200_000_000, 150_000_000, 100e6),
        (500_000_000, 1_000, 500e6 / 65536),
    ],
)
def test_sck_is_the_controllers_clock_by_an_even_divider_and_never_above_what_was_asked(source_hz, asked_hz, sck_hz):
    assert divided_hz(source_hz, asked_hz) == sck_hz

"""Drive words and quantised responses, of which a bank entry consists.

Word n is sample n of an emission and bit q of it is channel q, little-endian, so the FPGA plays an
entry word by word and a memoryview of the bank goes to the wire as it is. The words of several FPGAs
have a column for each, (sample, FPGA); an entry is of one.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Bools, Indices, Reals
from controller.device.board.panel import CHANNELS

__all__ = ["CHANNELS", "WORD", "as_words", "channel_bits", "drive_words", "edges", "framed", "quantise"]

WORD = np.dtype("<u4")
SCALE_BITS = 13  # a response is stored 1/8192 coarser at most


def drive_words(drive_order: NDArray[np.number[Any]], idle_word: int = 0) -> NDArray[np.uint32]:
    """Pack the sign of a response that is already in drive order (reversed in time).

    Among all waveforms of two levels this one gives the response its largest value at the
    end of the emission: every sample adds `|response|` (paper, section III-A).

    `drive_order` (sample, channel), in any unit, has the sample played first first. Above zero plays high, below zero low; exactly
    zero gains nothing, so the channel stays at its idle bit: no edge, no energy. Returns the words, (sample,), first played first;
    of several FPGAs (sample, FPGA). Raises ValueError if `drive_order` is not finite or not (sample, 32 for each FPGA), or
    `idle_word` has more bits.
    """
    _check(drive_order)
    if not 0 <= idle_word < 1 << drive_order.shape[1]:
        raise ValueError(f"idle word {idle_word:#x} is not {drive_order.shape[1]} bits")
    words = _pack(drive_order > 0)
    if idle_word:
        words |= _pack(drive_order >= 0) & as_words(idle_word, words)
    return words


def _pack(bits: Bools) -> NDArray[np.uint32]:
    words = np.packbits(bits, axis=1, bitorder="little").view(WORD)
    return words[:, 0] if words.shape[1] == 1 else words


def _check(drive_order: NDArray[np.number[Any]]) -> None:
    if drive_order.ndim != 2 or not drive_order.shape[1] or drive_order.shape[1] % CHANNELS:
        raise ValueError(f"response is {drive_order.shape}, not (sample, {CHANNELS})")
    if not np.isfinite(drive_order).all():
        raise ValueError("response has values that are not finite")


def channel_bits(words: NDArray[np.uint32]) -> NDArray[np.uint8]:
    """Unpack drive words into (sample, channel) zeros and ones; inverse of the packing."""
    as_bytes = np.ascontiguousarray(words, WORD).view(np.uint8).reshape(len(words), WORD.itemsize * math.prod(words.shape[1:]))
    return np.unpackbits(as_bytes, axis=1, bitorder="little")


def as_words(word: int, like: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """A word of all channels, bit q is channel q, as drive words of one sample, of as many FPGAs as `like` is."""
    row = np.frombuffer(word.to_bytes(WORD.itemsize * math.prod(like.shape[1:]), "little"), WORD)
    return row.reshape(1, *like.shape[1:])


def framed(before: int, words: NDArray[np.uint32], after: int) -> NDArray[np.uint32]:
    """Drive words with one before and one behind."""
    return np.concatenate([as_words(before, words), words, as_words(after, words)])


def edges(words: NDArray[np.uint32]) -> Indices:
    """Edges (changes of level) of each channel, (channel,), from the first to the last of drive words, (sample,)."""
    bits = channel_bits(words[1:] ^ words[:-1])
    if not len(bits):
        return np.zeros(bits.shape[1], np.intp)
    eight_channels = np.add.reduceat(bits.view("<u8"), np.arange(0, len(bits), 255), axis=0)  # no byte carries into the next
    counts: Indices = eight_channels.view(np.uint8).sum(axis=0, dtype=np.intp)
    return counts


def quantise(drive_order: Reals) -> tuple[NDArray[np.int8], float]:
    """Round a response in m per V to 8 bits: `drive_order` is about `levels * scale`, to half a scale.

    Returns the levels (sample, channel), -127 to 127, and the scale: `max|drive_order| / 127`, rounded up to `SCALE_BITS`
    significant bits: the last bits of `drive_order` depend on the machine's linear algebra, and hardly ever show in it; 0 for a
    response that is zero throughout. Raises ValueError if `drive_order` is not finite or not (sample, 32).
    """
    _check(drive_order)
    mantissa, exponent = math.frexp(max(drive_order.max(initial=0.0), -drive_order.min(initial=0.0)) / 127)
    scale = np.float32(math.ldexp(math.ceil(math.ldexp(mantissa, SCALE_BITS)), exponent - SCALE_BITS))
    if scale < np.finfo(np.float32).tiny:
        return np.zeros(drive_order.shape, np.int8), 0.0
    return np.rint(drive_order * np.float32(1 / scale)).astype(np.int8), float(scale)

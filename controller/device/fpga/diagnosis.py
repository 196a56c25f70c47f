"""Diagnosis of an answer that is no status: which wire or setting is wrong, and what to do.

Bits are numbered in the order on the wire, most significant bit of each byte first.
"""

from __future__ import annotations

import zlib

from controller.device.fpga.frames import FRAME_BYTES as STATUS_BYTES
from controller.device.fpga.registers import STATUS_SYNC

BODY_BITS = 8 * (STATUS_BYTES - 4)
BITS = 8 * STATUS_BYTES
SYNC = STATUS_SYNC.to_bytes(2, "little")
SHIFTS = range(1, 17)  # bits by which an answer may be shifted
ONES_PER_WRONG_BIT = 12  # in our own frame: one damaged bit is tolerated for this many
ONES_MIN = 12  # in our own frame: with fewer it resembles other answers too much

LATE = (
    "one bit late or more means that MISO is sampled too early: another SPI mode than 0, a long cable, or SCK too fast;"
    " check the mode, then lower link.sck_hz"
)
EARLY = "bits are lost at the start: an SPI mode other than 0, or ringing on SCK or chip select; check the mode, shorten the wires"


def diagnose(received: bytes, sent: bytes) -> str:
    """Explain in one line why the answer to one frame is no valid status: what came back, the likely cause, what to do."""
    answer, frame = bytes(received[:STATUS_BYTES]), bytes(sent[:STATUS_BYTES])
    if not answer.strip(b"\0"):
        return "only zeros came back: is the FPGA powered and configured, is MISO wired, or is it held low?"
    if not answer.strip(b"\xff"):
        return "only ones came back: is the FPGA powered and loaded (gateware load), is MISO wired? An open line is pulled up"
    if _valid(answer):
        return "the status is whole: it was damaged when it was first looked at"
    if (echo := _own_bytes(answer, frame)) is not None:
        return f"our own bytes came back{echo}: MOSI and MISO are joined, or swapped; cross-check both wires at the FPGA"
    if _valid(bytes(byte ^ 0xFF for byte in answer)):
        return "every bit came back inverted: there is an inverting buffer in MISO, or its two wires are swapped"
    if _valid(bytes(_mirrored(byte) for byte in answer)):
        return "each byte came back with its last bit first: the controller sends the least significant bit first"
    for shift in SHIFTS:
        if _late(answer, shift):
            return f"the status came {_bits(shift)} late: {LATE}"
        if _early(answer, shift):
            return f"the status came {_bits(shift)} early: {EARLY}"
    if slip := _slip(answer):
        return f"{slip}: SCK rings or has glitches; shorten its wire, add a series resistor of 33 to 100 ohm at its source"
    if answer.startswith(SYNC):
        return "the status was damaged on its way: its CRC does not match; try a lower link.sck_hz, join the grounds"
    return (
        f"what came back begins with {answer[:4].hex(' ')} and not with {SYNC.hex(' ')}: it is no status;"
        " is this the panel's chip select, is the right gateware loaded?"
    )


def _bits(number: int) -> str:
    return f"{number} bit{'s' * (number != 1)}"


def _valid(answer: bytes) -> bool:
    return answer.startswith(SYNC) and _crc_matches(int.from_bytes(answer, "big"), 0)


def _crc_matches(bits: int, unknown: int) -> bool:
    """Whether the CRC of a status matches its body, ignoring its last `unknown` bits, which were not received."""
    body = (bits >> 32).to_bytes(BODY_BITS // 8, "big")
    wanted = int.from_bytes(zlib.crc32(body).to_bytes(4, "little"), "big")
    return (wanted ^ bits) & 0xFFFFFFFF < 1 << unknown


def _own_bytes(answer: bytes, frame: bytes) -> str | None:
    """By how many bits our own frame came back shifted, with at most a few bits damaged; None if it did not come back."""
    theirs, ours = int.from_bytes(answer, "big"), int.from_bytes(frame, "big")
    for shift in (0, *SHIFTS):
        for when, a, b in (("late", theirs, ours >> shift), ("early", theirs >> shift, ours)):
            wrong = (a ^ b) & (1 << BITS - shift) - 1  # the first bits are from before the frame
            if wrong.bit_count() <= b.bit_count() // ONES_PER_WRONG_BIT and b.bit_count() >= ONES_MIN:
                return f", {_bits(shift)} {when}" if shift else ""
    return None


def _late(answer: bytes, shift: int) -> bool:
    moved = int.from_bytes(answer, "big") << shift & (1 << BITS) - 1
    return moved.to_bytes(STATUS_BYTES, "big").startswith(SYNC) and _crc_matches(moved, shift)


def _early(answer: bytes, shift: int) -> bool:
    first = int.from_bytes(SYNC, "big") >> 16 - shift  # the bits that were lost
    moved = first << BITS - shift | int.from_bytes(answer, "big") >> shift
    return moved.to_bytes(STATUS_BYTES, "big").startswith(SYNC) and _crc_matches(moved, 0)


def _slip(answer: bytes) -> str:
    """Which bit was received twice or not at all, if everything else is right; else empty."""
    if not answer.startswith(SYNC):
        return ""
    bits = int.from_bytes(answer, "big")
    for place in range(16, BITS):
        low = BITS - place  # bits after the place
        head, tail = bits >> low, bits & (1 << low) - 1
        once = head << low | (tail << 1 & (1 << low) - 1)
        if _crc_matches(once, 1):
            return f"bit {place} of the status came twice"
        for bit in (0, 1):
            if _crc_matches(head << low | bit << low - 1 | tail >> 1, 0):
                return f"bit {place} of the status did not come"
    return ""


def _mirrored(byte: int) -> int:
    return int(f"{byte:08b}"[::-1], 2)

"""An Elo SmartSet controller from its reference manual: the bytes it sends. Needs nothing of the project."""

INITIAL, STREAM, UNTOUCH = 0x01, 0x02, 0x04


def packet(letter, *content):
    """Lead-in, letter, seven bytes, and the checksum: 0xAA and all bytes before it, modulo 256."""
    body = bytes([0x55, ord(letter), *content, *[0] * (7 - len(content))])
    return body + bytes([(0xAA + sum(body)) & 0xFF])


def touch(x, y, status=STREAM, z=255):
    """One touch packet; z is valid if bit 7 of the status is set."""
    return packet("T", status | 0x80, x & 0xFF, x >> 8, y & 0xFF, y >> 8, z & 0xFF, z >> 8)

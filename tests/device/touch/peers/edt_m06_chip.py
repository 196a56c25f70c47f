"""A module of EDT with M06 firmware, as the kernel's edt-ft5x06.c speaks with it. Needs nothing of the project.

No register map: the first byte written is a command. 0xBB: its name, with a byte before it. 0xF9: a report of 26 bytes, two
0xAA, its length, then five points of four bytes (event flag and x, number and y) from byte 5 on, and the exclusive or of all.
The place of a contact that was just put down is not true.
"""

from peers.i2c_chip import READ, NotAcknowledged, RegisterChip

PUT_DOWN, LIFTED, CONTACT, RESERVED = 0, 1, 2, 3
NAME, REPORT = 0xBB, 0xF9
POINTS = 5


class EdtM06Chip(RegisterChip):
    """`damaged`: this many of the next reports have a wrong checksum; `headless`: a wrong header."""

    def __init__(self, address=0x38, name=b"EP0570M06*A1.0$"):
        super().__init__(address)
        self.name = name
        self.held = {}
        self.points = []
        self.damaged = 0
        self.headless = 0
        self.answer = b""
        self.pulses = 0

    def touch(self, held):
        """One scan found these contacts, number -> (x, y)."""
        lifted = [(LIFTED, number, *place) for number, place in self.held.items() if number not in held]
        down = [(CONTACT, number, *held[number]) if number in self.held else (PUT_DOWN, number, 0xABC, 0xDEF) for number in held]
        self.points = (down + lifted)[:POINTS]
        self.held = dict(held)
        self.pulses += 1

    def read_register(self, register):
        return self.answer[register]

    def report(self):
        """Answer to 0xF9."""
        points = self.points + [(RESERVED, 15, 0xFFF, 0xFFF)] * (POINTS - len(self.points))
        report = bytes([0xAB if self.headless else 0xAA, 0xAA, 26, len(self.points), 0])
        for flag, number, x, y in points:
            report += bytes([flag << 6 | x >> 8, x & 0xFF, number << 4 | y >> 8, y & 0xFF])
        check = bool(self.damaged)
        for byte in report:
            check ^= byte
        self.damaged, self.headless = max(self.damaged - 1, 0), max(self.headless - 1, 0)
        return report + bytes([check])

    def transfer(self, messages):
        asked = []
        for address, flags, content in messages:
            if address == self.address and not flags & READ:
                (command,) = content
                if command not in (NAME, REPORT):
                    raise NotAcknowledged
                self.answer = b"\x16" + self.name + bytes(32) if command == NAME else self.report()
            asked.append((address, flags, content if flags & READ else b"\0"))
        return super().transfer(asked)

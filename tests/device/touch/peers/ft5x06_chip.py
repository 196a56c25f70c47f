"""A FocalTech FT5x06 from its data sheet (D-FT5x06-1212) and the FT6x36 application note. Needs nothing of the project.

Reports are in registers 0x02 on: TD_STATUS, then six bytes a point: event flag (bits 7:6) and x, number and y, weight,
area. In trigger mode (0xA4 = 1) the interrupt pin pulses low for each report; in polling mode it is low while touched.
"""

from peers.i2c_chip import RegisterChip

PUT_DOWN, LIFTED, CONTACT = 0, 1, 2


class Ft5x06Chip(RegisterChip):
    """`points` are the most it reports: 2 of an FT6x36, 5 of an FT5x06, 10 of an FT5x26 and FT5406."""

    def __init__(self, address=0x38, points=10, chip_id=0x55):
        super().__init__(address)
        self.points = points
        self.held = {}  # number -> (x, y)
        self.ghosts = 0  # points at (0, 0) listed with every report
        self.chip_id = chip_id
        self.pulses = 0
        self.power_up()

    def power_up(self):
        """What is in the registers after power or a reset; the points of before stay until the first scan."""
        self.registers[0x00] = 0
        self.registers[0xA3] = self.chip_id
        self.registers[0xA4] = 0
        self.registers[0xA6] = 0x0A
        self.registers[0xA8] = 0x79

    def touch(self, held, put_down=()):
        """One scan found these contacts, number -> (x, y); those that are gone are listed once more, as lifted."""
        lifted = [number for number in self.held if number not in held]
        listed = [
            (PUT_DOWN if number in put_down or number not in self.held else CONTACT, number, *place)
            for number, place in held.items()
        ]
        listed += [(PUT_DOWN, 0, 0, 0)] * self.ghosts
        points = (listed + [(LIFTED, number, *self.held[number]) for number in lifted])[: self.points]
        self.registers[0x02] = min(len(listed), self.points)
        for k in range(self.points):
            flag, number, x, y = points[k] if k < len(points) else (3, 15, 0xFFF, 0xFFF)
            place = bytes([flag << 6 | x >> 8, x & 0xFF, number << 4 | y >> 8, y & 0xFF, 0, 0])
            self.registers[3 + 6 * k : 9 + 6 * k] = place
        self.held = dict(held)
        if self.registers[0xA4] == 1:
            self.pulses += 1
        self.interrupt = self.registers[0xA4] == 1 or not held

"""A Goodix GT911 from its programming guide. Needs nothing of the project.

16-bit registers, high byte first. The address is 0x14 or 0x5D by the level of the interrupt pin when the reset pin
rises. A report is ready when bit 7 of 0x814E is set; the chip makes no other until the host has written 0 there.
"""

from peers.i2c_chip import NotAcknowledged, RegisterChip

STATUS = 0x814E


class Gt911Chip(RegisterChip):
    """`width`, `height`, `contacts`, `trigger` (0 rising, 1 falling): its configuration from 0x8047 on."""

    address_bytes = 2

    def __init__(self, width=800, height=480, contacts=5, trigger=1, product=b"911\0"):
        super().__init__(0x5D)
        self.configuration = bytes([0x41, width & 0xFF, width >> 8, height & 0xFF, height >> 8, contacts, 0x3C | trigger])
        self.product = product
        self.trigger = trigger
        self.in_reset = False
        self.late = 0  # reads of the status, after a report, that still find it not ready
        self.lost_reports = 0
        self.clears = 0
        self.pulses = 0
        self.power_up()

    def power_up(self):
        self.registers[:] = bytes(len(self.registers))
        self.registers[0x8047 : 0x8047 + len(self.configuration)] = self.configuration
        self.registers[0x8140:0x8144] = self.product
        self.registers[0x8144:0x8146] = b"\x60\x10"

    def pins(self, reset, interrupt):
        """Levels that the host drives: a rising reset takes the address from the interrupt pin."""
        if self.in_reset and reset:
            self.address = 0x14 if interrupt else 0x5D
            self.power_up()
        self.in_reset = not reset

    def transfer(self, messages):
        if self.in_reset:
            raise NotAcknowledged
        return super().transfer(messages)

    def touch(self, held, size=20, status=None):
        """One scan found these contacts, number -> (x, y); False if the last report was not fetched yet."""
        if self.registers[STATUS] & 0x80:
            self.lost_reports += 1
            return False
        for k, (number, (x, y)) in enumerate(held.items()):
            point = bytes([number, x & 0xFF, x >> 8, y & 0xFF, y >> 8, size & 0xFF, size >> 8, 0])
            self.registers[STATUS + 1 + 8 * k : STATUS + 9 + 8 * k] = point
        self.registers[STATUS] = (0x80 | len(held)) if status is None else status
        self.pulses += 1
        return True

    def read_register(self, register):
        if register == STATUS and self.late:
            self.late -= 1
            return self.registers[STATUS] & 0x7F
        return super().read_register(register)

    def write_register(self, register, value):
        super().write_register(register, value)
        if register == STATUS and value == 0:
            self.clears += 1

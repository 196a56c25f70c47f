"""The far end of an I2C bus: what its messages do to a chip. Needs nothing of the project.

A chip is a `RegisterChip`: bytes written, bytes read, the level of its interrupt pin.
"""

READ = 0x0001  # I2C_M_RD


class NotAcknowledged(Exception):
    """Nobody answers at this address, or the chip is busy."""


class BusHangs(Exception):
    """The chip holds the clock low for ever."""


class RegisterChip:
    """Registers behind an address of `address_bytes` bytes, which goes on by itself as they are read or written.

    Faults, for tests: `nacks` (that many of the next messages are not acknowledged), `silent` (none is), `hangs` (the
    next transfer never ends), `garbage` (reads give this byte).
    """

    address_bytes = 1

    def __init__(self, address):
        self.address = address
        self.registers = bytearray(1 << 8 * self.address_bytes)
        self.pointer = 0
        self.interrupt = True
        self.nacks = 0
        self.silent = False
        self.hangs = False
        self.garbage = None
        self.transfers = 0

    def transfer(self, messages):
        """Do `(address, flags, length or bytes)` messages of one transfer; the bytes that were read."""
        read = b""
        self.transfers += 1
        for address, flags, content in messages:
            if self.hangs:
                self.hangs = False
                raise BusHangs
            if self.silent or address != self.address:
                raise NotAcknowledged
            if self.nacks:
                self.nacks -= 1
                raise NotAcknowledged
            if flags & READ:
                data = bytes(self.read_register(self.pointer + k) for k in range(content))
                self.pointer += content
                read += data if self.garbage is None else bytes([self.garbage]) * content
            else:
                self.pointer = int.from_bytes(content[: self.address_bytes], "big")
                for value in content[self.address_bytes :]:
                    self.write_register(self.pointer, value)
                    self.pointer += 1
        return read

    def read_register(self, register):
        return self.registers[register % len(self.registers)]

    def write_register(self, register, value):
        self.registers[register % len(self.registers)] = value

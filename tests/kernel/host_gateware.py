"""The compiled Verilog, or a whole board, computed here for a guest, 25 times slower there: a virtual serial port between them.

The guest's clock stands still meanwhile: for it the answer takes no time, however busy this machine is. The guest itself stops it
as soon as it has asked, by QEMU's device for a guest that panics, so no time passes until the host sees that it is asked.

usage: host_gateware.py SOCKET MONITOR     serves whoever is at the far end of QEMU's virtio-serial, until that is gone;
                                           MONITOR is QEMU's socket for its machine protocol (QMP)
"""

import contextlib
import copy
import json
import multiprocessing.connection
import os
import socket
import sys
import time
from functools import cache
from pathlib import Path

from controller.workshop.gateware.pin_timing import TRIGGER_HIGH_TICKS

NAME = "gateware"  # of the port
PANIC_PORT, PANICKED = 0x505, b"\1"  # of QEMU's device `pvpanic`, which pauses the machine (-action panic=pause)


@cache
def port():
    """The guest's end; one process has it open at a time."""
    (name,) = (port for port in Path("/sys/class/virtio-ports").iterdir() if (port / "name").read_text().strip() == NAME)
    return multiprocessing.connection.Connection(os.open(f"/dev/{name.name}", os.O_RDWR))


@cache
def input_output_ports():
    """The processor's, as a file."""
    return os.open("/dev/port", os.O_WRONLY)


def ask(what, *arguments):
    """Have the host do something while time stands still, and its answer."""
    port().send((what, arguments))
    os.pwrite(input_output_ports(), PANICKED, PANIC_PORT)
    answer = port().recv()
    if isinstance(answer, Exception):
        raise answer
    return answer


class HostGateware:
    """A `Gateware` just out of reset: `RtlGateware` on the host. Each that is made takes the place of those before."""

    def __init__(self, *parameters):
        self.now, self._number = ask("open", *parameters), 0

    @classmethod
    def wired(cls, parameters):
        """Members of a `WiredFpgas` on the host."""
        members = [cls(*parameters)]
        for number in range(1, len(parameters)):
            members.append(copy.copy(members[0]))
            members[-1]._number = number
        return members

    def advance(self, tick):
        self.now = ask("advance", self._number, tick)

    def permit(self, tick, *, level, which):
        ask("permit", self._number, tick, level, which)

    def trigger(self, tick, high_ticks=TRIGGER_HIGH_TICKS):
        ask("trigger", self._number, tick, high_ticks)

    def exchange(self, select_tick, release_tick, mosi, miso):
        self.now, miso[:] = ask("exchange", self._number, select_tick, release_tick, bytes(mosi))

    def take_capture(self):
        return ask("take_capture", self._number)


class Served:
    """What the host does of it."""

    def open(self, *parameters):
        from controller.workshop.gateware.rtl_gateware import RtlGateware
        from controller.workshop.gateware.wired_fpgas import WiredFpgas

        gatewares = [RtlGateware(each) for each in parameters]
        self._fpgas = WiredFpgas(gatewares).members if len(gatewares) > 1 else gatewares
        return self._fpgas[0].now

    def advance(self, number, tick):
        self._fpgas[number].advance(tick)
        return self._fpgas[number].now

    def permit(self, number, tick, level, which):
        self._fpgas[number].permit(tick, level=level, which=which)

    def trigger(self, number, tick, high_ticks):
        self._fpgas[number].trigger(tick, high_ticks)

    def exchange(self, number, select_tick, release_tick, mosi):
        miso = bytearray(len(mosi))
        self._fpgas[number].exchange(select_tick, release_tick, mosi, memoryview(miso))
        return self._fpgas[number].now, bytes(miso)

    def take_capture(self, number):
        return self._fpgas[number].take_capture()

    def board_open(self):
        """The ULX3S, a moment after its configuration; `board_*` is what is done with it."""
        tests = Path(__file__).parent.parent
        sys.path[:0] = [str(tests / "board_top"), str(tests)]
        from compiled_top import CompiledTop

        self._board = CompiledTop()

    def board_exchange(self, pins, sent, sck_hz):
        answer = self._board.exchange(pins, sent, sck_hz)
        self._board.run(10_000_000)  # the kernel's pause between frames
        return answer

    def board_now_s(self):
        return self._board.now_s

    def __getattr__(self, name):
        return getattr(self._board, name.removeprefix("board_"))


class Monitor:
    """QEMU's machine protocol: a JSON object a line."""

    def __init__(self, path):
        wire = socket.socket(socket.AF_UNIX)
        while wire.connect_ex(path):  # QEMU does not listen yet
            time.sleep(0.05)
        self._wire = wire.makefile("rw")
        self._wire.readline()  # its greeting
        self._stops = 0  # of the guest's time that were reported and not waited for
        self.execute("qmp_capabilities")

    def execute(self, command):
        """Have it done, whatever else is reported meanwhile."""
        self._wire.write(json.dumps({"execute": command}))
        self._wire.flush()
        while "return" not in (said := self._reported()):
            assert "error" not in said, said

    def wait_for_stop(self):
        """Until the guest's time stands still."""
        while not self._stops:
            self._reported()
        self._stops -= 1

    def _reported(self):
        line = self._wire.readline()
        if not line:
            raise EOFError  # the machine is gone
        said = json.loads(line)
        self._stops += said.get("event") == "STOP"
        return said


def serve(guest, monitor):
    served = Served()
    while True:
        what, arguments = guest.recv()
        monitor.wait_for_stop()
        try:
            answer = getattr(served, what)(*arguments)
        except Exception as error:
            answer = error
        guest.send(answer)
        monitor.execute("cont")


def main():
    with (
        multiprocessing.connection.Listener(sys.argv[1], "AF_UNIX") as listener,
        listener.accept() as guest,
        contextlib.suppress(EOFError, OSError),  # the guest is gone
    ):
        serve(guest, Monitor(sys.argv[2]))  # before the guest has booted, so that no stop is missed


if __name__ == "__main__":
    main()

"""Runs in the guest: what the other guest files build on is there, and behaves as the kernel's own documentation says."""

import errno
import os
import struct
import threading
from pathlib import Path

import evdev
import gpiod
import spidev
from evdev import AbsInfo, UInput
from evdev import ecodes as e
from gpio_lines import GpioLines
from gpiod.line import Direction, Edge, Value
from smbus2 import SMBus, i2c_msg


def raised(action):
    """The errno of what an action raises; None if it raises nothing."""
    try:
        action()
    except OSError as error:
        return error.errno
    return None


def test_a_uinput_panel_is_an_event_device():
    panel = UInput({e.EV_KEY: [e.BTN_TOUCH], e.EV_ABS: [(e.ABS_X, AbsInfo(0, 0, 799, 0, 0, 0))]}, name="panel")
    device = evdev.InputDevice(panel.device.path)
    panel.write(e.EV_ABS, e.ABS_X, 7)
    panel.syn()
    device.read_one()  # what the queue begins with need not be the axis
    assert device.absinfo(e.ABS_X).value == 7
    panel.close()
    assert raised(lambda: list(device.read())) == errno.ENODEV


def test_an_output_is_seen_and_an_input_is_pulled():
    lines = GpioLines("bench", ["OUT", "IN"])
    output = gpiod.request_lines(f"/dev/{lines.chip}", config={"OUT": gpiod.LineSettings(direction=Direction.OUTPUT)})
    output.set_value("OUT", Value.ACTIVE)
    assert lines.value("OUT") == 1
    output.set_value("OUT", Value.INACTIVE)
    assert lines.value("OUT") == 0
    edges = gpiod.request_lines(f"/dev/{lines.chip}", config={"IN": gpiod.LineSettings(edge_detection=Edge.BOTH)})
    lines.pull("IN", 1)
    assert edges.wait_edge_events(5.0)
    assert edges.read_edge_events()[0].event_type.name == "RISING_EDGE"
    assert raised(lambda: gpiod.request_lines(f"/dev/{lines.chip}", config={"OUT": None})) == errno.EBUSY
    output.release()
    edges.release()
    lines.close()


def test_a_program_is_the_far_end_of_spidev():
    far_end = os.open("/dev/labspi", os.O_RDWR)

    def answer():
        _, size, mode, last = struct.unpack_from("<IIII", request := os.read(far_end, 8192))
        seen.append((size, mode, last))
        os.write(far_end, bytes(byte ^ 0xA5 for byte in request[16:]))

    seen = []
    thread = threading.Thread(target=answer)
    thread.start()
    with spidev.SpiDev() as bus:
        bus.open(0, 0)
        bus.mode = 3
        assert bytes(bus.xfer2([1, 2, 3])) == bytes([1 ^ 0xA5, 2 ^ 0xA5, 3 ^ 0xA5])
    thread.join()
    os.close(far_end)
    assert seen == [(3, 3, 1)]


def test_a_program_is_the_far_end_of_an_i2c_bus_and_nobody_there_is_a_nack():
    number = next(
        int(bus.name.removeprefix("i2c-"))
        for bus in Path("/sys/bus/i2c/devices").glob("i2c-*")
        if (bus / "name").read_text() == "labdev i2c\n"
    )
    with SMBus(number) as bus:
        assert raised(lambda: bus.i2c_rdwr(i2c_msg.read(0x14, 1))) == errno.ENXIO
        far_end = os.open("/dev/labi2c", os.O_RDWR)

        def answer():
            request = os.read(far_end, 8192)
            count, address, flags, length = struct.unpack_from("<IHHH", request)
            seen.append((count, address, flags & 1, length, request[10:12]))
            os.write(far_end, struct.pack("<i", 2) + b"911\0")

        seen = []
        thread = threading.Thread(target=answer)
        thread.start()
        read = i2c_msg.read(0x14, 4)
        bus.i2c_rdwr(i2c_msg.write(0x14, [0x81, 0x40]), read)
        thread.join()
        os.close(far_end)
    assert bytes(read) == b"911\0"
    assert seen == [(2, 0x14, 0, 2, b"\x81\x40")]

"""The pins of an FPGA board, as its pins.lpf or pins.cst has them."""

import re
from typing import NamedTuple

from controller.workshop.gateware.fpga_part import load_part

KINDS = {  # two lines of each port: where it is, with its contact and the board's own name; and its pull
    ".lpf": r'^LOCATE COMP "(\S+)" SITE "(\w+)";(?: # (\S+)(?: (\S+))?)?\nIOBUF PORT "\1" PULLMODE=(\w+) IO_TYPE=LVCMOS33 ?(.*);$',
    ".cst": r'^IO_LOC "(\S+)" (\w+);(?: // (\S+)(?: (\S+))?)?\nIO_PORT "\1" IO_TYPE=LVCMOS33 PULL_MODE=(\w+) ?(.*);$',
}
OSCILLATOR = r'^(?:FREQUENCY PORT "clk_\w+" (?P<mhz>[\d.]+) MHZ;|create_clock -name clk_\w+ -period (?P<ns>[\d.]+) )'


class Pin(NamedTuple):
    """Where a port's pin is."""

    port: str
    site: str  # of the FPGA
    pull: str
    drive: str  # DRIVE=4 SLEWRATE=SLOW; empty where it is none of the FPGA's default
    contact: str  # of a header, P3_5 or J1_5+; empty where it is on none
    name: str  # that the READMEs have for it: the board's own, GP0, or the contact


def read_pins(folder):
    """{port: pin} of the board in a folder."""
    file = folder / load_part(folder).constraints
    text = file.read_text()
    found = re.findall(KINDS[file.suffix], text, re.MULTILINE)
    pins = {
        port: Pin(port, site, pull, drive.replace("SLEW_RATE", "SLEWRATE"), contact, name or contact)
        for port, site, contact, name, pull, drive in found
    }
    assert len(pins) == len(found) == len(re.findall(r"^(?:LOCATE|IO_LOC)", text, re.MULTILINE))
    return pins


def oscillator_ps(folder):
    """Period of the oscillator on the board."""
    (found,) = re.finditer(OSCILLATOR, (folder / load_part(folder).clocks).read_text(), re.MULTILINE)
    return round(1e6 / float(found["mhz"])) if found["mhz"] else round(float(found["ns"]) * 1e3)

"""On an emulated Pi 4, with Debian's own kernel: the SPI's interfaces, `doctor`, and plays in each form of the package.

    .venv/bin/pytest -m slow -n0 -rP tests/kernel/raspi

prints the counts too. Time is counted there (2 ns an instruction), so that they depend little on what else this machine does.
"""

import hashlib
import json
import os
import re
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.doctor.bring_up import CHIRP_REPETITIONS

HERE = Path(__file__).parent
NS_PER_INSTRUCTION = 2
FORMS = {  # most instructions of the host at the median, of an upload and of a resident play: 15 % above what was measured
    "kernel": (0.57e6, 0.245e6),
    "mypyc": (0.281e6, 0.085e6),
    "numpy": (1.16e6, 0.266e6),
}
# What takes more since, as measured on 2026-11-28: the plain specification reads twice as much outside the band; the other is at
# its bound, 0.084 to 0.087 million from run to run
WORSE = {("numpy", "upload"): 1.47e6, ("mypyc", "resident"): 0.087e6}
UPLOAD_IN_KERNEL_US = 1600  # bits, nine clocks of 27.8 MHz a byte, pauses between frames, and the driver

pytestmark = pytest.mark.slow


class Life:
    """What a life of the machine left: its console, and what the far end saw."""

    def __init__(self, folder, name):
        self.log = (folder / f"{name}.log").read_text(errors="replace")
        self.seen = json.loads((folder / f"{name}.json").read_text())

    def found(self, pattern):
        """Groups of the only line that matches."""
        (match,) = re.finditer(pattern, self.log, re.MULTILINE) or (None,)
        return match.groups()


@pytest.fixture(scope="module")
def machine(tmp_path_factory):
    """A folder with the consoles and the bank, after both lives."""
    out = tmp_path_factory.mktemp("raspi")
    command = ["setpriv", "--pdeathsig", "TERM", HERE / "run_pi4.sh", sys.executable, out]
    done = subprocess.run(command, env=os.environ | {"PYTHONPATH": ""}, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return out


@pytest.fixture(scope="module")
def probe(machine):
    return Life(machine, "probe")


@pytest.fixture(scope="module")
def product(machine):
    return Life(machine, "product")


def test_spidev_takes_a_page_in_frames_of_512_bytes_and_no_more(probe):
    assert probe.found(r"^errno 8x512 (\d+) 8x513 (\d+) 7x513 (\d+)") == ("0", "90", "90")
    assert probe.found(r"^spidev speed (\d+) mode (\w+) bufsiz (\d+)") == ("25000000", "0", "4096")


def test_every_frame_arrives_and_is_answered_under_its_own_chip_select(probe):
    right, frames = probe.found(r"^answers right (\d+) of (\d+)")
    assert right == frames != "0"
    assert int(probe.found(r"^frames (\d+)")[0]) == probe.seen["frames"]


def test_lines_are_found_by_name(probe):
    assert probe.found(r"^gpio label (\S+)") == ("pinctrl-bcm2711",)
    assert re.findall(r"^line (\S+) offset (\d+) held", probe.log, re.MULTILINE) == [
        ("GPIO25", "25"),
        ("GPIO23", "23"),
        ("GPIO24", "24"),
    ]
    assert (probe.seen["triggers"], probe.seen["permits"], probe.found(r"^ready (\d)")) == (50, [1, 0], ("1",))


def test_frames_are_polled_with_the_limit_that_the_page_names(probe):
    polled = dict(re.findall(r"^message limit (\d+) bytes 512 .*; polling (\d+)", probe.log, re.MULTILINE))
    assert polled == {"30": "20", "250": "100"}, "at 30 only those of 36 bytes"


@pytest.mark.parametrize(
    ("about", "said"),
    [
        ("SPI device", "/dev/spidev0.0 may be opened"),
        ("spidev buffer", "8192 bytes: an upload is one message"),
        ("GPIO lines", "GPIO25, GPIO24, GPIO23 on pinctrl-bcm2711"),
        ("kernel", "on a Raspberry Pi 4 Model B"),
        ("SPI polling", "up to 250 µs: a LOAD frame of 166 µs costs no interrupt"),
        ("identity and settings", "each setting was read back"),
        ("SCK", "27.7778 MHz as the board says"),
        ("bits", "0 errors in"),
        ("SCK measured", "MHz by the time that frames take"),
        ("board", "16 slots keep what they are given; 32 channels chirped"),
    ],
)
def test_doctor_finds_the_devices_and_examines_the_link(product, about, said):
    assert said in product.found(rf"^ok +{about}  +(.*)$")[0]


def test_doctor_misses_a_touch_panel_and_a_bank_and_nothing_else(product):
    assert re.findall(r"^NOT OK +(.*?)  ", product.log, re.MULTILINE) == ["touch panel", "bank"]
    assert product.found(r"^DOCTOR ENDS WITH (\d+)") == ("1",)


@cache
def entry(bank, cell):
    with Bank.open(bank, load_board(find_board("ulx3s"))) as opened:
        return hashlib.sha256(opened.drive.words(cell)).hexdigest()


@pytest.mark.parametrize("form", FORMS)
def test_what_the_pins_play_is_the_banks_entry_bit_for_bit(machine, product, form):
    at = emissions_before(product, form)
    cells = [int(cell) for cell in product.found(rf"^{form}: entries (.*)$")[0].split()]
    assert len(set(cells)) < len(cells), "some are resident"
    expected = [entry(machine / "panel.bank", cell) for cell in cells]
    assert len(set(expected)) == len(set(cells))
    assert product.seen["emissions"][at : at + len(cells)] == expected


def emissions_before(product, form):
    """Emissions at the far end before a form's: chirps, and those of the forms before."""
    at = 32 * CHIRP_REPETITIONS
    for other in sorted(FORMS):
        if other == form:
            return at
        at += played(product, other)
    raise AssertionError(form)


def played(product, form):
    """Emissions of a form, by what it printed."""
    entries = product.found(rf"^{form}: entries (.*)$")[0].split()
    return len(entries) + int(product.found(rf"^{form}: armed 1 emissions (\d+)")[0])


def test_the_far_end_emitted_as_often_as_it_was_asked(product):
    assert len(product.seen["emissions"]) == 32 * CHIRP_REPETITIONS + sum(played(product, form) for form in FORMS)
    assert product.seen["most_ahead_us"] < 1, "the far end's clock is the machine's"


@pytest.mark.parametrize("form", FORMS)
def test_the_loop_plays_armed_and_without_an_outage(product, form):
    emissions, uploads = map(int, product.found(rf"^{form}: armed 1 emissions (\d+) uploads (\d+)"))
    assert emissions >= 400
    assert 0 < uploads < emissions
    assert product.found(rf"^{form}: counted .* (host_silent 0 outages 0)$")
    assert product.found(rf"^PLAYS {form} END WITH (\d+)") == ("0",)


def stage_us(product, form, what, stage):
    count, p50, p99 = product.found(rf"^{form}: {what} {stage} count (\d+) p50 (\S+) p99 (\S+)")
    return int(count), float(p50), float(p99)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("what", ["upload", "resident"])
def test_host_work_takes_no_more_instructions_than_it_did(product, form, what):
    per_us = 1000 / NS_PER_INSTRUCTION
    print()
    for stage in ("decide", "frame", "trigger", "host"):
        count, p50, p99 = stage_us(product, form, what, stage)
        print(f"{form}, {what}, {stage}: p50 {p50 * per_us:,.0f}, p99 {p99 * per_us:,.0f} instructions of {count}")
    host, most = stage_us(product, form, what, "host")[1] * per_us, FORMS[form][what == "resident"]
    if host > most and (form, what) in WORSE:
        assert host <= 1.05 * WORSE[form, what]
        pytest.xfail("more instructions than on 2026-11-22")
    assert host <= most


@pytest.mark.parametrize("form", FORMS)
def test_an_upload_is_in_the_kernel_for_little_more_than_its_bits(product, form):
    _, p50, p99 = stage_us(product, form, "upload", "wire")
    _, resident, _ = stage_us(product, form, "resident", "wire")
    print(f"\n{form}: in the kernel an upload is p50 {p50:.0f}, p99 {p99:.0f} us, a resident play {resident:.0f} us")
    assert p50 <= UPLOAD_IN_KERNEL_US

"""`doctor --link` and `gateware check` of several FPGAs: what they share is looked at first, then each by itself."""

import msgspec
from tables import each_row

from controller.cli import main
from controller.clocks import VirtualClock
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.doctor.bring_up import Chirps
from controller.device.doctor.several_fpgas import examine_links
from controller.device.service.drivers import open_session
from controller.workshop.gateware.wired_fpgas import SimulatedFpgas

WHOLE = load_board(find_board("simulated_64"))
BOARD = msgspec.structs.replace(  # its memory is read word by word
    WHOLE,
    link=msgspec.structs.replace(WHOLE.link, slots=1),
    waveform=msgspec.structs.replace(WHOLE.waveform, duration_ms=0.2),
)


class Examined:
    """What is found of the simulated panel, and which channels were said to chirp."""

    def __init__(self, damage=lambda _: None):
        clock = VirtualClock()
        links = SimulatedFpgas(BOARD, clock.now_s)
        damage(links)
        self.chirped = []
        done = examine_links(
            BOARD,
            links,
            lambda link, one: open_session(link, one, clock.now_s),
            clock,
            1e3,
            Chirps([3, 40], 0.0, self.chirped.append),
            captures=[link.take_capture for link in links.timed],
        )
        self.findings = {finding.about: finding for finding in done.findings}
        self.figures = done.figures["fpgas"]

    @property
    def bad(self):
        return [about for about, finding in self.findings.items() if not finding.good]


def test_a_good_panel_has_no_complaint_and_each_channel_chirps_on_its_own_fpga():
    examined = Examined()
    assert examined.bad == []
    assert examined.chirped == [3, 40]
    for number in range(2):
        assert "1 channels chirped, each moved its own pin" in examined.findings[f"FPGA {number}: board"].said
        assert examined.figures[number]["bit_errors"]["wrong_bits"] == 0


def test_a_trigger_that_does_not_reach_one_is_found_and_nothing_chirps():
    def cut(links):
        links.panel.gatewares[1].trigger = lambda *_: None

    examined = Examined(cut)
    assert examined.bad == ["trigger and clock"]
    assert "FPGA 1 saw 0 edges of the trigger line" in examined.findings["trigger and clock"].said
    assert examined.chirped == []


@each_row(("ticks", "bad"), [(2, []), (3, ["trigger and clock"])])
def test_fpgas_on_crystals_of_their_own_are_found(ticks, bad):
    def drift(links):
        second, seen = links.panel.gatewares[1], []
        trigger = second.trigger

        def later(tick, high_ticks):
            trigger(tick + ticks * len(seen), high_ticks)
            seen.append(tick)

        second.trigger = later

    examined = Examined(drift)
    assert examined.bad == bad
    if bad:
        assert "in 0.2 s FPGA 1 counts 3 ticks more than FPGA 0" in examined.findings["trigger and clock"].said


def test_one_that_does_not_answer_is_named_and_the_other_is_examined_all_the_same():
    def mute(links):
        def silent(sent, lengths, received):
            received[:] = bytes(len(received))

        links.links[1].exchange = silent

    examined = Examined(mute)
    assert examined.bad == ["trigger and clock", "FPGA 1: link"]
    assert "only zeros came back" in examined.findings["FPGA 1: link"].said
    assert examined.findings["FPGA 0: bits"].good
    assert examined.chirped == []


def test_the_commands_say_what_they_found_of_each(tmp_path, capsys):
    text = (find_board("simulated_64") / "board.toml").read_text()
    for whole, short in (("slots = 4", "slots = 1"), ("duration_ms = 2.0", "duration_ms = 0.5")):
        assert text.count(whole) == 1
        text = text.replace(whole, short)
    (tmp_path / "board.toml").write_text(text)
    assert main(["gateware", "check", "--board", str(tmp_path), "--bits", "1e3", "--channel", "40"]) == 0
    out, err = capsys.readouterr()
    assert [line for line in out.splitlines() if line.startswith(("FPGA", "PASS", "channels:"))] == [
        "FPGA 0",
        "channels: 0 chirped, their pins seen",
        "PASS: all that was tried is as it should be",
        "FPGA 1",
        "channels: 1 chirped, their pins seen",
        "PASS: all that was tried is as it should be",
    ]
    assert "channel 40 chirps" in err
    assert main(["gateware", "check", "--board", str(tmp_path), "--device", "/dev/ttyUSB0"]) == 78
    assert "--device: a board of several FPGAs plays over SPI alone" in capsys.readouterr().err
    assert main(["gateware", "build", "--board", str(tmp_path), "--fpga", "2"]) == 2
    assert "has no FPGA 2: they are counted from 0 to 1" in capsys.readouterr().err

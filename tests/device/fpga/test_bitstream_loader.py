"""An FPGA with another gateware is loaded by a program beside the loop, before it is armed, or it is refused."""

import os
import re
import signal
import sys

import msgspec
import pytest
from tables import each_row

from controller.clocks import VirtualClock
from controller.device.board.board import load_board
from controller.device.board.devices import GatewareLoading, LinkedFpga
from controller.device.board.lookup import find_board
from controller.device.fpga.bitstreams.loader import BitstreamLoader
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.configuration import IncompatibleFpga
from controller.device.fpga.session import Session
from controller.device.service.drivers import await_session, gateware_hash
from controller.errors import LinkError
from controller.workshop.gateware.actual_panel import gateware_of
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.simulated_link import SimulatedLink
from controller.workshop.gateware.wired_fpgas import SimulatedFpgas

BUILD, OTHER = 0x1234ABCD, 7
BOARD = load_board(find_board("simulated"))
LOAD = "import sys; open(sys.argv[2], 'w').write(open(sys.argv[1]).read())"
COUNT = "import os, signal, sys; open(sys.argv[2] + '.runs', 'a').write('.'); runs = os.path.getsize(sys.argv[2] + '.runs')\n"
EMPTY = "empty"  # in place of a build hash: the FPGA is not configured


def until_good(panel):
    """Bring a panel up as the loop retries it, until it is good or refused."""
    while True:
        try:
            return panel.session.bring_up()
        except IncompatibleFpga:
            raise
        except LinkError as error:
            panel.failed(error)


def ended(loader):
    """Wait for the program of a loader, if it runs one."""
    if loader._process is not None:
        os.waitid(os.P_PID, loader._process.pid, os.WEXITED | os.WNOWAIT)


class SilentLink(SimulatedLink):
    """To an FPGA that is not configured: its pin stays low."""

    def exchange(self, sent, lengths, received):
        super().exchange(sent, lengths, received)
        received[: sum(lengths)] = bytes(sum(lengths))


class Bench:
    """An FPGA whose build hash is what a file says, and a session with it."""

    def __init__(self, folder, program=LOAD, hash_of_bitstream=BUILD):
        self.clock = VirtualClock()
        self.configured = folder / "configured"
        self.bitstream = folder / "gateware.bit"
        self.bitstream.write_text(str(hash_of_bitstream))
        self.link = None
        command = (*([sys.executable, "-c", program] if program else ["/no/loader"]), "{bitstream}", str(self.configured))
        settings = GatewareLoading(load=command, bitstream="gateware.bit", limit_s=5.0)
        self.loader = BitstreamLoader(settings, self.bitstream, self.clock.now_s)
        self.power_up(OTHER)

    def power_up(self, build):
        """The FPGA just out of reset, with this gateware."""
        model = GatewareModel(BuildParameters.of(BOARD, OTHER if build == EMPTY else build))
        start_s = self.clock.now_s()
        self.link = (SilentLink if build == EMPTY else SimulatedLink)(BOARD.link, lambda: self.clock.now_s() - start_s, model)
        self.session = Session(self.link, BOARD, BUILD, lambda: self.clock.now_s() - start_s, bring_up=False)
        self.session.loader = self.loader
        self.gateware = model

    def bring_up(self):
        return until_good(self)

    def failed(self, error):
        """What has become of the FPGA meanwhile."""
        self.said = str(error)
        ended(self.loader)
        if self.configured.exists():
            text = self.configured.read_text()
            self.power_up(EMPTY if text == EMPTY else int(text))
            self.configured.unlink()

    @property
    def runs(self):
        """How often a program that begins with COUNT was run."""
        return self.configured.with_suffix(".runs").stat().st_size

    def refused(self):
        """One line that says why the FPGA is refused; it was never armed, and no program is left."""
        with pytest.raises(IncompatibleFpga) as caught:
            self.bring_up()
        assert caught.value.exit_code == 78
        assert "\n" not in str(caught.value)
        assert not self.link.take_capture().hv.any()
        assert self.loader._process is None
        return str(caught.value)


def test_it_is_loaded_and_used_and_loaded_again_after_its_supply_was_lost_and_its_flash_has_another(tmp_path):
    bench = Bench(tmp_path)
    bench.bring_up()
    assert "BUILD_HASH is 0x00000007, not 0x1234ABCD" in bench.said
    assert re.search(r"its gateware is being loaded|it has just been loaded", bench.said), "a loader may end at once"
    bench.session.heartbeat()
    assert bench.session.arm() > 0
    bench.power_up(OTHER)
    bench.bring_up()


def test_it_is_not_loaded_where_its_gateware_is_right(tmp_path):
    bench = Bench(tmp_path, program=None)
    bench.power_up(BUILD)
    bench.bring_up()


@each_row(
    ("program", "said"),
    [
        (None, "/no/loader cannot be started (No such file or directory)"),
        ("import sys; sys.exit('busy\\nno cable found')", "ended with exit code 1: no cable found"),
        ("import os, signal; os.kill(os.getpid(), signal.SIGSEGV)", "was ended by SIGSEGV"),
    ],
)
def test_a_loader_that_is_missing_or_fails_is_said(tmp_path, program, said):
    refused = Bench(tmp_path, program).refused()
    assert said in refused
    assert "BUILD_HASH is 0x00000007" in refused
    assert ("after 3 attempts" in refused) == (program is not None), "a missing program has no second"


@each_row(
    ("program", "runs"),
    [
        (COUNT + "if runs == 1: sys.exit('unable to open ftdi device')\n" + LOAD, 2),
        (COUNT + "if runs < 3: os.kill(os.getpid(), signal.SIGSEGV)\n" + LOAD, 3),
        (COUNT + f"if runs == 1: open(sys.argv[2], 'w').write('{EMPTY}'); sys.exit('broken off')\n" + LOAD, 2),
        (COUNT + "if runs == 1: sys.exit(0)\n" + LOAD, 2),
    ],
    ids=["fails once", "crashes twice", "fails half-way: the FPGA is empty", "says done, and has not"],
)
def test_a_loader_that_fails_for_a_moment_has_further_attempts(tmp_path, program, runs):
    bench = Bench(tmp_path, program)
    bench.bring_up()
    assert bench.runs == runs
    assert bench.session.arm() > 0


@pytest.mark.parametrize("ends", ["os.kill(os.getpid(), signal.SIGSEGV)", "sys.exit('could not release the interface')"])
def test_a_loader_that_crashes_after_it_has_loaded_is_no_failure(tmp_path, ends):
    """The FPGA's own answer counts."""
    bench = Bench(tmp_path, f"{COUNT}{LOAD}; {ends}")
    bench.bring_up()
    assert bench.runs == 1
    assert bench.session.arm() > 0


def test_each_time_that_the_gateware_is_lost_has_its_own_attempts(tmp_path):
    bench = Bench(tmp_path, COUNT + "if runs % 3: sys.exit('busy')\n" + LOAD)
    for times in (1, 2):
        bench.power_up(OTHER)
        bench.bring_up()
        assert bench.runs == 3 * times


def test_an_fpga_that_stays_silent_is_waited_for_and_not_loaded_for_ever(tmp_path):
    """As one whose cable was pulled while it was loaded: what it is, is not known, so it is not refused."""
    bench = Bench(tmp_path, COUNT + f"open(sys.argv[2], 'w').write('{EMPTY}'); sys.exit('cable pulled')")
    said = []
    for _ in range(12):
        with pytest.raises(LinkError) as caught:
            bench.session.bring_up()
        assert not isinstance(caught.value, IncompatibleFpga)
        said.append(str(caught.value))
        if bench.loader._process is not None:
            os.waitid(os.P_PID, bench.loader._process.pid, os.WEXITED | os.WNOWAIT)
            bench.power_up(EMPTY)
    assert bench.runs == 3
    assert "it is so after 3 attempts to load it" in "".join(said)
    assert "cable pulled" in "".join(said)
    bench.power_up(BUILD)
    bench.bring_up()


def test_a_bitstream_that_is_missing_is_said(tmp_path):
    bench = Bench(tmp_path)
    bench.bitstream.unlink()
    assert f"{bench.bitstream}: there is no such bitstream to load" in bench.refused()


def test_a_wrong_bitstream_is_not_loaded_twice(tmp_path):
    bench = Bench(tmp_path, hash_of_bitstream=8)
    refused = bench.refused()
    assert "BUILD_HASH is 0x00000008" in refused
    assert f"it is so after {bench.bitstream} was loaded" in refused


def test_a_loader_that_hangs_is_ended_with_all_it_started(tmp_path):
    held = tmp_path / "held"
    os.mkfifo(held)
    bench = Bench(tmp_path, f"import subprocess; subprocess.run(['sh', '-c', 'exec sleep infinity >{held}'])")
    with pytest.raises(LinkError, match="is being loaded"):
        bench.session.bring_up()
    for _ in range(2):
        with held.open("rb") as far_end:  # open once the program's own program has it open
            bench.clock._now_s += 5.1
            with pytest.raises(LinkError, match="is being loaded"):
                bench.session.bring_up()
            process = bench.loader._process
        assert process.returncode is None, "the next attempt"
    with held.open("rb") as far_end:
        bench.clock._now_s = bench.loader._until_s
        bench.loader.require_done()  # its time is over
        assert "did not end within 5 s" in bench.refused()
        assert far_end.read() == b"", "nobody has it open any more"


def test_it_ends_with_the_service(tmp_path):
    bench = Bench(tmp_path, "import signal; signal.pause()")
    with pytest.raises(LinkError, match="is being loaded"):
        bench.session.bring_up()
    process = bench.loader._process
    bench.loader.close()
    assert process.returncode == -signal.SIGKILL


class Pair:
    """Two FPGAs of one panel with another gateware each, which is that of a file once a loader has written it."""

    def __init__(self, folder, program=LOAD):
        board = load_board(find_board("simulated_64"))
        cables = tuple(LinkedFpga(cable=str(folder / name)) for name in ("A", "B"))
        loading = GatewareLoading(load=(sys.executable, "-c", program, "{bitstream}", "{cable}"), bitstream="own.bit", limit_s=5.0)
        link = msgspec.structs.replace(board.link, fpga=cables)
        self.board = msgspec.structs.replace(board, link=link, gateware=loading, folder=folder)
        (folder / "own.bit").write_text(str(gateware_hash()))
        (folder / "own.fpga1.bit").write_text(str(gateware_hash()))
        self.clock = VirtualClock()
        self.fpgas = None
        _, self.session = await_session(self.board, self.clock.now_s, self.opened)
        self.said = []

    def opened(self, board, now_s):
        self.fpgas = SimulatedFpgas(board, now_s)
        for number in range(2):
            self.configure(number, OTHER)
        return self.fpgas

    def configure(self, number, build):
        """An FPGA just out of reset, with this gateware."""
        panel, ready_ticks = self.fpgas.panel, list(self.fpgas.panel.ready_ticks)
        model, now = GatewareModel(gateware_of(self.board.fpga_boards[number], build)), panel.now
        panel.gatewares = tuple(model if n == number else one for n, one in enumerate(panel.gatewares))
        ready_ticks[number] = now
        panel.ready_ticks = tuple(ready_ticks)
        for which in Permit:
            model.permit(0, level=True, which=which)

    def bring_up(self):
        return until_good(self)

    def failed(self, error):
        """What has become of the FPGAs meanwhile."""
        self.said.append(str(error))
        for number, one in enumerate(self.session.of_each):
            ended(one.loader)
            loaded = self.board.folder / "AB"[number]
            if loaded.exists():
                self.configure(number, int(loaded.read_text()))
                loaded.unlink()


def test_each_of_several_is_loaded_with_its_own_file_at_its_own_cable_and_both_at_once(tmp_path):
    pair = Pair(tmp_path)
    pair.bring_up()
    assert len(pair.said) <= 2, "both are loaded while the first is waited for"
    assert all(re.match(r"FPGA [01]: the FPGA's BUILD_HASH is 0x00000007", said) for said in pair.said)
    assert pair.session.arm() > 0


def test_one_of_several_that_cannot_be_loaded_is_named(tmp_path):
    pair = Pair(tmp_path)
    (tmp_path / "own.fpga1.bit").unlink()
    with pytest.raises(IncompatibleFpga, match=r"FPGA 1: .*own\.fpga1\.bit: there is no such bitstream to load"):
        pair.bring_up()
    for one in pair.session.of_each:
        one.loader.close()

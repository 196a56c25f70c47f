"""What is there of a simulated panel that is wrong: its own faults, which a mended board.toml does not change."""

import numpy as np
import pytest
from tables import each_row

from controller.cli import main
from controller.clocks import VirtualClock
from controller.device.board.records import load_toml
from controller.device.service.drivers import open_session
from controller.errors import ConfigError, GatewareError, LinkError
from controller.workshop.gateware.actual_panel import SensorFrame, actual_panel, load_flash
from controller.workshop.gateware.simulated_link import open_simulated
from controller.workshop.simulation.rehearsal import SETUP, header_alone, taps_on
from controller.workshop.simulation.remedies import Bench, faults_of
from controller.workshop.simulation.wrong_panel import SHIPPED, WrongPanel

WRONG = load_toml(SHIPPED, WrongPanel)


@pytest.fixture
def bench(tmp_path, capsys, monkeypatch):
    """A panel that is wrong in every way, as setup has written its board."""
    monkeypatch.setattr("sys.stdin", None)
    bench = Bench(tmp_path / "panel", WRONG, False)
    assert main(["setup", str(bench.folder), *SETUP]) == 0
    capsys.readouterr()
    bench.first = bench.board
    bench.solder()
    return bench


def there(bench):
    return actual_panel(bench.board).of(bench.board)


def test_what_is_there_is_not_what_the_board_says(bench):
    board, real = bench.board, there(bench)
    places = {one.channel: (one.x_mm, one.y_mm) for one in board.actuators}
    found = {one.channel: (one.x_mm, one.y_mm) for one in real.actuators}
    assert (found[7], found[8]) == (places[8], places[7])
    assert set(places) - set(found) == {12, 13, 14, 15}
    assert {one.channel: one.idle for one in real.actuators}.items() <= {one.channel: one.idle for one in board.actuators}.items()
    assert (real.plate.length_mm, real.plate.edges, real.plate.theory) == (113, "free", "mindlin")
    assert real.driver.capacitance_f == pytest.approx(1.12 * board.driver.capacitance_f)
    assert real.driver.moment_n_per_v == board.driver.moment_n_per_v


def test_a_mended_board_does_not_change_what_is_there(bench):
    before = there(bench)
    bench.without_channels({12, 13, 14, 15})
    bench.edit(
        lambda text: text.replace("[driver]\n", "[driver]\nresistance_ohm = 3000\n").replace("length_mm = 110", "length_mm = 114")
    )
    assert len(bench.board.actuators) == 16
    assert (there(bench).actuators, there(bench).plate.length_mm) == (before.actuators, 113)
    assert there(bench).driver.resistance_ohm == before.driver.resistance_ohm
    bench.solder(swapped=())
    assert {one.channel: one.x_mm for one in there(bench).actuators}[7] == bench.first.actuators[7].x_mm


def test_an_fpga_is_empty_until_it_is_loaded_and_then_what_its_bitstream_says(bench, tmp_path):
    board, clock = bench.board, VirtualClock()
    with pytest.raises(LinkError, match=r"only ones came back: .* loaded"):
        open_session(open_simulated(board, clock.now_s), board, clock.now_s)
    bitstream = tmp_path / "panel.bit"
    bitstream.write_bytes(header_alone(board))
    load_flash(board, bitstream)
    open_session(open_simulated(board, clock.now_s), board, clock.now_s)
    bench.without_channels({12})
    with pytest.raises(LinkError, match="CHANNEL_MASK_MAX is 1048575, not 1044479"):
        open_session(open_simulated(bench.board, clock.now_s), bench.board, clock.now_s)
    bitstream.write_bytes(header_alone(bench.board)[:-5])
    load_flash(board, bitstream)
    with pytest.raises(GatewareError):
        open_simulated(board, clock.now_s)


def test_the_command_loads_it_and_refuses_the_bitstream_of_another_board(bench, capsys):
    (bench.folder / bench.board.bitstream).write_bytes(header_alone(bench.board))
    assert main(["gateware", "load", "--board", str(bench.folder), "--flash"]) == 0
    assert (bench.folder / "flash.bit").exists()
    bench.without_channels({12})
    assert main(["gateware", "load", "--board", str(bench.folder)]) == 78
    assert "bring-up would refuse it" in capsys.readouterr().err


def test_a_frame_moves_and_turns_what_a_sensor_is_sent_to():
    assert np.allclose(SensorFrame(x_mm=2.0, y_mm=-1.0).place_m(np.array([0.01, 0.02])), [0.012, 0.019])
    assert np.allclose(SensorFrame(degrees=90.0).place_m(np.array([0.01, 0.02])), [-0.02, 0.01])


@each_row(
    ("text", "said"),
    [
        ("[plate]\nlenght_mm = 3\n", "lenght_mm"),
        ("[plate]\nlength_mm = 60\n", "actuators"),
        ("[touch]\ninterrupt = 3\n", "interrupt"),
        ("wires = 1\n", "wires"),
    ],
)
def test_what_cannot_be_there_is_refused(bench, text, said):
    (bench.folder / "actual.toml").write_text(text)
    with pytest.raises(ConfigError, match=said) as refused:
        there(bench)
    assert "actual.toml" in str(refused.value)


@pytest.mark.slow
def test_wires_and_a_dead_interrupt_line_are_named_by_the_survey_of_channels(bench, capsys):
    """By the device's own driver of the touch panel, whose far end is simulated."""
    (bench.folder / bench.board.bitstream).write_bytes(header_alone(bench.board))
    assert main(["gateware", "load", "--board", str(bench.folder)]) == 0
    assert main(["calibrate", "channels", "--board", str(bench.folder)]) == 1
    said = capsys.readouterr().out
    assert "channels 7 and 8 are swapped" in said
    assert said.count("nothing was felt") == 4
    assert "interrupt line no edge: polled" in said
    bench.solder(swapped=(), dead=(), dead_interrupt=False)
    assert main(["calibrate", "channels", "--board", str(bench.folder)]) == 0
    assert "WARNING" not in capsys.readouterr().out


def test_every_fault_that_is_shipped_has_to_be_found_and_none_of_a_right_panel():
    assert len(faults_of(WRONG)) == 7
    assert not faults_of(WrongPanel())


def test_taps_are_where_the_plate_is(bench):
    from controller.device.touch.recordings.recording import Recording

    recording = Recording(taps_on(bench.board), "taps")
    tracks = recording.tracks(recording.axes(bench.board), 0.0)
    assert len(tracks) == 7
    x_m, y_m = tracks[0].position(0.05)
    assert (x_m, y_m) == (pytest.approx(0.022, abs=1e-4), pytest.approx(0.02, abs=1e-4))

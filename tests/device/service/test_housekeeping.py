"""What the service does beside playing: the bit clock follows the plate, and changes are reported once."""

import msgspec
import numpy as np
import pytest

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.board.devices import Temperature
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.service.housekeeping import Housekeeping
from controller.device.service.systemd import Notifier, Watchdog
from controller.device.service.temperature import Thermometer
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.device.touch.reports import off_plate_warning
from controller.workshop.gateware.simulated_link import open_simulated

CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'
PER_K = -2e-4
TAPS = [r for k in range(6) for r in ((0.5 * k, {0: (40.0 + 20 * k, 70.0)}), (0.5 * k + 0.1, {0: None}))]
DRAG = [*((0.01 * k, {0: (60.0 + 2 * k, 70.0)}) for k in range(60)), (0.7, {0: None})]


@pytest.fixture
def sensor(tmp_path):
    """As sysfs shows one: thousandths of a degree."""
    file = tmp_path / "temp1_input"
    file.write_text("23000\n")
    return file


@pytest.fixture
def kept(board, bank_file, tmp_path, sensor, evemu_text, capsys):
    """Run a loop with housekeeping; `at` maps times to what the sensor says from then on."""

    def run(at, taps=TAPS, shift_mm=0.0):
        temperature = Temperature(kind="hwmon", device=str(sensor), coefficient_per_k=PER_K, period_s=0.1)
        shifted = msgspec.structs.replace(board.touch, x_mm_from_axes=(210.0, 0.0, shift_mm))
        warm = msgspec.structs.replace(board, temperature=temperature, touch=shifted)
        (tmp_path / "s.toml").write_text(CLICK)
        clock = VirtualClock()
        link = open_simulated(warm, clock.now_s)
        session = open_session(link, warm, clock.now_s)
        recording = Recording(evemu_text(*taps))
        notifier = Notifier("")
        thermometer = Thermometer(temperature)
        housekeeping = Housekeeping(warm, session, notifier, Watchdog(notifier, float("inf")), thermometer)
        left = sorted(at.items())

        def progress(now_s):
            while left and left[0][0] <= now_s:
                said = left.pop(0)[1]
                sensor.write_text("" if said is None else f"{said}\n")
            housekeeping.progress(now_s)

        with Bank.open(bank_file, warm) as bank:
            source = tracked(RecordingSource(recording, recording.axes(warm), 0.2), warm)
            scene = load_scene(tmp_path / "s.toml", warm)
            watch = Watch(progress, housekeeping.emission_started, housekeeping.scene_changed)
            assembly = assemble(LoopContext(warm, clock, session, source), scene, bank, watch=watch)
            housekeeping.watch(assembly.loop, None, (), source.counts)
            assembly.loop.run()
            link.close()
        return link, housekeeping, assembly.counters, capsys.readouterr().err

    return run


def lengths_us(link, clock_hz):
    """From the first change of an emission's words to its focus."""
    capture = link.take_capture()
    ticks = capture.ticks.astype(np.int64)
    lengths = []
    for focus in capture.focus_ticks.astype(np.int64):
        within = ticks[(ticks > focus - 2.2e-3 * clock_hz) & (ticks < focus)]
        lengths.append((focus - within[0]) / clock_hz * 1e6)
    return lengths


def test_emissions_are_played_as_much_slower_as_the_warm_plate_is(kept, board):
    link, housekeeping, counters, _ = kept({1.0: 27000, 1.3: 31000, 1.6: 33000})
    assert housekeeping.scale == pytest.approx(1 + PER_K * 10)
    lengths = lengths_us(link, board.link.clock_hz)
    assert len(lengths) == counters.emissions == 6
    assert lengths[0] == pytest.approx(2000, abs=2.1)
    assert lengths[-1] - lengths[0] == pytest.approx(4.0, abs=0.5), "10 K of -200 ppm/K on 2 ms"


def test_a_sensor_that_is_lost_is_reported_once_and_its_last_reading_holds(kept):
    _, housekeeping, _, log = kept({0.5: 26000, 1.0: None})
    assert housekeeping.scale == pytest.approx(1 + PER_K * 3)
    assert log.count("temperature") == 1, log


def test_nonsense_changes_nothing(kept):
    _, housekeeping, _, log = kept({0.5: 99999, 0.9: -273150})
    assert housekeeping.scale == 1.0
    assert "temperature sensor says" in log


def test_touches_that_lie_off_the_plate_are_reported_once_with_both_numbers(kept):
    *_, log = kept({}, DRAG, shift_mm=180.0)
    assert log.count("lie off the plate") == 1
    assert "50 of 50 positions lie off the plate by touch.x_mm_from_axes and y_mm_from_axes" in log


@pytest.mark.parametrize(("taps", "shift_mm"), [(DRAG, 60.0), (TAPS, 180.0)])
def test_some_touches_off_the_plate_are_not_reported(kept, taps, shift_mm):
    """The panel reaches beyond the glass; or there were too few to know."""
    *_, log = kept({}, taps, shift_mm=shift_mm)
    assert "off the plate" not in log
    assert off_plate_warning(10, 5) == "", "half of them"
    assert off_plate_warning(10, 6).startswith("6 of 10 positions lie off the plate")

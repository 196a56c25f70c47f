"""Responses learned from records of a plate that is known: how near they come, and that what is wrong is found and named."""

import re
from functools import cache
from pathlib import Path

import msgspec
import numpy as np
import pytest
from workshop.calibration.exact_records import BIT_CLOCK_HZ, CHANNELS, NAMES, POINTS_M, board, displacement, noisy, true_responses

from controller.errors import CalibrationError
from controller.workshop import calibration
from controller.workshop.calibration.learning.learning import learn
from controller.workshop.calibration.records.measurement_file import (
    ImpulsesDrive,
    MeasurementFile,
    RecordsTable,
    SamplesDrive,
    SweepDrive,
    WordsDrive,
)
from controller.workshop.calibration.records.measurement_writer import write_measurement
from controller.workshop.calibration.transfer_functions.deconvolution import _tapered
from controller.workshop.calibration.transfer_functions.transfers import RawBins

RATE_HZ = 200e3
RECORD = 1400  # samples: 7 ms
FIRST_S = -0.2e-3
WORDS = WordsDrive(file="drive.npy", bit_clock_hz=BIT_CLOCK_HZ, supply_v=60.0)


def times_s(ppm=0.0, late_s=0.0, count=RECORD):
    return FIRST_S + late_s + np.arange(count) / (RATE_HZ * (1 + ppm * 1e-6))


@cache
def words():
    """Random words: 12 emissions of all channels at once, each with bits of its own, (emission, 8, word)."""
    return np.random.default_rng(1).integers(0, 2, (12, 8, 600))


def packed(bits):
    return (bits << CHANNELS[:, None]).sum(axis=1).astype(np.uint32)


def volts_of(bits, level_v=60.0):
    volts = np.zeros((len(bits), 32, bits.shape[2]))
    volts[:, CHANNELS] = bits * level_v
    return volts


@cache
def clean(ppm=0.0, late_s=0.0):
    """Velocity (point, emission, 1, sample)."""
    return displacement(volts_of(words()), BIT_CLOCK_HZ, times_s(ppm, late_s), order=1)[:, :, None]


def learned(folder, drive, array, records, unit="m/s", stated=True, samples=1000, **table):
    reported = {"files": "r/{point}.npy", "unit": unit, "first_sample_us": FIRST_S * 1e6 if stated else None} | table
    described = MeasurementFile(
        date="2026-11-22", sample_rate_hz=RATE_HZ, points="points.csv", records=RecordsTable(**reported), drive=drive
    )
    write_measurement(folder, described, NAMES, POINTS_M, array, list(records))
    return learn(folder, board(), samples=samples)


def error_of(found, channels=CHANNELS, factor=1.0):
    """Of the responses in the learned band, relative, over 2 ms."""
    bins = RawBins.of(board(), RECORD / RATE_HZ)
    true = true_responses(lambda hz: np.interp(hz, bins.frequency_hz, bins.gain, 0, 0), 1000)[:, :, channels]
    got = found.responses[:, :, channels] * factor
    return np.linalg.norm(got - true) / np.linalg.norm(true)


def one_at_a_time(kind):
    """Drive, its array, volts (emission, 32, sample), their rate, unit and order of the derivative."""
    two = (0, 5)
    volts = np.zeros((2, 32, 1))
    volts[[0, 1], two] = 1
    if kind == "impulses":
        return ImpulsesDrive(bit_clock_hz=BIT_CLOCK_HZ, supply_v=60.0, channels=two), None, volts * 60, BIT_CLOCK_HZ, "m/s", 1
    if kind == "noise":
        bits = np.zeros((2, 8, 1000), int)
        bits[[0, 1], two] = np.random.default_rng(3).integers(0, 2, (2, 1000))
        return WORDS, packed(bits), volts_of(bits), BIT_CLOCK_HZ, "m/s", 1
    if kind == "samples":
        samples = np.random.default_rng(4).normal(size=(2, 600)) * 10
        return SamplesDrive(file="drive.npy", rate_hz=300e3, channels=two), samples, volts * samples[:, None], 300e3, "m/s", 1
    fine_hz, length_s, start_hz, stop_hz, fade_s = 4e6, 2e-3, 12e3, 78e3, 0.2e-3
    time_s = (np.arange(round(length_s * fine_hz)) + 0.5) / fine_hz
    sweep = SweepDrive(start_hz=start_hz, stop_hz=stop_hz, duration_ms=length_s * 1e3, amplitude_v=30.0, channels=two)
    if kind == "linear":
        sweep = msgspec.structs.replace(sweep, spacing="linear", fade_ms=fade_s * 1e3)
        phase = start_hz * time_s + (stop_hz - start_hz) * time_s**2 / (2 * length_s)
        gain = np.sin(np.pi / 2 * np.clip(np.minimum(time_s, length_s - time_s) / fade_s, 0, 1)) ** 2
        return sweep, None, volts * 30 * gain * np.sin(2 * np.pi * phase), fine_hz, "m", 0
    rise = np.log(stop_hz / start_hz)
    phase = start_hz * length_s / rise * np.expm1(rise * time_s / length_s)
    return sweep, None, volts * 30 * np.sin(2 * np.pi * phase), fine_hz, "m/s^2", 2


@pytest.mark.parametrize(
    ("kind", "repetitions", "bound"),
    [
        ("words", 4, 4e-3),
        ("exponential", 4, 4e-3),
        ("impulses", 16, 4e-3),
        *(pytest.param(*long, marks=pytest.mark.slow) for long in (("noise", 16, 8e-3), ("linear", 4, 6e-3), ("samples", 8, 8e-3))),
    ],
)
def test_every_drive_gives_the_true_responses(tmp_path, kind, repetitions, bound):
    """40 dB of noise on every record. The bound lies between what noise leaves and a sensitivity that is 1 % wrong."""
    channels = CHANNELS
    if kind == "words":
        drive, array, unit, records = WORDS, packed(words()), "m/s", clean()
    else:
        drive, array, volts, rate_hz, unit, order = one_at_a_time(kind)
        records = displacement(volts, rate_hz, times_s(), order)[:, :, None]
        channels = np.array([0, 5])
    records = noisy(np.repeat(records, repetitions, axis=2))
    found = learned(tmp_path, drive, array, records, unit, repetitions=repetitions).responses
    error, wrong = error_of(found, channels), error_of(found, channels, 1.01)
    of_noise = np.sqrt((found.noise[:, channels] ** 2).mean() / (found.responses[:, :, channels] ** 2).mean())
    least = np.nanmin(found.coherence[:, channels])
    print(f"{kind}: error {error:.2e} (of its residual {of_noise:.2e}), 1 % off {wrong:.2e}; coherence {least:.3f}")
    assert error < bound < wrong
    assert 0.5 * error < of_noise < 2 * error
    assert found.known[:, channels].all()
    assert not found.known[:, np.setdiff1d(np.arange(32), channels)].any()


@pytest.mark.slow
def test_a_wrong_sensitivity_is_a_wrong_response_by_as_much(tmp_path):
    """The comparison above, shown to see 1 %: the same volts, read with the right sensitivity and with one 1 % too small."""
    volts = noisy(clean() * 0.125)
    right = error_of(learned(tmp_path / "right", WORDS, packed(words()), volts, "V", v_per_m_s=0.125).responses)
    wrong = error_of(learned(tmp_path / "wrong", WORDS, packed(words()), volts, "V", v_per_m_s=0.12375).responses)
    print(f"relative error {right:.2e}; sensitivity 1 % wrong {wrong:.2e}")
    assert right < 8e-3 < wrong


def found_with(folder, ppm=0.0, late_s=0.0, stated=True, accept=(), **table):
    return learned(folder, WORDS, packed(words()), noisy(clean(ppm, late_s)), stated=stated, **table)


@pytest.mark.parametrize(("ppm", "late_us"), [(100.0, 5.0), pytest.param(-100.0, -5.0, marks=pytest.mark.slow)])
def test_clock_and_delay_are_found_named_and_corrected(tmp_path, ppm, late_us):
    """5 us to 2.5 us, which is what edges and a patch as large as half a wave leave open; the clock to 5 ppm."""
    found = found_with(tmp_path, ppm, late_us * 1e-6)
    print(f"clock {found.clock.ppm:.1f} ppm of {ppm:g}, delay {found.delay_s * 1e6:.2f} us of {-late_us:g}")
    assert found.clock.reported
    assert abs(found.clock.ppm - ppm) < 5
    assert abs(found.delay_s * 1e6 + late_us) < 2.5
    said = {one.kind: one.message for one in found.findings}
    assert ("fast" if ppm > 0 else "slow") in said["clock"]
    assert ("earlier" if late_us > 0 else "later") in said["delay"]
    found.require()


@pytest.mark.slow
def test_an_unknown_delay_is_found(tmp_path):
    """The recorder began 0.2 ms before the drive, and nobody says so."""
    found = found_with(tmp_path, stated=False)
    print(f"delay {found.delay_s * 1e6:.2f} us of {-FIRST_S * 1e6:.0f}")
    assert abs(found.delay_s + FIRST_S) < 2.5e-6
    assert error_of(found.responses) > 0.01  # it is right to a microsecond, not exactly


@pytest.mark.slow
def test_records_that_run_through_tell_the_clock_to_a_tenth_of_a_ppm(tmp_path):
    """One record of all 12 emissions, 8 ms apart."""
    period = round(8e-3 * RATE_HZ)
    running = np.zeros((len(NAMES), 12, period))
    for emission in range(12):
        start_s = emission * 8e-3
        first = np.ceil(start_s * RATE_HZ * (1 + 37e-6))
        at_s = (emission * period + np.arange(period)) / (RATE_HZ * (1 + 37e-6)) - start_s
        running[:, emission] = displacement(volts_of(words()[[emission]]), BIT_CLOCK_HZ, at_s, order=1)[:, 0]
        assert first >= 0
    records = noisy(running.reshape(len(NAMES), -1))
    found = learned(tmp_path, WORDS, packed(words()), records, period_ms=8.0, first_sample_us=0.0)
    print(f"clock {found.clock.ppm:.2f} ppm of 37, relative error {error_of(found.responses):.2e}")
    assert abs(found.clock.ppm - 37) < 0.3
    assert error_of(found.responses) < 8e-3


def test_everything_that_is_wrong_is_named_with_channel_and_point(tmp_path):
    """All at once: a dead, an inverted and two swapped channels, a clipped, a missing and a noisy point."""
    played = words().copy()
    played[:, 2] = 0
    played[:, [3, 6]] = played[:, [6, 3]]
    volts = volts_of(played)
    volts[:, 5] *= -1
    records = displacement(volts, BIT_CLOCK_HZ, times_s(), order=1)[:, :, None]
    records = noisy(np.repeat(records, 2, axis=2))
    records[8] += np.random.default_rng(7).normal(size=records[8].shape) * records.std() * 5
    limit = 0.4 * abs(records[4]).max()
    records[4] = np.clip(records[4], -limit, limit)
    found = learned(
        tmp_path,
        WORDS,
        packed(words()),
        [None if name == "2" else one for name, one in zip(NAMES, records, strict=True)],
        repetitions=2,
    )
    said = {}
    for one in found.findings:
        said.setdefault(one.kind, []).append(one)
        print(one.kind, one.message)
    assert [one.channels for one in said["dead"]] == [(2,)]
    assert [one.channels for one in said["swapped"]] == [(3, 6)]
    assert [one.channels for one in said["inverted"]] == [(5,)]
    assert [one.points for one in said["clipped"]] == [("5",)]
    assert [one.points for one in said["missing"]] == [("2",)]
    assert [one.points for one in said["noisy"]] == [("9",)]
    assert not {2, 3, 5, 6} & {channel for one in said.pop("undecided", ()) for channel in one.channels}  # 8 mm from the edges
    assert set(said) == {"dead", "swapped", "inverted", "clipped", "missing", "noisy"}
    assert not found.responses.known[1].any()
    with pytest.raises(
        CalibrationError, match=r"channel 2 is dead.*channels 3 and 6 look swapped.*channel 5 looks inverted.*point 5;"
    ) as error:
        found.require()
    assert error.value.exit_code == 78
    with pytest.raises(CalibrationError, match=r"channel 5 looks inverted") as error:
        found.require(["dead", "swapped", "clipped"])
    assert "dead" not in str(error.value)
    found.require(["dead", "swapped", "clipped", "inverted"])


@pytest.mark.slow
def test_the_example_of_the_readme_is_learned(tmp_path, monkeypatch):
    """Folder by hand: the block as it stands, then what was convolved with is found again."""
    monkeypatch.chdir(tmp_path)
    text = (Path(calibration.__file__).parent / "README.md").read_text()
    (block,) = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    names = {}
    exec(block, names)
    found = learn(tmp_path / names["folder"], names["board"])
    found.require()
    bins = RawBins.of(names["board"], 1999 / 500e3 + 2e-6)
    true = names["ResponseModel"](names["board"]).responses(names["places_mm"] * 1e-3)
    gain = np.interp(np.fft.rfftfreq(8192, 2e-6), bins.frequency_hz, bins.gain, 0, 0)[:, None]
    true = np.fft.irfft(np.fft.rfft(true, 8192, axis=1) * gain, 8192, axis=1)[:, :1000]
    error = np.linalg.norm(found.responses.responses[:, :1000] - true) / np.linalg.norm(true)
    print(f"relative error {error:.2e}")
    assert error < 0.02


def test_records_and_drives_that_tell_nothing_are_refused(tmp_path):
    """Before anything is deconvolved, with what to do."""
    sweep = SweepDrive(start_hz=1e3, stop_hz=2e3, duration_ms=2, amplitude_v=30.0, channels=(0, 5), fade_ms=0.5)
    for number, (drive, array, records, said) in enumerate(
        (
            (WORDS, packed(words()), clean()[..., :300], r"records of 300 samples end 1.3 ms after the start of a drive of 1.2 ms"),
            (WORDS, packed(words()[:4]), clean()[:, :4], r"4 emissions do not determine 8 channels that they drive together"),
            (sweep, None, clean()[:, :2], r"channel 0 played holds .* of its energy in the band from 12 to 78 kHz"),
            (WORDS, packed(words()), clean() * 1e15, r"point 1: samples up to .* m/s: wrong unit"),
        )
    ):
        with pytest.raises(CalibrationError, match=said):
            learned(tmp_path / str(number), drive, array, records)
    some = np.arange(40) % 20 < 13
    assert _tapered(some[::-1], 3) == pytest.approx(_tapered(some, 3)[::-1]), "alike at both ends"
    bins = RawBins.of(board(), RECORD / RATE_HZ)
    inside = (bins.frequency_hz > board().waveform.band_low_hz) & (bins.frequency_hz < board().waveform.band_high_hz)
    assert inside.sum() > 100
    assert (bins.gain[inside] == 1).all()

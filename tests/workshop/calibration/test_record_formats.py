"""UFF files as analysers write them: a time for each sample, lines filled up; what is damaged is refused in words."""

import struct
import warnings
import wave
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from tables import each_row

from controller.errors import CalibrationError
from controller.workshop.calibration.records.record_formats import load_array, load_uff, load_wav

SAMPLES = [1e-3 * number for number in range(1, 11)]
TIMES_S = [1e-6 * number for number in range(10)]


def uff(data, *, count=10, even=1, step_s=1e-6):
    """A file with one set of type 58, written here by the words of the format's description."""
    head = f"{-1:6}\n{58:6}\n" + "NONE\n" * 5
    head += f"{1:5}{1:10}{1:5}{0:10} {'NONE':10}{7:10}{3:4} {'NONE':10}{1:10}{3:4}\n"
    head += f"{2:10}{count:10}{even:10}{0.0:13.5E}{step_s:13.5E}{0.0:13.5E}\n"
    head += "".join(f"{kind:10}{0:5}{0:5}{0:5} {'NONE':20} {'NONE':20}\n" for kind in (17, 11, 0, 0))
    lines = ["".join(f"{value:13.5E}" for value in data[first : first + 6]) for first in range(0, len(data), 6)]
    return head + "\n".join(lines) + f"\n{-1:6}\n"


def with_times(times_s):
    return [value for pair in zip(times_s, SAMPLES, strict=True) for value in pair]


@pytest.fixture
def load(tmp_path):
    def loaded(text):
        (tmp_path / "one.uff").write_text(text)
        return load_uff(tmp_path / "one.uff", 1e6, "m/s").records

    return loaded


@each_row(
    "text",
    [
        uff(SAMPLES),
        uff([*SAMPLES, 0.0, 0.0]),
        uff([*SAMPLES, 5.0, 6.0]),
        uff([*SAMPLES, *[0.0] * 20]),
        uff(with_times(TIMES_S), even=0, step_s=0.0),
        uff(with_times([0.5 + time_s for time_s in TIMES_S]), even=0, step_s=0.0),
    ],
    ids=["plain", "last line filled up", "by other than zeros", "lines of zeros", "a time for each", "which begin late"],
)
def test_the_samples_are_read_as_many_as_are_stated(load, text):
    (samples,) = load(text).values()
    assert samples.tolist() == pytest.approx(SAMPLES)


@each_row(
    ("text", "said"),
    [
        (uff(with_times([*TIMES_S[:5], *(time_s + 3e-7 for time_s in TIMES_S[5:])]), even=0), "not evenly spaced in time"),
        (uff(with_times(TIMES_S[::-1]), even=0), "not evenly spaced in time"),
        (uff(with_times([0.0] * 10), even=0), "not evenly spaced in time"),
        (uff(with_times([2 * time_s for time_s in TIMES_S]), even=0), "500000 samples a second"),
        (uff(SAMPLES, step_s=0.0), "gives 0 s from sample to sample"),
        (uff(SAMPLES, count=12), "10 real samples, not 12"),
        (uff([*SAMPLES, *SAMPLES]), "20 real samples, not 10"),
        (uff(SAMPLES[:1], count=1, even=0), "cannot be read|times of 1 samples"),
        (uff(SAMPLES).replace("1.00000E-03", "1.00000X-03"), "cannot be read"),
    ],
)
def test_what_cannot_be_meant_is_refused_in_words(load, text, said):
    with pytest.raises(CalibrationError, match=rf"one\.uff.*({said})"):
        load(text)


@pytest.fixture
def recorded(tmp_path):
    """A file of two tracks of 16 bits, at 200 kHz."""
    file = tmp_path / "heard.wav"
    with wave.open(str(file), "wb") as heard:
        heard.setnchannels(2)
        heard.setsampwidth(2)
        heard.setframerate(200_000)
        heard.writeframes(struct.pack("<6h", 1, -1, 2, -2, 3, -3))
    return file


@pytest.mark.parametrize("filters", ["ignore", "default", "error"])
def test_a_file_that_is_cut_short_is_refused_whatever_python_does_with_warnings(recorded, filters):
    whole = recorded.read_bytes()
    recorded.write_bytes(whole[:4] + struct.pack("<I", len(whole) + 100) + whole[8:])  # a part behind the samples is missing
    with warnings.catch_warnings():
        warnings.simplefilter(filters)
        with pytest.raises(CalibrationError, match=r"heard.wav: .*cut short.*copy it again"):
            load_wav(recorded, 1, 200e3)
        recorded.write_bytes(whole)
        assert [load_wav(recorded, track, 200e3).tolist() for track in (1, 2)] == [[1, 2, 3], [-1, -2, -3]]


@each_row(("track", "rate_hz", "said"), [(0, 200e3, "track = 0"), (3, 200e3, "track = 3, and the file has 2"), (1, 201e3, "201")])
def test_another_track_or_rate_is_refused(recorded, track, rate_hz, said):
    with pytest.raises(CalibrationError, match=said):
        load_wav(recorded, track, rate_hz)


def test_no_two_threads_parse_the_header_of_an_array_at_once(tmp_path, monkeypatch):
    """Which may fail in Python 3.11 and 3.12, by a state of all threads (python/cpython#106905)."""
    within, most, load = [], [], np.load

    def counted(*arguments, **options):
        within.append(arguments)
        most.append(len(within))
        try:
            return load(*arguments, **options)
        finally:
            within.pop()

    monkeypatch.setattr(np, "load", counted)
    np.save(tmp_path / "one.npy", np.arange(3.0))
    with ThreadPoolExecutor(4) as pool:
        arrays = list(pool.map(load_array, [tmp_path / "one.npy"] * 400))
    assert max(most) == 1
    assert len(most) == len(arrays) == 400

"""Plates that no constant of `expectation.py` was fitted to: measured, interpolated, and played under fingers after a while.

A plate has edges and a theory that are not the board's (Ritz's method, Mindlin's shear), the tolerances of production, glue that
ages, and a temperature that a sensor says with an error, or no sensor. It is measured with noise by a sensor whose sensitivity is
off, as in a calibration; the bank is what the product's own interpolation makes of that. The finger's place is predicted with an
error, and nobody knows its mass. A record has what the device knows of all this beside what is true.
"""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final, NamedTuple, Self

import msgspec
import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats
from controller.device.bank.file_format import creator
from controller.device.bank.provenance import Provenance
from controller.device.board.board import Board
from controller.device.board.plate.plate import Edges, Foam
from controller.workshop.bank_builder.said_amplitude import PLACES, foreseen_um, over_places
from controller.workshop.calibration.interpolation.interpolate import interpolate
from controller.workshop.calibration.learned import LearnedResponses
from controller.workshop.calibration.point_plan import scattered_count, scattered_points
from controller.workshop.physics.felt import AROUND_S, FeltLoad, felt_by_motion_um
from controller.workshop.physics.focusing import balanced_weights, focus
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.modes.retuned import drifted
from controller.workshop.physics.pad_motion import PadMotion
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.word_capture import volts_above_idle
from controller.workshop.tolerance.tolerances import Tolerances, draw

KINDS: Final = ("simply supported", "free", "clamped", "foam", "mixed")  # edges; all but the first by Mindlin's theory
RECORD_EMISSIONS: Final = 1.25  # length of a record, in emissions
MARGIN_M: Final = 5e-3  # of places from the edges
SNR_DB: Final = 30.0  # of each response
SENSITIVITY: Final = 0.02  # error of the sensor's sensitivity, which all records have in common
CALIBRATED_C: Final = (18.0, 28.0)  # temperature of the plate while it is measured
WARMER_K: Final = 10.0  # at most, since then, to either side
READING_K: Final = 0.5  # error of the temperature sensor
COEFFICIENT: Final = 0.1  # relative error of the coefficient that the host knows
AGE_D: Final = (1.0, 3650.0)
AGED: Final = 0.02  # change of all moments in a tenfold of days
GLUE: Final = 0.03  # change of each channel's moment, by its glue
PREDICTED_M: Final = 0.3e-3  # error of a finger's predicted place along each axis
MASS_KG: Final = (30e-6, 150e-6)
DAMPING: Final = (0.5, 1.5)
APART_M: Final = 12e-3  # of fingers


class PlateRecord(NamedTuple):
    """A plate: what is known of it, and what is true."""

    kind: float  # number in `KINDS`
    kept: float  # median share that points left out keep
    foreseen_mean: float  # as `Provenance.foreseen`
    foreseen_deviation: float
    low_um: float  # amplitudes that the bank foresees, as `over_places`
    middle_um: float
    high_um: float
    bank_c: float  # temperature of the plate when it was measured
    reading_c: float  # what the sensor says now; NaN without a sensor
    reference_c: float  # to which the bit clock is scaled
    age_d: float
    foci: float  # fingers that are played for
    fingers: float  # on the plate
    mass_kg: float  # of the first finger, for which the truth is
    free_um: float  # at T at the focus of that finger, without any finger on the plate
    felt_um: float  # by the finger
    other_free_um: float  # the same two from the bank of another plate of this kind
    other_felt_um: float
    model_free_um: float  # and from that of the board's model
    model_felt_um: float
    model_middle_um: float  # that the model's bank foresees


@dataclass(frozen=True)
class Unseen:
    """All that determines the records: hashable, and the function that workers compute."""

    board: Board
    tolerances: Tolerances
    seed: int = 1000  # other plates than those of `Study`
    others: bool = True  # whether banks of other plates are played too; else `other_…` are NaN, and a plate takes half the time

    def __call__(self, items: Sequence[int]) -> list[bytes]:
        """Records of plates, as float64."""
        return [np.array(self.record(number), np.float64).tobytes() for number in items]

    def name(self) -> str:
        """Hash of all that determines the results, and of the code that draws and plays."""
        board = self.board
        of_board = (board.plate, board.actuators, board.driver, board.waveform, board.bank, board.temperature)
        digest = hashlib.sha256(msgspec.json.encode([*of_board, self.tolerances, self.seed, self.others, creator()]))
        digest.update(Path(__file__).read_bytes())
        return digest.hexdigest()[:16]

    def record(self, number: int) -> PlateRecord:
        """Measure, interpolate and play one plate."""
        random = np.random.default_rng([self.seed, number])
        plate = _Plate.of(self, number, random)
        bank_c, age_d = random.uniform(*CALIBRATED_C), float(np.exp(random.uniform(*np.log(AGE_D))))
        source = plate.bank(random)
        places_m, foci, loads = self._fingers(random)
        bank_places = self._places(random, PLACES)
        low_um, middle_um, high_um = over_places(self._foreseen(source.drive_order_responses(bank_places)))
        detuned, reading_c, reference_c = _detuned(self.board, bank_c, random)
        aged = np.exp(AGED * np.log10(age_d) * random.standard_normal() + GLUE * random.standard_normal(32))
        played = _Played(plate, detuned, aged, places_m, loads, PREDICTED_M * random.standard_normal(places_m.shape))
        model = ResponseModel(self.board)
        provenance = source.provenance
        assert provenance.kept is not None
        assert provenance.foreseen is not None
        other_um = (np.nan, np.nan)
        if self.others:
            other = _Plate.of(self, number, np.random.default_rng([self.seed, number, 1]), other=True)
            other_um = played.by(other.drive_order_responses(places_m[:foci]))
        return PlateRecord._make([
            number % len(KINDS),
            provenance.kept[0],
            *provenance.foreseen,
            low_um,
            middle_um,
            high_um,
            bank_c,
            reading_c,
            reference_c,
            age_d,
            foci,
            len(places_m),
            loads[0].mass_kg,
            *played.by(source.drive_order_responses(places_m[:foci])),
            *other_um,
            *played.by(model.drive_order_responses(places_m[:foci])),
            float(np.median(self._foreseen(model.drive_order_responses(bank_places)))),
        ])  # fmt: skip

    def _foreseen(self, responses: NDArray[np.floating]) -> Floats:
        return foreseen_um(responses, self.board.driver.supply_v)

    def _places(self, random: np.random.Generator, count: int) -> Floats:
        sides = np.array([self.board.plate.length_m, self.board.plate.width_m])
        return random.uniform(MARGIN_M, sides - MARGIN_M, (count, 2))

    def _fingers(self, random: np.random.Generator) -> tuple[Floats, int, list[FeltLoad]]:
        """Places of fingers, how many of them, the first, are played for, and their loads."""
        foci = int(random.choice([1, 2, 3, 4], p=[0.6, 0.2, 0.1, 0.1]))
        places: list[Floats] = []
        while len(places) < foci + random.integers(0, 3):
            place = self._places(random, 1)[0]
            if all(np.hypot(*(place - other)) > APART_M for other in places):
                places.append(place)
        loads = [FeltLoad(random.uniform(*MASS_KG), random.uniform(*DAMPING), 1e3) for _ in places]
        return np.array(places), foci, loads


class _Plate:
    """One panel: its own board, modes and moments."""

    def __init__(self, study: Unseen, board: Board, gain: Floats) -> None:
        self.study, self.board, self.gain = study, board, gain
        self.modes = modes_of(board)

    @classmethod
    def of(cls, study: Unseen, number: int, random: np.random.Generator, *, other: bool = False) -> Self:
        drawn = draw(study.board, study.tolerances, study.seed + int(other), number)
        edges = _edges(number, random)
        plate = msgspec.structs.replace(drawn.board.plate, theory="mindlin" if number % len(KINDS) else "kirchhoff", **edges)
        capacitance = drawn.board.driver.capacitance_f * random.uniform(0.7, 1.3)
        driver = msgspec.structs.replace(drawn.board.driver, capacitance_f=capacitance)
        return cls(study, msgspec.structs.replace(drawn.board, plate=plate, driver=driver), drawn.gain)

    def drive_order_responses(self, places_m: Floats) -> Floats:
        """True responses of the band."""
        model = ResponseModel(self.board, modes=self.modes)
        return np.asarray(model.drive_order_responses(places_m), np.float64) * self.gain

    def bank(self, random: np.random.Generator):  # type: ignore[no-untyped-def]
        """Responses from measurements, interpolated, as the product makes a bank."""
        board = self.study.board
        count = round(scattered_count(board) * random.uniform(0.8, 1.1))
        points_m = scattered_points(board, count, 0.0, seed=int(random.integers(1 << 30)))
        recorder = ResponseModel(self.board, modes=self.modes)
        recorder.samples = round(RECORD_EMISSIONS * board.waveform.samples)
        records = recorder.responses(points_m, dtype=np.float32) * self.gain
        used = [actuator.channel for actuator in board.actuators]
        noise = 10 ** (-SNR_DB / 20) * records[:, :, used].std()
        records = records * np.exp(SENSITIVITY * random.standard_normal())
        records[:, :, used] += noise * random.standard_normal((*records.shape[:2], len(used)))
        known = np.zeros((count, 32), bool)
        known[:, used] = True
        nothing = np.full(known.shape, np.nan)
        made, clock_hz = Provenance("measured", ""), board.waveform.bit_clock_hz
        learned = LearnedResponses(points_m, records.astype(np.float32), known, known * 1.0, nothing, clock_hz, made)
        return interpolate(board, learned, exact=True)[0]


class _Played:
    """A plate after a while, with fingers on it."""

    def __init__(self, plate: _Plate, detuned: float, aged: Floats, places_m: Floats, loads: list[FeltLoad], off_m: Floats) -> None:
        board, modes = plate.board, drifted(plate.modes, detuned)
        self._board, self._gain = board, plate.gain * aged
        samples = board.waveform.samples
        # What the first finger feels; the others are there all the same
        self._pads = PadMotion(board, modes, places_m + off_m, loads, loads[0].pad_mm * 1e-3, samples, AROUND_S)
        self._free = np.asarray(ResponseModel(board, modes=modes).responses(places_m[:1]))[0, ::-1]

    def by(self, responses: NDArray[np.floating]) -> tuple[float, float]:
        """Displacement at the first focus without fingers, and what the first finger feels, in um, by words from responses."""
        responses = np.asarray(responses, np.float64)
        words = focus(responses, balanced_weights(responses).tolist(), self._board.idle_word)
        volts = volts_above_idle(self._board, words) * self._gain
        free_um = 1e6 * abs(float(np.vdot(volts, self._free)))
        felt_um = felt_by_motion_um(self._pads, volts[None], self._board.waveform.bit_period_s)[0, 0]
        return free_um, float(felt_um)


def _edges(number: int, random: np.random.Generator) -> dict[str, object]:
    kind = KINDS[number % len(KINDS)]
    if kind == "foam":
        stiffness = float(np.exp(random.uniform(*np.log((1e8, 1e9)))))
        return {"edges": "foam", "foam": Foam(stiffness, 3.0)}
    if kind == "mixed":
        sides = random.choice(["simply_supported", "clamped", "free"], 4).tolist()
        return {"edges": Edges(*sides)}
    return {"edges": kind.replace(" ", "_")}


def _detuned(board: Board, bank_c: float, random: np.random.Generator) -> tuple[float, float, float]:
    """By what share the plate's frequencies are too high for the bit clock, what its sensor says, and the reference."""
    coefficient = -2e-4 if board.temperature is None else board.temperature.coefficient_per_k
    has_sensor = random.uniform() < 0.5
    reference_c = bank_c if random.uniform() < 0.8 else 23.0  # else nobody has set it as `calibrate bank` says
    now_c = bank_c + random.uniform(-WARMER_K, WARMER_K)
    frequencies = 1 + coefficient * (1 + COEFFICIENT * random.standard_normal()) * (now_c - bank_c)
    if not has_sensor:
        return frequencies - 1, float("nan"), reference_c
    reading_c = now_c + READING_K * random.standard_normal()
    return frequencies / (1 + coefficient * (reading_c - reference_c)) - 1, reading_c, reference_c

"""What the device does today: entries of the bank, responses composed by the kernel, shorter emissions, resident waveforms."""

from collections.abc import Iterator, Sequence
from functools import partial

from controller.arrays import Words
from controller.device import kernel
from controller.device.bank.reader import Bank
from controller.device.fpga.frames import ReadyFrames, Waveform
from controller.device.kernel import Point, unpack_loads, words_twin
from controller.device.waveforms.composition import Composer
from controller.device.waveforms.selection import Key, Selection
from controller.workshop.benchmark.methods.candidate import RESIDENT_WIRE_BYTES, Candidate, Place, wire_bytes, words_of_buffer
from controller.workshop.benchmark.methods.laboratory import Laboratory

CELL_PITCHES_MM = (1.0, 2.5, 5.0, 10.0)
PITCHES_MM = (1.0, 2.5, 5.0)
SHARES = (0.25, 0.5, 0.75, 1.0)  # of the board's emission


def candidates(laboratory: Laboratory) -> Iterator[Candidate]:
    """All of them."""
    board = laboratory.board
    samples = board.waveform.samples
    for pitch_mm in CELL_PITCHES_MM:
        bank = laboratory.bank(pitch_mm * 1e-3)
        drive_bytes = bank.grid.cells * bank.sections["drive"].stride
        nearest = partial(nearest_entry, bank)
        yield Candidate("nearest entry", f"{pitch_mm:g} mm", nearest, drive_bytes, wire_bytes(samples), 1, words_of=words_of)
    for pitch_mm in PITCHES_MM:
        bank = laboratory.bank(pitch_mm * 1e-3)
        memory = bank.grid.cells * (bank.sections["drive"].stride + bank.sections["response"].stride)
        selection, setting = Selection(bank, board.bank.snap_mm * 1e-3, board.idle_word), f"{pitch_mm:g} mm"
        selected = partial(
            Candidate, setting=setting, memory_bytes=memory, wire_bytes=wire_bytes(samples), free_polarity=True, words_of=words_of
        )
        if kernel.COMPILED:
            yield selected("device, compiled kernel", compose=partial(selected_waveform, selection))
        yield selected("device, NumPy twin", compose=SelectedByTwin(selection, bank, board.idle_word))
        if pitch_mm == board.bank.pitch_mm:
            for last in (round(share * samples) for share in SHARES):
                yield selected(
                    "device, shorter emission",
                    setting=f"{1e3 * last / board.waveform.bit_clock_hz:g} ms",
                    compose=partial(selected_waveform, selection),
                    wire_bytes=wire_bytes(last),
                    words_of=partial(_end_of, last),
                )
            yield selected("device, another finger still", compose=partial(keeping_still, selection), keeps_nulls=True)
            yield selected(
                "resident waveform",
                setting=f"{1e3 * selection.lattice_m:g} mm lattice",
                compose=Resident(selection),
                wire_bytes=RESIDENT_WIRE_BYTES,
                words_of=partial(_of_resident, selection),
            )


def nearest_entry(bank: Bank, points: Sequence[Point]) -> Waveform:
    """LOAD frames of the cell nearest to a single point."""
    ((x_m, y_m, _),) = points
    return ReadyFrames(*bank.drive.frames(bank.grid.nearest(x_m, y_m)[0]))


def selected_waveform(selection: Selection, points: Sequence[Point]) -> Waveform:
    """What the loop plays: places on the lattice, composed; of a lone finger near a cell that cell's frames."""
    return selection.waveform(selection.key(points))


def keeping_still(selection: Selection, points: Sequence[Point], nulls: Sequence[Place]) -> Waveform:
    """The same for fingers beside others that shall feel nothing: composed; the bank's frames where the others are too near."""
    return selection.waveform(selection.null_key(points, nulls))


class SelectedByTwin:
    """What `selected_waveform` gives, with the NumPy twin of the kernel, whether or not there is a compiled one."""

    def __init__(self, selection: Selection, bank: Bank, idle_word: int) -> None:
        self._selection, self._bank, self._composer = selection, bank, Composer(bank, idle_word)

    def __call__(self, points: Sequence[Point]) -> Waveform:
        """The bank's frames, or composed words."""
        key = self._selection.key(points)
        if isinstance(key, int):
            return self._selection.waveform(key)
        own, bank, points = self._composer, self._bank, self._selection.foci(key)
        buffers = own._buffers._replace(response=bank.responses.section)
        while (cell := words_twin.compose(own._words, own._room, buffers, points)) >= 0:  # what `Composer` gives to its kernel
            bank.responses.check(cell)
        return own._view


class Resident:
    """The FPGA still holds the waveform of the same points on the lattice: only its key is found again."""

    def __init__(self, selection: Selection) -> None:
        self._selection = selection
        self._held: dict[Key, int] = {}

    def __call__(self, points: Sequence[Point]) -> tuple[Key, int]:
        """Key and slot of the waveform."""
        key = self._selection.key(points)
        return key, self._held.setdefault(key, len(self._held))


def words_of(waveform: Waveform) -> Words:
    """A copy of the drive words of a waveform."""
    if not isinstance(waveform, ReadyFrames):
        return words_of_buffer(waveform)
    size = next(size for size in range(4, 4 * kernel.MAX_SAMPLES, 4) if kernel.load_frames_bytes(size) == len(waveform.frames))
    words = bytearray(size)
    unpack_loads(words, waveform.frames)
    return words_of_buffer(words)


def _end_of(samples: int, waveform: Waveform) -> Words:
    """Only the end of a waveform is sent: the waves have less time to build up."""
    return words_of(waveform)[-samples:]


def _of_resident(selection: Selection, found: tuple[Key, int]) -> Words:
    """Words that were sent when the waveform was uploaded."""
    return words_of(selection.waveform(found[0]))

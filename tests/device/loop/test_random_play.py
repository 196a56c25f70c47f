"""Random fingers, scenes, boards and mishaps through the whole loop to the gateware's model, evaluated by what must always hold.

Virtual time: each seed is one run, the same every time. What is checked: nothing is raised; what the slot cache takes for
resident lies in the FPGA's slots, bit for bit; the pins play exactly what was meant; of each emission that became due a finger
feels one at most, and none that became due before it was lifted; and every one of them is counted as what became of it.
"""

import random
import zlib
from collections import Counter

import msgspec
import numpy as np
import pytest
from pins_and_counters import Damage, Notes, emissions_on_pins, match

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.preparation import PreparedScene
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.device.waveforms.selection import Selection
from controller.errors import ControllerError
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.simulated_link import open_simulated

LENGTH_MM, WIDTH_MM = 210.0, 148.0
START_S = 0.1
CHEAP, LONG = 10, 3000  # seeds of the normal suite, and of the long form


def random_board(rng, board):
    """One with few slots or many, a slow wire or a fast one, a tight duty limit or none, a panel with ghosts or without."""
    return msgspec.structs.replace(
        board,
        link=msgspec.structs.replace(
            board.link, slots=rng.choice([1, 2, 3, 4, 4, 16]), sck_hz=rng.choice([25_000_000, 25_000_000, 8_000_000])
        ),
        limits=msgspec.structs.replace(board.limits, max_duty=rng.choice([1.0, 1.0, 0.5, 0.2])),
        touch=msgspec.structs.replace(
            board.touch,
            ghost_ms=rng.choice([0.0, 0.0, 30.0]),
            confirm_reports=rng.choice([1, 1, 2]),
            lag_ms=rng.choice([0.0, 0.0, 20.0]),
        ),
    )


def random_scene(rng, board):
    """TOML of up to five regions, each with up to three effects."""
    most_hz = board.limits.max_duty / board.waveform.duration_s
    regions = []
    spot_rates = [rng.choice([2.0, 20.0, 0.45 * most_hz, most_hz]) for _ in range(2)]
    for number in range(rng.randint(1, 5)):
        last = number and rng.random() < 0.3
        shape = rng.choice(
            [
                'shape = "plate"',
                f'shape = "circle"\nx_mm = {rng.uniform(20, 190):.1f}\ny_mm = {rng.uniform(20, 128):.1f}'
                f"\nradius_mm = {rng.uniform(3, 20):.1f}",
                f'shape = "rectangle"\nx_mm = {rng.uniform(0, 100):.1f}\ny_mm = {rng.uniform(0, 70):.1f}'
                f"\nwidth_mm = {rng.uniform(10, 105):.1f}\nheight_mm = {rng.uniform(10, 75):.1f}",
            ]
        )
        if last:
            shape = 'shape = "plate"'
        rate_hz = rng.uniform(3, 0.9 * most_hz)
        effects = {
            "click": '"click"',
            "release": '{ effect = "click", when = "release", amplitude = 0.5 }',
            "double": '"double_click"',
            "edge": '"edge"',
            "lines": f'{{ effect = "detent", spacing_mm = {rng.uniform(0.5, 12):.2f} }}',
            "way": f'{{ effect = "texture", spacing_mm = {rng.choice([0.5, 2.0, 2.0, rng.uniform(0.3, 10)]):.2f} }}',
            "train": f'{{ effect = "train", rate_hz = {rate_hz:.2f}, duration_ms = {rng.uniform(50, 600):.0f} }}',
            "slide": f'{{ effect = "train", when = "enter", rate_hz = {rate_hz:.2f}, count = {rng.randint(1, 9)} }}',
            "always": f'{{ effect = "always", rate_hz = {rng.choice(spot_rates):.3f} }}',
        }
        chosen = rng.sample(sorted(effects), rng.randint(1, 3))
        if "train" in chosen and "double" in chosen:
            chosen.remove("double")
        more = 'policy = "alternate"\n' if rng.random() < 0.15 else ""
        if rng.random() < 0.3:
            more += f"amplitude = {rng.uniform(0.4, 1):.2f}\n"
        listed = ", ".join(effects[name] for name in chosen)
        regions.append(f'[[regions]]\nname = "r{number}"\n{shape}\n{more}effects = [{listed}]\n')
        if "plate" in shape:
            break
    return "".join(regions)


def random_reports(rng, duration_s):
    """Reports of up to five slots: taps, strokes straight and to and fro, jumps, flicker; a panel of even or uneven period."""
    period_s = rng.choice([0.002, 0.008, 0.01, 0.016])
    uneven = rng.random() < 0.3
    reports = {}
    times = []
    time_s = 0.0
    while time_s < duration_s:
        times.append(round(time_s, 6))
        time_s += period_s * (rng.uniform(0.3, 1.7) if uneven else 1.0)
    for slot in range(rng.choice([1, 1, 1, 2, 2, 3, 5])):
        k = rng.randrange(0, max(len(times) // 2, 1))
        while k < len(times):
            kind = rng.choice(["tap", "line", "fro", "fro", "jumps", "rest", "circle"])
            steps = 1 if rng.random() < 0.1 else round(rng.uniform(0.005, 0.6) / period_s)
            x, y = rng.uniform(3, LENGTH_MM - 3), rng.uniform(3, WIDTH_MM - 3)
            speed = rng.choice([10, 40, 80, 150, 300, 800]) * period_s
            angle = rng.uniform(0, 2 * np.pi)
            dx, dy, turn = speed * np.cos(angle), speed * np.sin(angle), rng.uniform(0.03, 0.3) / period_s
            for step in range(steps):
                if k >= len(times):
                    break
                reports.setdefault(times[k], {})[slot] = (min(max(x, 0), LENGTH_MM), min(max(y, 0), WIDTH_MM))
                if kind in ("line", "fro"):
                    if kind == "fro" and step % max(round(turn), 1) == 0:
                        dx, dy = -dx, -dy
                    x, y = x + dx, y + dy
                elif kind == "circle":
                    angle += 2 * np.pi / 40
                    x, y = x + speed * np.cos(angle), y + speed * np.sin(angle)
                elif kind == "jumps" and rng.random() < 0.1:
                    x, y = rng.uniform(0, LENGTH_MM), rng.uniform(0, WIDTH_MM)
                k += 1
            if k < len(times):
                reports.setdefault(times[k], {})[slot] = None
            k += rng.choice([1, 1, 2, round(0.05 / period_s), round(0.3 / period_s)])
    reports.setdefault(round(duration_s + 0.02, 6), {}).update(dict.fromkeys(range(5)))
    return sorted((at, slots) for at, slots in reports.items())


class Mishaps(VirtualClock):
    """Virtual time on a machine that may be late or stall, with a run permit that may go away."""

    def __init__(self, rng, end_s):
        super().__init__()
        self._rng = rng
        self.late_s = rng.choice([0.0, 0.0, 0.4e-3, 3e-3])
        self._stalls = sorted(rng.uniform(0.2, end_s) for _ in range(rng.choice([0, 0, 0, 1])))
        self._lost_s = rng.uniform(0.2, end_s) if rng.random() < 0.15 else None
        self.permit = lambda _: None

    def wait(self, selector, until_s):
        super().wait(selector, until_s)
        self._now_s += self._rng.uniform(0, self.late_s)
        if self._stalls and self._now_s >= self._stalls[0]:
            self._stalls.pop(0)
            self._now_s += self._rng.choice([0.01, 0.05, 0.3])
        if self._lost_s is not None and self._now_s >= self._lost_s:
            self.permit(self._now_s >= self._lost_s + 0.2)
            if self._now_s >= self._lost_s + 0.2:
                self._lost_s = None


class Script:
    """Commands and scene changes at random times: a `CommandSource` and a `SceneChange`."""

    def __init__(self, rng, end_s, scenes):
        self._rng = rng
        self._times = sorted(rng.uniform(0.15, end_s) for _ in range(rng.choice([0, 0, 10, 60])))
        self._changes = sorted(rng.uniform(0.2, end_s) for _ in range(rng.choice([0, 0, 0, 1, 2])))
        self._scenes = scenes
        self._now_s = 0.0
        self._tickets = 0
        self.waiting = set()
        self.answered = Counter()
        self.selection = lambda: None

    def fileno(self):
        return None

    def next_time_s(self):
        return self._times[0] if self._times else np.inf

    def serve(self, now_s, control):
        self._now_s = now_s
        while self._times and self._times[0] <= now_s:
            self._times.pop(0)
            self._tickets += 1
            rng = self._rng
            finger = rng.choice([None, None, *self.fingers])
            effect = rng.choice(sorted(control.effects()))
            self.waiting.add(self._tickets)
            try:
                x_m, y_m = rng.uniform(0, 0.21), rng.uniform(0, 0.148)
                control.play(self._tickets, effect, x_m, y_m, finger, rng.choice([1.0, 1.0, 0.5]), now_s)
            except ControllerError:
                self.waiting.discard(self._tickets)

    fingers = (0, 1, 2)

    def touches(self, samples):
        pass

    def outcome(self, ticket, outcome, _):
        assert ticket in self.waiting, f"{outcome} for a command that has its answer"
        self.waiting.remove(ticket)
        self.answered[outcome] += 1

    name = "random"

    def scene_changed(self):
        pass

    def begin(self, *_):
        raise AssertionError("no signal came")

    def take(self):
        if self._changes and self._changes[0] <= self._now_s:
            self._changes.pop(0)
            return PreparedScene(0, self._rng.choice(self._scenes), self.selection() if self._rng.random() < 0.5 else None)
        return None


def play(seed, board, bank_file, tmp_path, evemu_text, *, damaged=False):
    """Run one seed, and check it; damaged: some of the frames, answers and edges of the trigger are damaged or lost."""
    rng = random.Random(seed)
    on = random_board(rng, board)
    duration_s = rng.uniform(0.5, 2.0)
    reports = random_reports(rng, duration_s)
    scenes = []
    while len(scenes) < 2:
        (tmp_path / "random.toml").write_text(random_scene(rng, on))
        try:
            scenes.append(load_scene(tmp_path / "random.toml", on))
        except ControllerError:  # such as two trains of too high a rate together
            continue
    clock = Mishaps(rng, duration_s)
    script = Script(rng, duration_s, scenes)
    recording = Recording(evemu_text(*reports))
    wires = []

    def gateware(parameters):
        wires.append(Damage(GatewareModel(parameters), noise(seed) if damaged else lambda *_: None))
        return wires[0]

    link = open_simulated(on, clock.now_s, gateware)
    clock.permit = lambda level: link.gateware.permit(max(round(clock.now_s() * on.link.clock_hz), link.gateware.now), level=level)
    with Bank.open(bank_file, on) as bank:
        source = tracked(RecordingSource(recording, recording.axes(on), START_S), on)
        session = open_session(link, on, clock.now_s)
        script.selection = lambda: Selection(bank, on.bank.snap_mm * 1e-3, on.idle_word)
        judge = Judge(link, session, source)
        assembly = assemble(
            LoopContext(on, clock, session, source),
            scenes[0],
            bank,
            played=judge.started,
            commands=script,
            change=script,
            watch=Watch(judge.turn),
        )
        judge.watch(assembly)
        try:
            run_until(assembly.loop, clock, duration_s + 0.5, lambda: setattr(wires[0], "armed", True))
        except ControllerError as error:
            raise AssertionError(f"the loop ended: {error}") from error
        link.close()
        judge.turn(clock.now_s())
    counters, skipped = assembly.counters, assembly.counters.skipped
    judge.finish(on, counters)
    waiting = judge.waiting()
    assert counters.due == counters.foci + skipped.emissions + waiting, (counters, waiting)
    assert not script.waiting or waiting, f"commands without an answer: {script.waiting}"
    return counters


def noise(seed):
    """Strikes of `Damage`: 0.1 to 3 % of the frames and answers, 1 % of the edges of the trigger."""
    rng = random.Random(-seed)
    share = rng.choice([0.001, 0.003, 0.01, 0.03])

    def strike(kind, _):
        if rng.random() >= (0.01 if kind == "trigger" else share):
            return None
        return "lost" if kind == "trigger" else rng.choice(["bit", "bit", "lost"])

    return strike


def run_until(loop, clock, end_s, ready):
    """The loop with commands never ends by itself."""
    wait = clock.wait

    def ending(selector, until_s):
        wait(selector, until_s if clock.now_s() >= end_s else min(until_s, end_s))
        if clock.now_s() >= end_s:
            loop.stop()

    clock.wait = ending
    loop.run(ready)


class Judge:
    """Looks on."""

    def __init__(self, link, session, source):
        self._link = link
        self._notes = Notes(session)
        self._felt = set()
        self._released = {}
        read = source.read

        def reading(now_s):
            samples = read(now_s)
            for sample in samples:
                if sample.contact:
                    assert sample.finger not in self._released, "a finger that was released came back under its number"
                else:
                    assert sample.finger not in self._released, "released twice"
                    self._released[sample.finger] = sample.time_s
            return samples

        source.read = reading

    def watch(self, assembly):
        self._playback = assembly.loop._playback
        self._scheduler = assembly.loop._scheduler
        self._clock_estimate = assembly.loop._clock_estimate
        self._words = {}

        take = self._scheduler.queue.next_batch

        def taken(*how):
            emissions = take(*how)
            for emission in emissions:
                released_s = self._released.get(emission.finger)
                if released_s is not None:
                    due_s = self._clock_estimate.host_s(emission.time_s)
                    assert due_s >= released_s - 1e-6, f"{emission} is played after its finger was lifted at {released_s}"
            return emissions

        self._scheduler.queue.next_batch = taken

    def started(self, played):
        self._notes.started(played)
        for emission in played.emissions:
            if emission.finger is not None:
                name = (emission.finger, emission.region, emission.time_s, emission.pulse)
                assert name not in self._felt, f"{name} is felt twice"
                self._felt.add(name)

    def waiting(self):
        return len(self._scheduler.due) + (len(a.plan.batch.emissions) if (a := self._playback.accepted) else 0)

    def turn(self, _):
        """The slot cache is consistent in itself and with what the FPGA holds."""
        cache = self._playback.sender.slots
        residents = cache.held.items()
        assert sorted(slot for slot, _ in residents) == list(range(cache.slots))
        buffers = self._link.gateware._commands.buffers
        keys = [key for _, key in residents if key is not None]
        assert len(set(keys)) == len(keys)
        for slot, key in residents:
            if key is not None:
                held = buffers.waveform(buffers.slot_buffer[slot])[: buffers.slot_words[slot]]
                assert zlib.crc32(held) == self._notes.crcs[slot], f"slot {slot} does not hold what was sent"
                crc = self._words.setdefault(key, self._notes.crcs[slot])
                assert crc == self._notes.crcs[slot], f"slot {slot} holds another waveform than {key}"
                assert cache.find(key) == key

    def finish(self, board, counters):
        """On the pins: each start's own waveform, no more and no fewer emissions than were started, or what differs is counted."""
        capture = self._link.take_capture()
        off = capture.ticks[np.flatnonzero(np.diff(capture.hv.astype(int)) == -1) + 1].astype(np.int64)
        second = board.link.clock_hz

        def cut(tick):  # the outputs went off before its end, or the ramp was near
            return ((off > tick - 0.01 * second) & (off < tick + 0.015 * second)).any()

        starts = self._notes.ticks(self._link)
        others, found = match(emissions_on_pins(capture, board.bit_ticks), starts, board.bit_ticks)
        others = [tick for tick in others if not cut(tick)]
        absent, again = [], []
        for index, (played, _) in enumerate(self._notes.starts):
            if played.count == 1 and not cut(starts[index][0]):
                again += [index] * (found[index] - 1)  # what its slot held, in place of a damaged upload
                absent += [] if found[index] else [index]
        assert len(others) + len(again) <= counters.link.misplaced, f"words of others at {others}, of {again}: {counters.link}"
        assert len(absent) <= counters.link.emissions_lost, f"not on the pins: {absent}; {counters.link}"


def play_all(seeds, *where, **how):
    foci = 0
    for seed in seeds:
        try:
            foci += play(seed, *where, **how).foci
        except Exception as error:
            raise AssertionError(f"seed {seed}: {error!r}") from error
    assert foci > 10 * len(seeds), "they feel something"


@pytest.mark.interpreted
def test_random_play_keeps_the_invariants(board, bank_file, tmp_path, evemu_text):
    play_all(range(CHEAP), board, bank_file, tmp_path, evemu_text)


@pytest.mark.slow
@pytest.mark.parametrize("part", range(10))
def test_long_random_play_keeps_the_invariants(part, board, bank_file, tmp_path, evemu_text):
    play_all(range(CHEAP + part * LONG // 10, CHEAP + (part + 1) * LONG // 10), board, bank_file, tmp_path, evemu_text)


@pytest.mark.interpreted
def test_random_play_on_a_damaged_link_keeps_them_or_counts_what_it_lost(board, bank_file, tmp_path, evemu_text):
    play_all(range(CHEAP), board, bank_file, tmp_path, evemu_text, damaged=True)


@pytest.mark.slow
@pytest.mark.parametrize("part", range(10))
def test_long_random_play_on_a_damaged_link(part, board, bank_file, tmp_path, evemu_text):
    play_all(range(CHEAP + 60 * part, CHEAP + 60 * (part + 1)), board, bank_file, tmp_path, evemu_text, damaged=True)

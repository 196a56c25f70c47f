"""The sequence of plays and emissions in the gateware model: which play starts, repeats or ends in a tick.

Everything of a tick is decided from the state before it, as flip-flops do.
"""

from controller.device.fpga.registers import CHUNK_WORDS, Register, Start
from controller.workshop.gateware.model.commands import Commands
from controller.workshop.gateware.model.events import EventKind, Events, GatewareEvent
from controller.workshop.gateware.model.gate import PIN_TICKS, GateState
from controller.workshop.gateware.model.player import DECISION_TICKS, AcceptedPlay


class Sequencer:
    """Starts plays from the queue, and passes the words of emissions to the output gate. `events` takes the ends of emissions."""

    def __init__(self, commands: Commands, events: Events) -> None:
        self._events = events
        self._gate = commands.gate
        self._player = commands.player
        self._queue = commands.queue
        self._buffers = commands.buffers
        self._registers = commands.registers
        self._telemetry = commands.telemetry

    def waiting_from(self) -> int | None:
        """Tick from which on the head of the queue waits for a trigger, if nothing else happens; None if it does not."""
        plays, player = self._queue.plays, self._player
        if (
            not plays
            or plays[0].start is not Start.TRIGGER
            or self._gate.state is not GateState.ON
            or player.playing
            or player.delayed
        ):
            return None
        return max(self._queue.head_from, player.free_from)

    def _free(self, tick: int) -> bool:
        """Whether a play may start."""
        return self._gate.state is GateState.ON and self._player.settled(tick) and not self._player.delayed

    def head_tick(self) -> int | None:
        """Next tick in which the head of the queue may start or be missed without a trigger; None if there is none."""
        queue, player = self._queue, self._player
        if not queue.plays or queue.plays[0].start is Start.TRIGGER:
            return None
        head = queue.plays[0]
        if head.start is Start.TIME:
            return max(queue.head_from + 1, head.when - DECISION_TICKS, self._events.now)
        if player.playing or player.delayed or player.remaining or self._gate.state is not GateState.ON:
            return None
        return max(queue.head_from, player.free_from, self._events.now)

    def arrival_tick(self) -> int | None:
        """Tick in which an emission from the landing buffer reaches the first word not yet passed on; None if there is none."""
        player = self._player
        if not player.playing or not player.live or player.running is None or player.known_words >= player.running.length:
            return None
        return max(player.start + (player.known_words * self._registers.bit_period >> 16), self._events.now)

    def pass_arrived_words(self) -> bool:
        """Pass on the words that have arrived since; False if the one that is due has not."""
        player, known = self._player, self._player.known_words
        assert player.running
        chunk, within = divmod(known, CHUNK_WORDS)
        arrived = self._buffers.chunk_words[chunk]
        if within >= arrived:
            return False
        end = min(known - within + arrived, player.running.length)
        waveform = self._buffers.waveform(player.running.buffer)
        # copied: a later chunk is written into the same buffer while this one is shown
        words = player.running.words(waveform, self._registers.idle_word, known, end).copy()
        self._gate.play(player.start, words, known)
        player.known_words = end
        return True

    def step(self, tick: int, *, trigger: bool, halted: bool) -> None:
        """Do what the player does in `tick`: end an emission, repeat, or start the head of the queue.

        `halted`: a command in this tick prevents any start.
        """
        player, telemetry = self._player, self._telemetry
        head = self._queue.head(tick)
        free = self._free(tick) and not halted
        begins: AcceptedPlay | None = None
        if head is not None:
            seen = tick > self._queue.head_from  # its time is compared one tick after it is fetched
            due = head.start is Start.TIME and seen and head.when == tick + DECISION_TICKS
            at_once = head.start is Start.NOW and not player.remaining
            if free and (due or at_once or (trigger and head.start is Start.TRIGGER)):
                begins = self._queue.pop(tick)
            elif head.start is Start.TIME and seen and head.when < tick + DECISION_TICKS:
                self._queue.pop(tick)
                telemetry.counts[Register.PLAYS_MISSED] += 1
        if trigger:
            telemetry.counts[Register.TRIGGERS] += 1
            telemetry.trigger_tick = tick
            telemetry.counts[Register.TRIGGERS_IGNORED] += begins is None or begins.start is not Start.TRIGGER
        repeats = player.repeating and not player.delayed and tick == player.due_tick and begins is None and not halted
        released = player.release_tick == tick and not halted
        if player.playing and tick == player.end - 1:
            if not player.halting:
                self._events.add(GatewareEvent(tick + PIN_TICKS, EventKind.EMISSION_END))
            player.finish(tick, self._registers.bit_ticks)
            self._gate.idle(tick + 1)
            self._gate.limits.emission(tick + 1, playing=False)
            self._gate.limits.activity(tick + 1, active=False)
        if begins is not None:
            player.begin(begins, tick)
        if repeats and player.running is not None:
            player.remaining = max(player.remaining - 1, 0)
        if repeats or released or (begins is not None and not player.delayed):
            self._start_emission(tick)

    def _start_emission(self, tick: int) -> None:
        """Start an emission of the current play in the next tick."""
        player, gate = self._player, self._gate
        player.start_emission(tick, self._registers.bit_period)
        assert player.running
        self._telemetry.emission_tick = tick + DECISION_TICKS
        gate.limits.emission(tick + 1, playing=True)
        gate.limits.activity(tick + 1, active=True)
        if not player.running.live:
            waveform = self._buffers.waveform(player.running.buffer)
            words = player.running.words(waveform, self._registers.idle_word, 0, player.running.length)
            gate.play(tick + 1, words)
            player.known_words = player.running.length

"""waveform_buffer: what is stored is what is played and read, nothing loaded touches it, and its CRC is looked at.

Each tick all book-keeping outputs are compared with `Reference`, which knows buffers as lists of words.
"""

import random
import zlib

import cocotb
from clocked import after_reset, clocks, settled

from controller.device.fpga.registers import CHUNK_WORDS, CHUNKS, READ_MEMORY, READ_SLOT_CRC, WAVEFORM_WORDS, Result

CHECK_TICKS = 5  # and one for each word, from a STORE until its slot's CRC is known
LOOK_TICKS = 16  # a STORE and the chunks before it are there at least so long before it is accepted
NAME_TICKS = 1  # from an argument, or a STORE, to what is said of the slot that it names
ADDRESS_TICKS = 5  # from an argument to the word of memory that it names
SETTLE_TICKS = 4  # a READ of memory needs this many in which nobody else has the buffer
READ_TICKS = 2  # from the tick in which the player asks for a word to the first in which it has it; it asks no sooner for another


def crc_of(words):
    return zlib.crc32(b"".join(word.to_bytes(4, "little") for word in words))


def random_words(count):
    return [random.getrandbits(32) for _ in range(count)]


class Slot:
    def __init__(self, buffer):
        self.buffer, self.words, self.crc, self.intact = buffer, 0, None, False


class Reference:
    def __init__(self, slots):
        self.memory = [{} for _ in range(slots + 1)]
        self.slots = [Slot(number) for number in range(slots)]
        self.landing, self.chunks = slots, [0] * CHUNKS
        self.check = None  # slot, tick from which its CRC is known, CRC it should have
        self.disturbed = -1  # last tick in which the address of a READ did not have its way

    def load(self, argument, words, busy, live):
        """Result of an accepted LOAD."""
        if argument >= CHUNKS:
            return Result.BAD_CHUNK
        if busy or (live and self.chunks[argument]):
            return Result.BUSY
        self.chunks[argument] = words
        return Result.OK

    def write(self, chunk, number, word, busy, live):
        """One word of a LOAD, accepted or not: its chunk no longer counts."""
        if not busy and not (live and self.chunks[chunk]):
            self.memory[self.landing][CHUNK_WORDS * chunk + number] = word
            self.chunks[chunk] = 0

    def store_result(self, argument, length, live):
        if argument >= len(self.slots):
            return Result.BAD_SLOT
        if not 1 <= length <= WAVEFORM_WORDS:
            return Result.BAD_VALUE
        if self.check or live:
            return Result.BUSY
        needed = [max(0, min(CHUNK_WORDS, length - CHUNK_WORDS * chunk)) for chunk in range(CHUNKS)]
        return Result.OK if all(there >= need for there, need in zip(self.chunks, needed, strict=True)) else Result.INCOMPLETE

    def store(self, tick, argument, length, crc, live):
        if self.store_result(argument, length, live) is Result.OK:
            slot = self.slots[argument]
            slot.buffer, self.landing = self.landing, slot.buffer
            slot.words, slot.intact = length, False
            self.chunks = [0] * CHUNKS
            self.check = slot, tick + length + CHECK_TICKS, crc

    def contents(self, slot):
        return [self.memory[slot.buffer].get(n) for n in range(slot.words)]

    def at(self, tick):
        """What has been found out by this tick."""
        if self.check and tick >= self.check[1]:
            slot, _, expected = self.check
            slot.crc = crc_of(self.contents(slot))
            slot.intact = slot.crc == expected
            self.check = None

    def named(self, argument):
        """Slot that a STORE, a PLAY or a READ of a CRC names with its argument's low byte, of a READ with its middle."""
        number = argument >> 10 & 31 if argument & READ_MEMORY else argument & 0xFF
        return self.slots[number] if number < len(self.slots) else None

    def memory_result(self, tick, argument):
        slot = self.named(argument)
        if slot is None:
            return Result.BAD_SLOT
        if argument & 0x3FF >= slot.words:
            return Result.BAD_RANGE
        return Result.BUSY if tick - self.disturbed <= SETTLE_TICKS else Result.OK

    def crc_result(self, argument):
        slot = self.named(argument)
        if slot is None:
            return Result.BAD_SLOT
        if not slot.words:
            return Result.EMPTY_SLOT
        return Result.BUSY if self.check and self.check[0] is slot else Result.OK


class Bench:
    def __init__(self, dut):
        self.dut = dut
        self.settings = {"argument": 0, "word0": 0, "word1": 0, "load_words": 0, "load_busy": 0, "load_live": 0, "live": 0}
        self.settings |= {"play": 0, "play_buffer": 0, "play_word": 0, "play_chunk": 0, "play_within": 0}
        self.begin()

    def begin(self):
        self.tick, self.held, self.reference = 0, 0, Reference(int(self.dut.SLOTS.value))
        self.asked = None  # what the player asked for last: playing, buffer, word
        self.asked_tick, self.coming, self.has = -READ_TICKS, None, None  # when; what it will have; what it has

    @classmethod
    async def ready(cls, dut):
        await after_reset(dut, judge_i=1, look_i=1)
        return cls(dut)

    @property
    def slots(self):
        return len(self.reference.slots)

    async def step(self, count=1, write=None, load=False, store=False):
        dut, s, reference = self.dut, self.settings, self.reference
        for _ in range(count):
            for name, value in s.items():
                getattr(dut, f"{name}_i").value = value
            dut.write_i.value, dut.load_i.value, dut.store_i.value = write is not None, load, store
            dut.write_word_i.value, dut.write_data_i.value = write or (random.randrange(125), random.getrandbits(32))
            asked = s["play"] and (s["play_buffer"], s["play_word"])
            reads = bool(s["play"]) and asked != self.asked
            dut.play_read_i.value = reads
            await settled()
            reference.at(self.tick)
            if self.tick == self.asked_tick + READ_TICKS:
                self.has = self.coming
            self.compare()
            argument = s["argument"]
            before = self.player_reads()
            if write:
                reference.write(argument, *write, s["load_busy"], s["load_live"])
            if load:
                expected = reference.load(argument, s["load_words"], s["load_busy"], s["load_live"])
                assert self.seen("load") is expected, (self.seen("load"), expected, self.tick, s)
            slot = reference.named(argument)
            if reference.check or (s["play"] and slot and s["play_buffer"] == slot.buffer):
                reference.disturbed = self.tick
            stored = store and reference.store_result(argument, s["word0"], s["live"]) is Result.OK
            if store:
                expected = reference.store_result(argument, s["word0"], s["live"])
                assert self.seen("store") is expected, (self.seen("store"), expected, self.tick, s)
                reference.store(self.tick, argument, s["word0"], s["word1"], s["live"])
            self.results = {name: self.seen(name) for name in ("load", "store", "memory", "crc")}
            self.data = {name: getattr(dut, f"{name}_data_o").value for name in ("memory", "crc")}
            after = self.player_reads()  # what is written in the very clock in which it is read is neither
            if reads:
                assert self.tick >= self.asked_tick + READ_TICKS, "the player comes to no word so soon"
                self.asked_tick, self.coming = self.tick, before if before == after else None
            self.asked = asked
            self.tick += 1
            self.held = 0 if stored else self.held + 1
            await clocks(dut)
            dut.write_i.value = dut.load_i.value = dut.store_i.value = dut.play_read_i.value = 0
            write, load, store = None, False, False

    def compare(self):
        dut, s, reference = self.dut, self.settings, self.reference
        argument, slot = s["argument"], reference.named(s["argument"])
        expected = {
            "landing_o": reference.landing,
            "checking_o": reference.check is not None,
            "loaded_o": sum(slot.intact << number for number, slot in enumerate(reference.slots)),
            "chunks_o": sum(bool(words) << chunk for chunk, words in enumerate(reference.chunks)),
            "missing_o": s["play_within"] >= reference.chunks[s["play_chunk"]],
        }
        if self.held >= NAME_TICKS:
            expected["slot_good_o"] = argument < self.slots
        if argument < self.slots and self.held >= NAME_TICKS:
            expected |= {
                "slot_buffer_o": slot.buffer,
                "slot_words_o": slot.words,
                "slot_intact_o": slot.intact,
                "slot_checking_o": reference.check is not None and reference.check[0] is slot,
            }
        if argument & 0xFF00 == READ_SLOT_CRC and self.held >= NAME_TICKS:
            expected["crc_result_o"] = reference.crc_result(argument)
            if reference.crc_result(argument) is Result.OK:
                expected["crc_data_o"] = slot.crc
        if argument & READ_MEMORY and self.held >= ADDRESS_TICKS:
            expected["memory_result_o"] = reference.memory_result(self.tick, argument)
            if expected["memory_result_o"] is Result.OK:
                expected["memory_data_o"] = reference.memory[slot.buffer][argument & 0x3FF]
        if self.has is not None:
            expected["play_data_o"] = self.has
        pairs = {name: (int(getattr(dut, name).value), int(value)) for name, value in expected.items()}
        wrong = {name: pair for name, pair in pairs.items() if pair[0] != pair[1]}
        assert not wrong, f"tick {self.tick}: seen and expected differ in {wrong} with {s}"

    def player_reads(self):
        s = self.settings
        return self.reference.memory[s["play_buffer"]].get(s["play_word"]) if s["play"] else None

    def ask(self, **settings):
        if settings.get("argument", self.settings["argument"]) != self.settings["argument"]:
            self.held = 0
        self.settings |= settings

    def seen(self, name):
        return Result(int(getattr(self.dut, f"{name}_result_o").value))

    async def load(self, chunk, words, *, accepted=True, busy=0, live=0, most=None):
        """A LOAD as it arrives, word by word; returns its result if it is accepted."""
        self.ask(argument=chunk, load_words=len(words), load_busy=busy, load_live=live)
        for number, word in enumerate(words[:most]):
            if chunk < CHUNKS:
                await self.step(write=(number, word))
                await self.step(random.randrange(2))
        await self.step()
        if not accepted:
            return None
        await self.step(load=True)
        return self.results["load"]

    async def store(self, slot, length, crc=0, live=0, wait=True):
        self.ask(argument=slot, word0=length, word1=crc, live=live)
        await self.step(LOOK_TICKS)
        await self.step(store=True)
        result = self.results["store"]
        self.ask(live=0)
        if wait and result is Result.OK:
            await self.step(length + CHECK_TICKS)
        return result

    async def upload(self, slot, words, **options):
        order = list(range(0, len(words), CHUNK_WORDS))
        random.shuffle(order)
        for first in order:
            await self.load(first // CHUNK_WORDS, words[first : first + CHUNK_WORDS])
        return await self.store(slot, len(words), **{"crc": crc_of(words)} | options)

    async def read(self, slot, word):
        """A READ of memory, whose argument is there well before it is accepted."""
        self.ask(argument=READ_MEMORY | slot << 10 | word)
        await self.step(6)
        return await self.peek("memory")

    async def read_crc(self, slot):
        self.ask(argument=READ_SLOT_CRC | slot)
        await self.step()
        return await self.peek("crc")

    async def peek(self, name):
        await self.step()
        result = self.results[name]
        return (result, int(self.data[name])) if result is Result.OK else result

    async def play(self, buffer, first, length):
        """What the player reads, a word every two clocks."""
        for word in range(first, first + length):
            self.ask(play=1, play_buffer=buffer, play_word=word)
            await self.step(READ_TICKS)
        await self.step(READ_TICKS)
        self.ask(play=0)

    async def reset(self):
        self.dut.rst_i.value = 1
        await clocks(self.dut)
        self.dut.rst_i.value = 0
        memory = self.reference.memory
        self.begin()
        self.reference.memory = memory


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def keeps_in_each_slot_what_was_stored_whatever_is_loaded_later(dut):
    bench = await Bench.ready(dut)
    kept = {}
    lengths = [1000, 126, 7, 250, 125, 20, 1]
    for turn in range(max(len(lengths), bench.slots + 3)):
        slot, length = turn % bench.slots, lengths[turn % len(lengths)]
        kept[slot] = random_words(length)
        assert await bench.upload(slot, kept[slot]) is Result.OK
        assert int(dut.loaded_o.value) == sum(1 << s for s in kept)
        for other, words in kept.items():
            places = {0, len(words) - 1, *(random.randrange(len(words)) for _ in range(5))}
            if other == slot:
                places |= set(range(0, len(words), 125)) | {n - 1 for n in range(125, len(words), 125)}
            for place in places:
                assert await bench.read(other, place) == (Result.OK, words[place]), (turn, other, place)
            assert await bench.read_crc(other) == (Result.OK, crc_of(words))
            assert await bench.read(other, len(words)) is Result.BAD_RANGE
        bench.ask(argument=slot)
        await bench.step()
        await bench.play(int(dut.slot_buffer_o.value), 0, length)


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def stores_only_what_has_arrived_whole(dut):
    bench = await Bench.ready(dut)
    for chunk in (0, 1, 2):
        await bench.load(chunk, random_words(125 if chunk < 2 else 30))
    assert await bench.store(0, 281) is Result.INCOMPLETE
    assert await bench.store(0, 376) is Result.INCOMPLETE
    for length in (0, 1001, 1024, 0x10001, 0x8000_0001):
        assert await bench.store(0, length) is Result.BAD_VALUE
    for slot in (bench.slots, bench.slots + 16, 32, 0x100, 0x8000, 0xFFFF):
        assert await bench.store(slot, 280) is Result.BAD_SLOT
        assert await bench.store(slot, 0) is Result.BAD_SLOT, "which comes first"
    await bench.load(1, random_words(3), accepted=False)  # begun again, never accepted
    assert await bench.store(0, 280) is Result.INCOMPLETE
    assert await bench.store(0, 125, live=1) is Result.BUSY
    await bench.load(1, random_words(124))
    for length in (280, 250, 251):
        assert await bench.store(0, length) is Result.INCOMPLETE
    await bench.load(1, random_words(125))
    await bench.load(0, random_words(125), accepted=False, most=1)
    assert await bench.store(0, 1) is Result.INCOMPLETE
    await bench.load(0, random_words(125))
    assert await bench.store(0, 280) is Result.OK
    assert await bench.store(0, 1) is Result.INCOMPLETE, "a chunk counts for one STORE"
    for length, loads in ((875, [125] * 7), (876, [125] * 7 + [5]), (999, [125] * 8), (1000, [125] * 8)):
        for chunk, count in enumerate(loads):
            if chunk != 6:
                await bench.load(chunk, random_words(count))
        assert await bench.store(0, length) is Result.INCOMPLETE
        await bench.load(6, random_words(125))
        assert await bench.store(0, length + 6) is (Result.BAD_VALUE if length > 900 else Result.INCOMPLETE)
        assert await bench.store(0, length) is Result.OK
    for chunk in range(CHUNKS):
        await bench.load(chunk, random_words(125 if chunk < 7 else 124))
    assert await bench.store(0, 1000) is Result.INCOMPLETE
    assert await bench.store(0, 999) is Result.OK


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def a_slot_counts_as_loaded_only_once_its_crc_was_found_right(dut):
    bench = await Bench.ready(dut)
    assert await bench.read_crc(0) is Result.EMPTY_SLOT
    assert await bench.read_crc(bench.slots) is Result.BAD_SLOT
    assert await bench.read_crc(0x20) is Result.BAD_SLOT
    assert await bench.read(0, 0) is Result.BAD_RANGE
    assert await bench.read(bench.slots, 0) is Result.BAD_SLOT
    for length in (1, 2, 5, 130, 1000):
        words = random_words(length)
        await bench.upload(0, words, wait=False)
        stored = bench.tick - 1
        assert await bench.read_crc(0) is Result.BUSY
        while dut.checking_o.value:
            assert int(dut.loaded_o.value) & 1 == 0
            await bench.step()
        assert bench.tick == stored + length + CHECK_TICKS
        assert int(dut.loaded_o.value) & 1
        for bit in (0, 31):
            damaged = crc_of(words) ^ 1 << bit
            await bench.upload(0, words, crc=damaged)
            assert int(dut.loaded_o.value) & 1 == 0
            assert await bench.read_crc(0) == (Result.OK, crc_of(words)), "what it is, for the host to see"
            assert await bench.read(0, 0) == (Result.OK, words[0])


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def loads_and_plays_go_on_while_a_check_runs_and_do_not_disturb_it(dut):
    bench = await Bench.ready(dut)
    first, second = random_words(300), random_words(200)
    await bench.upload(0, first)
    buffer = bench.reference.slots[0].buffer
    await bench.upload(bench.slots - 1, second, wait=False)
    if bench.slots > 1:
        for word in range(60):
            bench.ask(play=1, play_buffer=buffer, play_word=word)
            await bench.step(READ_TICKS + random.randrange(3))
        assert await bench.read_crc(0) == (Result.OK, crc_of(first)), "that of another slot is known"
        bench.ask(play=0)
    assert dut.checking_o.value == 1
    assert await bench.store(0, 1) is Result.BUSY
    assert await bench.read(0, 3) is Result.BUSY
    assert await bench.load(0, random_words(20)) is Result.OK
    assert await bench.load(1, random_words(20)) is Result.OK
    while dut.checking_o.value:
        await bench.step()
    assert await bench.read_crc(bench.slots - 1) == (Result.OK, crc_of(second))
    assert int(dut.loaded_o.value) >> bench.slots - 1 & 1


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def a_load_is_refused_while_its_buffer_is_used(dut):
    bench = await Bench.ready(dut)
    words = random_words(40)
    assert await bench.load(0, words) is Result.OK
    for chunk in (0, 7):
        assert await bench.load(chunk, random_words(9), busy=1) is Result.BUSY
        assert await bench.load(chunk, random_words(9), busy=1, live=1) is Result.BUSY
    for chunk in (8, 16, 0x100, 0xFFFF):
        assert await bench.load(chunk, words) is Result.BAD_CHUNK
        assert await bench.load(chunk, words, busy=1) is Result.BAD_CHUNK, "which comes first"
    assert await bench.store(0, 40, crc_of(words)) is Result.OK, "the words of none of them were written"
    assert int(dut.loaded_o.value) == 1


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def what_plays_while_it_arrives_takes_only_chunks_that_are_missing(dut):
    bench = await Bench.ready(dut)
    first, second = random_words(125), random_words(30)
    await bench.load(0, first)
    assert await bench.load(1, random_words(30), accepted=False, live=1) is None, "damaged on its way: it may come again"
    assert await bench.load(1, second, live=1) is Result.OK
    for chunk in (0, 1):
        assert await bench.load(chunk, random_words(125), live=1) is Result.BUSY
        await bench.load(chunk, random_words(125), live=1, accepted=False)
    bench.settings["play"] = 1
    landing = bench.reference.landing
    for word in (0, 124, 125, 154, 155, 249, 250, 999):
        bench.ask(play_buffer=landing, play_word=word, play_chunk=word // 125, play_within=word % 125)
        await bench.step(3)
        assert bool(dut.missing_o.value) is (word >= 155), word
        if word < 155:
            assert int(dut.play_data_o.value) == [*first, *second][word]
    bench.ask(play=0, play_buffer=0)
    assert await bench.store(0, 155, crc_of([*first, *second]), live=1) is Result.BUSY
    assert await bench.store(0, 155, crc_of([*first, *second])) is Result.OK
    assert int(dut.loaded_o.value) == 1


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def reading_waits_for_the_player_and_never_disturbs_it(dut):
    bench = await Bench.ready(dut)
    words = random_words(20)
    await bench.upload(0, words)
    buffer = bench.reference.slots[0].buffer
    bench.ask(argument=READ_MEMORY | 7, play=1, play_buffer=buffer)
    for word in range(20):
        bench.ask(play_word=word)  # each step compares what the player gets
        await bench.step()
        assert await bench.peek("memory") is Result.BUSY
    bench.ask(play=0)
    results = []
    for _ in range(8):
        results.append(await bench.peek("memory"))
    assert results == [Result.BUSY] * 4 + [(Result.OK, words[7])] * 4
    bench.ask(play=1, play_buffer=(buffer + 1) % (bench.slots + 1))
    for word in range(8):
        bench.ask(play_word=word)
        for _ in range(READ_TICKS):
            assert await bench.peek("memory") == (Result.OK, words[7]), "another buffer is of no account"
    bench.ask(play=0, play_buffer=buffer)
    await bench.step(5)


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def a_reset_in_the_middle_empties_every_slot(dut):
    bench = await Bench.ready(dut)
    for moment in (0, 3, 12, 18, 30):
        for slot in range(bench.slots):
            words = random_words(10)
            await bench.upload(slot, words, wait=slot < bench.slots - 1)
        if moment < 18:
            await bench.load(3, random_words(7))
        await bench.step(moment)
        await bench.reset()
        assert (int(dut.loaded_o.value), int(dut.chunks_o.value), int(dut.checking_o.value)) == (0, 0, 0)
        await bench.step(30)
        for slot in range(bench.slots):
            assert await bench.read_crc(slot) is Result.EMPTY_SLOT
            assert await bench.read(slot, 0) is Result.BAD_RANGE
        assert await bench.store(0, 1) is Result.INCOMPLETE
        words = random_words(30)
        assert await bench.upload(0, words) is Result.OK
        assert int(dut.loaded_o.value) == 1


@cocotb.test(timeout_time=50, timeout_unit="ms")
async def random_uploads_reads_and_plays_go_as_the_reference_says(dut):
    bench = await Bench.ready(dut)
    seen = set()
    for _ in range(500):
        chunk = random.choice([0, 0, 0, 1, 2, random.randrange(10)])
        slot = random.randrange(bench.slots + 1)
        reference = bench.reference
        checked = reference.check[0].buffer if reference.check else None
        others = [buffer for buffer in range(bench.slots + 1) if buffer != checked]
        await bench.step(READ_TICKS)
        bench.ask(play=random.getrandbits(1), play_buffer=random.choice(others), play_word=random.randrange(160))
        bench.ask(play_chunk=random.randrange(8), play_within=random.randrange(125))
        match random.randrange(6):
            case 0 | 1:
                words = random_words(random.choice([5, 125, 125, random.randrange(5, 126)]))
                busy, live = int(random.random() < 0.1), int(random.random() < 0.3)
                arrives = {"accepted": False, "most": random.randrange(len(words))} if random.random() < 0.1 else {}
                seen.add(await bench.load(chunk, words, busy=busy, live=live, **arrives))
            case 2 | 3:
                bench.ask(play=0)
                length = random.choice([0, 1, 125, 126, 250, 1001, random.randrange(1000)])
                there = [reference.memory[reference.landing].get(n, 0) for n in range(length)]
                crc = crc_of(there) if random.random() < 0.8 else random.getrandbits(32)
                wait = random.random() < 0.5
                seen.add(await bench.store(slot, length, crc, live=int(random.random() < 0.1), wait=wait))
            case 4:
                answer = await bench.read(slot, random.choice([0, random.randrange(300)]))
                seen.add(answer if isinstance(answer, Result) else Result.OK)
            case 5:
                answer = await bench.read_crc(slot)
                seen.add(answer if isinstance(answer, Result) else Result.OK)
        if random.random() < 0.01:
            await bench.reset()
    results = {Result.OK, Result.BAD_CHUNK, Result.BUSY, Result.BAD_SLOT, Result.BAD_VALUE, Result.INCOMPLETE}
    assert seen >= results | {Result.BAD_RANGE, Result.EMPTY_SLOT}

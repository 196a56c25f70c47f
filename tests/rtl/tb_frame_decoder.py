"""frame_decoder: what it accepts, what it refuses and why, and which words it lets through."""

import random
import zlib

import cocotb
from clocked import after_reset, clocks, reset

from controller.device.fpga import frames
from controller.device.fpga.registers import FrameType, Result

BIT_TICKS = 8


def frame_of(kind, payload, *, sequence=1, argument=0, length=None, sync=b"\x5a\xa5"):
    """Any frame, sealed with the CRC of what it holds, right or wrong."""
    length = len(payload) if length is None else length
    body = sync + bytes([kind, sequence]) + length.to_bytes(2, "little") + argument.to_bytes(2, "little") + bytes(payload)
    return body + zlib.crc32(body).to_bytes(4, "little")


def judge(frame, partial=0):
    """What becomes of a frame, by the contract: the sync word first, then the length, then the CRC."""
    if not frame or frame[:2] != b"\x5a\xa5"[: len(frame)]:
        return Result.BAD_SYNC
    length = int.from_bytes(frame[4:6].ljust(2, b"\0"), "little")
    if partial or len(frame) < 12 or len(frame) != 12 + length or not length_allowed(frame[2], length):
        return Result.BAD_LENGTH
    return Result.OK if zlib.crc32(frame[:-4]) == int.from_bytes(frame[-4:], "little") else Result.BAD_CRC


def length_allowed(kind, length):
    if kind in (FrameType.LOAD, FrameType.TEST):
        return 20 <= length <= 500 and length % 4 == 0
    return length == 24


def words_in(data):
    return [int.from_bytes(data[at : at + 4], "little") for at in range(0, len(data) // 4 * 4, 4)]


def words_passed(frame):
    """Words of the payload that leave as they come in, and whether those are for the landing buffer."""
    if len(frame) < 8:
        return [], False
    length, argument = int.from_bytes(frame[4:6], "little"), int.from_bytes(frame[6:8], "little")
    if not length_allowed(frame[2], length):
        return [], False
    return words_in(frame[8 : 8 + length]), frame[:2] == b"\x5a\xa5" and frame[2] == FrameType.LOAD and argument < 8


class Decoder:
    """Feeds bytes, one call a tick at most, and keeps what came out with its tick."""

    def __init__(self, dut):
        self.dut, self.tick = dut, 0
        self.forget()

    def forget(self):
        self.verdicts, self.words, self.loads = [], [], []

    async def step(self, count=1):
        dut = self.dut
        for _ in range(count):
            await clocks(dut)
            self.tick += 1
            if dut.accept_o.value:
                self.verdicts.append((self.tick, Result.OK))
                self.fast = int(dut.fast_o.value)  # as haptic_core takes it
            if dut.refuse_o.value:
                self.verdicts.append((self.tick, Result(int(dut.refusal_o.value))))
            if dut.word_valid_o.value:
                self.words.append((self.tick, int(dut.word_number_o.value), int(dut.word_o.value)))
            if dut.load_word_o.value:
                assert dut.word_valid_o.value == 1
                self.loads.append(int(dut.word_number_o.value))

    async def begin(self, busy=0, live=0):
        dut = self.dut
        self.forget()
        dut.select_i.value, dut.landing_busy_i.value, dut.landing_live_i.value = 1, busy, live
        self.selected = self.tick
        await self.step()
        dut.select_i.value = 0
        dut.landing_busy_i.value, dut.landing_live_i.value = 1 - busy, 1 - live  # only as it begins do they matter

    async def give(self, data, gap=1):
        """Bytes, `gap` ticks from one to the next; returns the ticks in which they came."""
        ticks = []
        for byte in data:
            self.dut.byte_valid_i.value, self.dut.byte_i.value = 1, byte
            ticks.append(self.tick)
            await self.step()
            self.dut.byte_valid_i.value = 0
            self.dut.byte_i.value = random.getrandbits(8)
            await self.step((gap() if callable(gap) else gap) - 1)
        return ticks

    async def end(self, partial=0):
        self.dut.release_i.value, self.dut.partial_i.value = 1, partial
        self.released = self.tick
        await self.step()
        self.dut.release_i.value, self.dut.partial_i.value = 0, 1 - partial
        await self.step(3)

    async def feed(self, frame, gap=2, busy=0, live=0, partial=0):
        """A whole frame; checks that verdict and words come in their ticks, and returns the result."""
        await self.begin(busy, live)
        came = await self.give(frame, gap)
        await self.step()
        await self.end(partial)
        ((tick, result),) = self.verdicts
        assert tick == self.released + 1
        words, are_loads = words_passed(frame)
        assert self.words == [(came[8 + 4 * n + 3] + 1, n, word) for n, word in enumerate(words)], frame.hex()
        assert self.loads == (list(range(len(words))) if are_loads else []), frame.hex()
        assert int(self.dut.landing_busy_o.value) == busy
        assert int(self.dut.landing_live_o.value) == live
        return result


async def ready(dut):
    await after_reset(dut, bit_period_i=BIT_TICKS << 16)
    return Decoder(dut)


def short(kind=FrameType.PLAY, **fields):
    return frame_of(kind, random.randbytes(24), **fields)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def hands_out_the_fields_of_an_accepted_frame(dut):
    decoder = await ready(dut)
    for kind in (*FrameType, 7, 0xFF, 0x80):
        sequence, argument = random.getrandbits(8), random.getrandbits(16)
        payload = random.randbytes(24)
        assert await decoder.feed(frame_of(kind, payload, sequence=sequence, argument=argument)) is Result.OK
        fields = (dut.type_o, dut.sequence_o, dut.argument_o, dut.payload_words_o)
        expected = [kind, sequence, argument, 6]
        for _ in range(3):
            assert [int(field.value) for field in fields] == expected
            await decoder.step(20)  # they hold until the next frame begins


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def lets_the_words_of_a_load_through_as_they_come(dut):
    decoder = await ready(dut)
    buffer = bytearray(frames.LOAD_FRAME_BYTES)
    for chunk, count in ((0, 5), (7, 125), (3, 11), (1, 124)):
        payload = random.randbytes(4 * count)
        end = frames.pack_load(buffer, 0, 3, chunk, memoryview(payload))
        assert await decoder.feed(bytes(buffer[:end]), gap=random.randrange(1, 4)) is Result.OK
        assert decoder.loads == list(range(count)), "all of them are for the landing buffer"
        assert int(dut.payload_words_o.value) == count
    for argument in (8, 0x100, 0x8000, 0xFFFF):
        assert await decoder.feed(frame_of(FrameType.LOAD, bytes(40), argument=argument)) is Result.OK, "evaluated elsewhere"
        assert decoder.loads == []
        assert len(decoder.words) == 10
    assert await decoder.feed(frame_of(FrameType.TEST, random.randbytes(500))) is Result.OK
    assert len(decoder.words) == 125
    assert decoder.loads == []


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def each_type_has_its_lengths(dut):
    decoder = await ready(dut)
    for kind in (*FrameType, 7):
        for length in (0, 4, 16, 19, 20, 21, 22, 23, 24, 25, 28, 32, 496, 499, 500, 501, 504, 508, 512):
            frame = frame_of(kind, bytes(length))
            expected = Result.OK if length_allowed(kind, length) else Result.BAD_LENGTH
            assert judge(frame) is expected
            assert await decoder.feed(frame, gap=1) is expected, (kind, length)
    for length in (24 | 0x100, 24 | 0x8000, 24 + 512, 20 | 0x200, 0xFFFF):  # what it says, and not only its low bits
        assert await decoder.feed(frame_of(FrameType.NOP, bytes(24), length=length)) is Result.BAD_LENGTH
        assert await decoder.feed(frame_of(FrameType.LOAD, bytes(24), length=length)) is Result.BAD_LENGTH
    assert await decoder.feed(short() + bytes(1024), gap=1) is Result.BAD_LENGTH, "a count that wraps would take it"
    frame = frame_of(FrameType.LOAD, bytes(500))
    assert await decoder.feed(frame + bytes(1024 - len(frame) + 36), gap=1) is Result.BAD_LENGTH


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def the_sync_word_comes_before_the_length_and_that_before_the_crc(dut):
    decoder = await ready(dut)
    good = short(FrameType.WRITE)
    for sync in (b"\xa5\x5a", b"\x5a\x5a", b"\xa5\xa5", b"\x5b\xa5", b"\x5a\x25"):
        assert await decoder.feed(frame_of(FrameType.WRITE, bytes(24), sync=sync)) is Result.BAD_SYNC
        assert await decoder.feed(frame_of(FrameType.LOAD, bytes(20), sync=sync)) is Result.BAD_SYNC
        assert decoder.loads == []
        assert await decoder.feed(frame_of(FrameType.WRITE, bytes(20), sync=sync), partial=1) is Result.BAD_SYNC
    for cut in range(len(good)):
        assert await decoder.feed(good[:cut]) is (Result.BAD_LENGTH if cut else Result.BAD_SYNC), cut
    assert await decoder.feed(good, partial=1) is Result.BAD_LENGTH
    assert await decoder.feed(good + b"\0") is Result.BAD_LENGTH
    for bit in range(32):
        damaged = bytearray(good)
        damaged[32 + bit // 8] ^= 1 << bit % 8
        assert await decoder.feed(damaged) is Result.BAD_CRC
    assert await decoder.feed(good) is Result.OK


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def frames_may_follow_each_other_at_once(dut):
    decoder = await ready(dut)
    wanted = []
    for number in range(6):
        frame = short(sequence=number)
        if number % 2:
            frame = frame[:-1] + bytes([frame[-1] ^ 1])
        wanted.append(judge(frame))
        await decoder.begin()
        verdicts = []
        await decoder.give(frame, gap=1)
        await decoder.step()
        dut.release_i.value, dut.partial_i.value = 1, 0
        await decoder.step()
        dut.release_i.value = 0
        verdicts += decoder.verdicts
        assert [result for _, result in verdicts] == [wanted[-1]]
        assert int(dut.sequence_o.value) == number, "held in the clock of the verdict"


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def fast_means_that_the_words_outlast_the_frame(dut):
    """Evaluated from select to release: n words of a bit period each against the clocks of the frame."""
    decoder = await ready(dut)
    verdicts = set()
    for count, gap in ((5, 3), (125, 2), (20, 5)):
        frame = frame_of(FrameType.LOAD, bytes(4 * count))
        dut.bit_period_i.value = 1 << 16
        await decoder.feed(frame, gap=gap)
        spent = (decoder.released - decoder.selected) << 16
        assert decoder.fast == 0
        for period in (-(-spent // count), spent // count - (spent % count == 0)):  # just enough, and just not
            dut.bit_period_i.value = period
            assert await decoder.feed(frame, gap=gap) is Result.OK
            verdicts.add((count * period >= spent, decoder.fast))
    assert verdicts == {(True, 1), (False, 0)}


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_frame_without_an_end_never_becomes_fast(dut):
    decoder = await ready(dut)
    await decoder.begin()
    await decoder.step(3)
    dut.ahead_q.value = -(1 << 39) + 5 * 65536  # as after some million clocks: five from turning over
    for _ in range(12):
        await decoder.step()
        assert dut.fast_o.value == 0
    await decoder.begin()
    assert dut.fast_o.value == 1


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_reset_in_the_middle_forgets_the_frame(dut):
    decoder = await ready(dut)
    frame = frame_of(FrameType.LOAD, random.randbytes(20))
    for cut in (1, 2, 7, 8, 11, 12, 31, len(frame)):
        await decoder.begin(busy=1, live=1)
        await decoder.give(frame[:cut])
        await reset(dut)
        registers = (dut.type_o, dut.sequence_o, dut.argument_o, dut.landing_busy_o, dut.landing_live_o)
        assert not any(int(field.value) for field in registers)
        decoder.forget()
        await decoder.give(frame[cut:], gap=2)
        assert decoder.loads == []
        await decoder.end()
        assert [result for _, result in decoder.verdicts] == [Result.BAD_SYNC], cut
        assert await decoder.feed(frame) is Result.OK
    dut.release_i.value = 1  # even in the clock of a release
    await reset(dut)
    dut.release_i.value = 0
    decoder.forget()
    await decoder.step(3)
    assert decoder.verdicts == []


def random_frame():
    kind = random.choice([*FrameType, FrameType.LOAD, FrameType.TEST, random.getrandbits(8)])
    long = kind in (FrameType.LOAD, FrameType.TEST)
    length = random.choice([20, 24, 40, 4 * random.randrange(5, 126)]) if long else 24
    fields = {"sequence": random.getrandbits(8), "argument": random.choice([random.randrange(10), random.getrandbits(16)])}
    frame = bytearray(frame_of(kind, random.randbytes(length), **fields))
    match random.randrange(8):
        case 0:
            frame[random.randrange(len(frame))] ^= 1 << random.randrange(8)
        case 1:
            del frame[random.randrange(len(frame)) :]
        case 2:
            frame += random.randbytes(random.choice([1, 3, 4, 36]))
        case 3:  # sealed, with a length of its own
            frame = bytearray(frame_of(kind, frame[8:-4], **fields, length=random.choice([0, 20, 24, 28, length + 4, length - 1])))
        case 4:
            frame = bytearray(frame_of(kind, random.randbytes(random.randrange(40)), **fields))
        case _:
            pass
    return bytes(frame)


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def random_frames_are_evaluated_by_the_contract(dut):
    decoder = await ready(dut)
    seen, paces = set(), set()
    for _ in range(300):
        frame, partial = random_frame(), random.randrange(10) == 0
        busy, live = random.randrange(2), random.randrange(2)
        expected = judge(frame, partial)
        gap = random.choice([1, 1, 2, lambda: random.randrange(1, 6)])
        assert await decoder.feed(frame, gap=gap, busy=busy, live=live, partial=int(partial)) is expected, frame.hex()
        seen.add(expected)
        if expected is Result.OK:
            assert int(dut.payload_words_o.value) == (len(frame) - 12) // 4
            spent = decoder.released - decoder.selected
            assert decoder.fast == ((len(frame) // 4 - 3) * BIT_TICKS >= spent)
            paces.add(decoder.fast)
    assert paces == {0, 1}
    assert seen == {Result.OK, Result.BAD_SYNC, Result.BAD_LENGTH, Result.BAD_CRC}

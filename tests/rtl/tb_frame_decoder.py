"""frame_decoder: what it accepts, what it refuses and why, and which words it lets through."""

import random

import cocotb
from clocked import after_reset, clocks, pulse
from cocotb.triggers import RisingEdge

from controller.fpga import frames
from controller.fpga.model_decoder import judge
from controller.fpga.registers import Result


class Decoder:
    """Feeds bytes and keeps verdicts and written words."""

    def __init__(self, dut):
        self.dut, self.verdicts, self.written = dut, [], []
        cocotb.start_soon(self._watch())

    async def _watch(self):
        dut = self.dut
        while True:
            await RisingEdge(dut.clk_i)
            if dut.accept_o.value:
                self.verdicts.append(Result.OK)
            if dut.refuse_o.value:
                self.verdicts.append(Result(int(dut.refusal_o.value)))
            if dut.write_o.value:
                place = int(dut.write_chunk_o.value), int(dut.write_word_o.value)
                self.written.append((*place, int(dut.write_data_o.value)))

    async def feed(self, frame, busy=0, partial=0):
        dut = self.dut
        self.verdicts.clear()
        self.written.clear()
        await pulse(dut, dut.select_i, landing_busy_i=busy)
        dut.landing_busy_i.value = 1 - busy  # only its level at the beginning matters
        for byte in frame:
            await pulse(dut, dut.byte_valid_i, byte_i=byte)
            await clocks(dut)
        await pulse(dut, dut.release_i, partial_i=partial)
        dut.partial_i.value = 0
        await clocks(dut, 3)
        return self.verdicts


def load_frame(chunk, words):
    buffer = bytearray(frames.LOAD_FRAME_BYTES)
    end = frames.pack_load(buffer, 0, 3, chunk, memoryview(b"".join(word.to_bytes(4, "little") for word in words)))
    return bytes(buffer[:end])


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def hands_out_the_fields_of_an_accepted_frame(dut):
    await after_reset(dut)
    decoder = Decoder(dut)
    for _ in range(4):
        kind, sequence, argument = random.randrange(256), random.getrandbits(8), random.getrandbits(16)
        kind += kind == 3
        words = [random.getrandbits(32) for _ in range(5)]
        buffer = bytearray(32)
        frames.pack_short(buffer, 0, kind, sequence, argument, *words)
        assert await decoder.feed(buffer) == [Result.OK]
        fields = (dut.type_o, dut.sequence_o, dut.argument_o, dut.word0_o, dut.word1_o, dut.word2_o)
        assert [int(field.value) for field in fields] == [kind, sequence, argument, *words[:3]]
        assert decoder.written == []


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def lets_the_words_of_a_load_through_as_they_come(dut):
    await after_reset(dut)
    decoder = Decoder(dut)
    for chunk, count in ((0, 5), (7, 125), (3, 11)):
        words = [random.getrandbits(32) for _ in range(count)]
        assert await decoder.feed(load_frame(chunk, words)) == [Result.OK]
        assert decoder.written == [(chunk, n, word) for n, word in enumerate(words)]
        assert int(dut.payload_words_o.value) == count
    assert await decoder.feed(load_frame(8, words)) == [Result.OK], "well-formed; its chunk is judged elsewhere"
    assert decoder.written == []
    assert await decoder.feed(load_frame(1, words), busy=1) == [Result.OK]
    assert decoder.written == []
    assert dut.landing_busy_o.value == 1


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def refuses_what_the_model_refuses_for_the_same_reason(dut):
    await after_reset(dut)
    decoder = Decoder(dut)
    short = bytearray(32)
    frames.pack_play(short, 0, 1, 2, count=3, period_ticks=4)
    load = load_frame(2, range(6))
    damaged = [frame[:cut] for frame in (bytes(short), load) for cut in (1, 2, 5, 8, 12, 31)]
    damaged += [bytes(short) + bytes(extra) for extra in (1, 4, 1000)]
    for frame in (bytes(short), load):
        for bit in [*range(16, 48, 3), *random.sample(range(8 * len(frame)), 20)]:
            flipped = bytearray(frame)
            flipped[bit // 8] ^= 1 << bit % 8
            damaged.append(bytes(flipped))
    for length in (0, 16, 22, 504):  # lengths no LOAD may have, with a good CRC
        odd = bytearray(load_frame(0, range(125)) + bytes(8))[: 8 + length]
        odd[4:6] = length.to_bytes(2, "little")
        damaged.append(bytes(odd) + frames.zlib.crc32(odd).to_bytes(4, "little"))
    for frame in damaged:
        expected = judge(memoryview(frame))
        assert expected.refusal is not Result.OK
        assert await decoder.feed(frame) == [expected.refusal], frame.hex()
        assert len(decoder.written) == expected.loaded_words
    assert await decoder.feed(short, partial=1) == [Result.BAD_LENGTH]
    assert await decoder.feed(short) == [Result.OK]

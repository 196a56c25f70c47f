"""frame_select: which link's frame the core is asked, clock by clock, against a reference that keeps what came."""

import random

import cocotb
from clocked import after_reset, clocks, settled

from controller.device.fpga.registers import FrameType

FIELDS = {"kind": 8, "sequence": 8, "argument": 16, "payload_words": 7}
KINDS = {
    "read": FrameType.READ,
    "write": FrameType.WRITE,
    "load": FrameType.LOAD,
    "store": FrameType.STORE,
    "play": FrameType.PLAY,
}
PULSES = (
    "spi_taken",
    "spi_accept",
    "spi_word_valid",
    "spi_load_word",
    "uart_begin",
    "uart_accept",
    "uart_word_valid",
    "uart_load_word",
)


class Reference:
    """What was chosen, and the words that came, by the contract in the head of the module."""

    def __init__(self):
        self.fields = dict.fromkeys(FIELDS, 0) | {"kind": int(FrameType.NOP)}
        self.words = [0] * 6
        self.taken = [False, False]  # a clock ago, two clocks ago
        self.returned = self.chosen = self.fast = self.lengths = False

    def expected(self, given):
        link = "uart" if given["uart_turn"] else "spi"
        accept = given["spi_accept"] or given["uart_accept"]
        valid = given["spi_word_valid"] or given["uart_word_valid"]
        return {
            **{f"{name}_o": value for name, value in self.fields.items()},
            **{f"{name}_o": bool(accept and self.fields["kind"] == kind) for name, kind in KINDS.items()},
            "accept_o": accept,
            "judge_o": self.chosen or accept,
            "words_o": sum(word << 32 * place for place, word in enumerate(self.words)),
            "landing_busy_o": given[f"{link}_landing_busy"],
            "landing_live_o": given[f"{link}_landing_live"],
            "fast_o": self.fast,
            "load_word_o": bool(valid and (given["spi_load_word"] or given["uart_load_word"])),
            "play_word_o": bool(valid and self.fields["kind"] == FrameType.PLAY),
            "lengths_o": self.lengths,
            "word_number_o": given[f"{link}_word_number"] & 0x7F,
            "word_o": given[f"{link}_word"],
        }

    def advance(self, given, seen):
        if seen["load_o"]:
            self.fast = bool(given["spi_fast"] and not given["uart_turn"])
        link = "uart" if given["uart_turn"] else "spi"
        number = given[f"{link}_word_number"]
        if (given["spi_word_valid"] or given["uart_word_valid"]) and number < 6:
            self.words[number] = given[f"{link}_word"]
        self.lengths = seen["play_word_o"] and number == 2
        from_uart = given["uart_begin"] or given["uart_turn"]
        self.chosen = any(self.taken) or from_uart or self.returned
        if self.chosen:
            self.fields = {name: given[f"{'uart' if from_uart else 'spi'}_{name}"] for name in FIELDS}
        self.taken = [given["spi_taken"], self.taken[0]]
        self.returned = given["uart_turn"]


def random_inputs():
    kinds = [*KINDS.values(), FrameType.NOP, random.getrandbits(8)]
    given = {name: random.random() < 0.2 for name in PULSES}
    given["uart_turn"] = random.random() < 0.4
    for link in ("spi", "uart"):
        given |= {f"{link}_{name}": random.getrandbits(bits) for name, bits in FIELDS.items()}
        given[f"{link}_kind"] = int(random.choice(kinds))
        given[f"{link}_word_number"] = random.choice([0, 1, 2, 2, 3, 5, 6, 127, 128, random.getrandbits(8)])
        given[f"{link}_word"] = random.getrandbits(32)
        given |= {f"{link}_{name}": random.getrandbits(1) for name in ("landing_busy", "landing_live")}
    given["spi_fast"] = random.getrandbits(1)
    return given


async def step(dut, reference, given):
    for name, value in given.items():
        getattr(dut, f"{name}_i").value = value
    await settled()
    expected = reference.expected(given)
    wrong = {name: (int(getattr(dut, name).value), int(value)) for name, value in expected.items()}
    wrong = {name: pair for name, pair in wrong.items() if pair[0] != pair[1]}
    assert not wrong, f"seen and expected differ in {wrong} with {given}"
    reference.advance(given, expected)
    await clocks(dut)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def shows_the_chosen_frame_whatever_comes(dut):
    for _ in range(4):
        await after_reset(dut)
        reference = Reference()
        for _ in range(5000):
            await step(dut, reference, random_inputs())


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def what_rests_is_chosen_in_two_clocks_of_a_byte_and_not_again(dut):
    """A word comes a clock behind its byte, and its frame is over a clock later: both may bring something new."""
    await after_reset(dut)
    reference = Reference()
    quiet = dict.fromkeys(random_inputs(), 0)
    await step(dut, reference, quiet | {"spi_taken": 1, "spi_argument": 1})
    for argument in (2, 3, 4, 5):
        await step(dut, reference, quiet | {"spi_argument": argument})
    assert int(dut.argument_o.value) == 3

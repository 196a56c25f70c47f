"""What the record of each register says holds for every back-end: access, value after reset, bits, what it counts."""

from pin_script import Script
from tables import each_row

from controller.device.fpga import frames
from controller.device.fpga.registers import CONSTANTS, Kind, Register, Result
from controller.device.fpga.status import parse_status

ASIDE = {Register.CONTROL}  # a command, whose words are no values


def answers_to(back_end, *asked):
    """Status after each frame, of gateware just out of reset."""
    run = Script()
    for pack, *arguments in asked:
        run.send(pack, *arguments)
    run.status()
    answers, _ = run.perform(back_end)
    return [parse_status(answer) for answer in answers[1:]]


def test_every_address_of_the_table_can_be_read_and_no_other(back_end):
    statuses = answers_to(back_end, *((frames.pack_read, address) for address in range(len(Register) + 1)))
    assert [status.result for status in statuses] == [Result.OK] * len(Register) + [Result.UNKNOWN_REGISTER]


@each_row("register", sorted(set(Register) - ASIDE), ids=lambda register: register.name)
def test_only_what_is_rw_can_be_written(back_end, register):
    (read, refused, again) = answers_to(
        back_end, (frames.pack_read, register), (frames.pack_write, register, 0xFFFFFFFF), (frames.pack_read, register)
    )
    (_, written) = answers_to(back_end, (frames.pack_read, register), (frames.pack_write, register, read.data))
    if register.access == "RW":
        assert written.result is Result.OK
        assert refused.result in {Result.OK, Result.BAD_VALUE}
    else:
        assert written.result is refused.result is Result.READ_ONLY
        assert again.data == read.data


def test_bits_and_values_after_reset_are_the_tables(back_end):
    described = sorted(set(Register) - ASIDE)
    for register, status in zip(
        described, answers_to(back_end, *((frames.pack_read, register) for register in described)), strict=True
    ):
        assert not status.data & ~register.used_bits, register.name
        reset = CONSTANTS.get(register.reset, register.reset)
        if register.kind is not Kind.BUILT_IN and isinstance(reset, int):
            assert status.data == reset, register.name

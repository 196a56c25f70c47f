"""register_file: which registers take which values when, and what CONTROL turns into."""

import cocotb
from clocked import after_reset, clocks

from controller.fpga.registers import REGISTERS, Control, Register, Result

SETTINGS = {
    Register.IDLE_WORD: ("idle_word_o", [0, 0xFFFFFFFF], []),
    Register.BIT_TICKS: ("bit_ticks_o", [4, 65535], [0, 3, 65536, 0x10004]),
    Register.RAMP_SAMPLES: ("ramp_samples_o", [1, 262143], [0, 262144]),
    Register.HEARTBEAT_TICKS: ("heartbeat_ticks_o", [1, 60000], [0, 60001, 0x80000000]),
    Register.CHANNEL_MASK: ("channel_mask_o", [0, 0xFFFFFFFF], []),
}


async def write(dut, register, *words):
    """Write as an accepted frame does; returns the result and the names of the pulses it caused."""
    dut.address_i.value = register
    for number, word in enumerate(words):
        getattr(dut, f"word{number}_i").value = word
    dut.write_i.value = 1
    await clocks(dut)
    result = Result(int(dut.write_result_o.value))
    pulses = {name for name in ("arm", "disarm", "clear", "stop") if getattr(dut, f"{name}_o").value}
    dut.write_i.value = 0
    await clocks(dut)
    return result, pulses


async def read(dut, register):
    dut.address_i.value = register
    dut.read_i.value = 1
    await clocks(dut)
    dut.read_i.value = 0
    return Result(int(dut.read_result_o.value)), int(dut.data_o.value)


@cocotb.test(timeout_time=100, timeout_unit="us")
async def settings_take_the_values_allowed_and_only_while_disarmed(dut):
    await after_reset(dut, off_i=1)
    for register, (name, allowed, refused) in SETTINGS.items():
        for value in allowed:
            assert await write(dut, register, value) == (Result.OK, set())
            assert int(getattr(dut, name).value) == value
        for value in refused:
            assert await write(dut, register, value) == (Result.BAD_VALUE, set())
        dut.off_i.value = 0
        assert await write(dut, register, allowed[0]) == (Result.ARMED, set())
        dut.off_i.value = 1
        assert await read(dut, register) == (Result.OK, allowed[-1])


@cocotb.test(timeout_time=100, timeout_unit="us")
async def others_are_read_only_or_unknown(dut):
    await after_reset(dut, off_i=1, fault_i=2, ignored_i=3, emissions_i=4, loaded_i=5)
    for register in Register:
        if REGISTERS[register].access == "RO":
            assert await write(dut, register, 1) == (Result.READ_ONLY, set())
    assert await write(dut, 16, 1) == (Result.UNKNOWN_REGISTER, set())
    assert await write(dut, 0x106, 1) == (Result.UNKNOWN_REGISTER, set())
    counters = (Register.FAULT, Register.TRIGGERS_IGNORED, Register.EMISSIONS, Register.SLOTS_LOADED)
    assert [(await read(dut, register))[1] for register in counters] == [2, 3, 4, 5]
    assert await read(dut, 16) == (Result.UNKNOWN_REGISTER, 5), "the value read before stays"
    dut.refused_i.value = 1
    await clocks(dut, 3)
    dut.refused_i.value = 0
    assert await read(dut, Register.FRAME_ERRORS) == (Result.OK, 3)


@cocotb.test(timeout_time=100, timeout_unit="us")
async def control_becomes_a_pulse_and_arming_needs_key_permit_and_no_fault(dut):
    await after_reset(dut, off_i=1, run_permit_i=1)
    key = (1, 0x600DF00D)
    arm = (Register.CONTROL, Control.ARM)
    assert await write(dut, *arm, *key) == (Result.OK, {"arm"})
    assert await write(dut, *arm, 2, key[1]) == (Result.BAD_KEY, set())
    assert await write(dut, *arm, 1, key[1] ^ 0x80000000) == (Result.BAD_KEY, set())
    for signal, value, reason in (
        (dut.run_permit_i, 0, Result.NO_PERMIT),
        (dut.fault_i, 2, Result.FAULTED),
        (dut.off_i, 0, Result.ARMED),
    ):
        signal.value = value
        assert await write(dut, *arm, *key) == (reason, set())
    for command in (Control.DISARM, Control.CLEAR, Control.STOP):
        assert await write(dut, Register.CONTROL, command) == (Result.OK, {command.name.lower()})
    assert await write(dut, Register.CONTROL, 5) == (Result.BAD_VALUE, set())
    assert await write(dut, Register.CONTROL, 0x101) == (Result.BAD_VALUE, set())

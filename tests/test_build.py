"""What `pip` makes of the package: with a C compiler, without one, and with one that fails."""

import os
import shutil
import subprocess
import sys
import zipfile

import pytest
from compiled_copy import KERNELS, ROOT, build_wheel
from compiled_kernels import COMPILED


def build(folder, **environment):
    """A wheel; warnings of the compiler are errors here."""
    return build_wheel(folder, **{"CFLAGS": "-Werror", "SOURCE_DATE_EPOCH": "1700000000"} | environment)


def run(code, kernel=""):
    environment = {**os.environ, "HAPTIC_PANEL_KERNEL": kernel}
    command = [sys.executable, "-c", code]
    return subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    done, wheel = build(tmp_path_factory.mktemp("built"))
    assert wheel, done.stderr
    return wheel


def test_the_wheel_carries_boards_gateware_units_and_the_compiled_kernel(wheel):
    assert "-cp311-abi3-linux_" in wheel.name
    names = zipfile.ZipFile(wheel).namelist()
    data = f"{wheel.name.split('-cp311')[0]}.data/data/share/haptic-panel"
    for wanted in (
        "boards/simulated/board.toml",
        "boards/simulated/demo.evemu",
        "fpga_rtl/haptic_core.v",
        "fpga_rtl/registers.vh",
        "fpga_rtl/simulation/wrapper.cpp",
        "fpga_rtl/simulation/leap.sv",
    ):
        assert f"{data}/{wanted}" in names
    assert any(name.startswith(f"{data}/systemd/") for name in names)
    share = data.removesuffix("/haptic-panel")
    assert {f"{share}/man/man1/haptic-panel.1", f"{share}/bash-completion/completions/haptic-panel"} <= set(names)
    assert {f"{share}/zsh/site-functions/_haptic-panel", f"{data}/boards/board.schema.json", "controller/py.typed"} <= set(names)
    assert {"controller/cli.py", "controller/device/scene/effects/effects.toml", *KERNELS} <= set(names)
    assert not any(name.startswith("tests/") or name.endswith("build_hook.py") for name in names)
    assert [name for name in names if name.endswith(".c")] == ["controller/workshop/benchmark/device/compose_reference.c"]
    assert not any(name.startswith("controller/") and name.endswith(".sh") for name in names), "those are for a checkout"
    assert f"{data}/boards/raspberry_pi.sh" in names


@pytest.mark.kernel
def test_a_wheel_is_the_same_to_the_byte_when_built_again(wheel, tmp_path):
    assert build(tmp_path)[1].read_bytes() == wheel.read_bytes()


def test_without_a_compiler_the_package_is_built_for_numpy_and_says_so(tmp_path):
    (tmp_path / "bin").mkdir()
    done, wheel = build(tmp_path, CC="", PATH=str(tmp_path / "bin"))
    assert "NumPy does its work: a C compiler" in done.stderr + done.stdout
    assert wheel.name.endswith("-py3-none-any.whl")
    names = zipfile.ZipFile(wheel).namelist()
    assert "controller/device/kernel/twin.py" in names
    assert not any(name.endswith(".so") for name in names)


@pytest.mark.parametrize("broken", [{"CC": "false"}, {"CFLAGS": "-DPy_LIMITED_API=none"}])
def test_a_compiler_that_fails_ends_the_build(tmp_path, broken):
    done, wheel = build(tmp_path, **broken)
    assert done.returncode != 0
    assert "controller/device/kernel/kernel.c does not compile: " in done.stderr + done.stdout
    assert wheel is None


def test_the_environment_chooses_the_kernel():
    code = "from controller.device import kernel; print(kernel.seal_short_frames.__module__, kernel.COMPILED)"
    assert run(code, kernel="numpy").stdout.split() == ["controller.device.kernel.twin", "False"]
    compiled = run(code, kernel="compiled")
    assert compiled.stdout.split() == [COMPILED[-1].__name__, "True"], compiled.stderr
    assert run(code).stdout == compiled.stdout
    assert run(code, kernel="narrow").stdout.split() == ["controller.device.kernel._kernel", "True"]
    assert "HAPTIC_PANEL_KERNEL=fast: compiled, narrow, numpy, or unset" in run(code, kernel="fast").stderr


def room_of_its_own(folder):
    """A copy of the kernel's room, its compiled files newer than their source, and the code that says which of them serves."""
    shutil.copytree(ROOT / "controller" / "device" / "kernel", folder / "controller" / "device" / "kernel")
    for file in ("__init__.py", "errors.py", "device/__init__.py"):
        shutil.copy(ROOT / "controller" / file, folder / "controller" / file)
    for kernel in KERNELS:
        os.utime(folder / kernel, (2e9, 2e9))
    code = f"import sys; sys.path.insert(0, {str(folder)!r}); from controller.device import kernel"
    return code + "; print(kernel.COMPILED, kernel.seal_short_frames.__module__, kernel.__file__)"


def test_a_compiled_kernel_older_than_its_source_is_not_used(tmp_path):
    code = room_of_its_own(tmp_path)
    place = str(tmp_path / "controller" / "device" / "kernel" / "__init__.py")
    assert run(code).stdout.split() == ["True", COMPILED[-1].__name__, place]
    for kernel in KERNELS:
        os.utime(tmp_path / kernel, (1e9, 1e9))
    assert run(code).stdout.split() == ["False", "controller.device.kernel.twin", place]
    assert ".abi3.so is older than kernel.c" in run(code, kernel="compiled").stderr


def test_where_the_kernel_for_avx2_is_missing_the_narrow_one_serves(tmp_path):
    code = room_of_its_own(tmp_path)
    for kernel in KERNELS[1:]:
        (tmp_path / kernel).unlink()
    for wanted in ("", "compiled"):
        done = run(code, kernel=wanted)
        assert done.stdout.split()[:2] == ["True", "controller.device.kernel._kernel"], done.stderr

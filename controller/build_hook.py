"""Compiles kernel.c while hatchling builds a wheel, or beside its source for an editable installation; chooses a wheel's wings.

Where there is no C compiler, or no headers of Python, the package is built without it and plays with the NumPy twin. A
compiler that fails ends the build. Not part of wheels.

Environment: `CC` names the compiler, else the first of cc, gcc and clang; `CFLAGS` follows our own options; both are split
as a shell does. `_PYTHON_HOST_PLATFORM` (of sysconfig) names another machine, such as linux-aarch64.

`HAPTIC_PANEL_MYPYC=1`: a wheel's modules of the loop, listed in pyproject.toml, are compiled as well, by mypyc, for this
version of CPython alone. `HAPTIC_PANEL_WING=device`: a wheel for a device, without controller/workshop.
An editable installation stays as its sources are.
"""

from __future__ import annotations

import contextlib
import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.builders.wheel import WheelBuilderConfig
from packaging.tags import platform_tags, sys_tags

SOURCE = "controller/device/kernel/kernel.c"
WORKSHOP = "controller/workshop"
EXTENSION = "controller/device/kernel/_kernel.abi3.so"
FOR_AVX2 = "controller/device/kernel/_kernel_avx2.abi3.so"  # beside it, for those processors of x86-64 that have AVX2
OPTIONS = (
    *("-std=gnu11", "-O3", "-ffp-contract=off", "-fno-math-errno", "-Wall", "-Wextra"),
    *("-shared", "-fPIC", "-fvisibility=hidden", "-DPy_LIMITED_API=0x030B0000", "-Wl,--strip-all,--no-as-needed"),
)


class KernelBuildHook(BuildHookInterface[WheelBuilderConfig]):
    """Hook of hatchling, named in pyproject.toml."""

    def dependencies(self) -> list[str]:
        """What mypyc needs: itself, and what the modules are checked against."""
        return ["mypy[mypyc]>=1.15", "numpy>=1.26", "msgspec>=0.22", "platformdirs>=4"] if _wants_mypyc() else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile the extension; a wheel with it is for every CPython from 3.11 on, on one kind of machine.

        `version` is what hatchling makes of the package, "standard" or "editable"; `build_data` is its record of the wheel: files
        from elsewhere, and its tag.
        """
        if os.environ.get("HAPTIC_PANEL_WING", "") not in ("", "device"):
            self.app.abort("HAPTIC_PANEL_WING: device, or unset for the whole package")
        if _device_wing_only():
            self.build_config.target_config["exclude"] = [*self.build_config.target_config["exclude"], f"/{WORKSHOP}"]
        if version == "editable":
            for extension in (EXTENSION, FOR_AVX2):
                Path(self.root, extension).unlink(missing_ok=True)
        compiler = _compiler()
        headers = sysconfig.get_path("include")
        lacking = "a C compiler" if not compiler else "" if Path(headers, "Python.h").exists() else f"{headers}/Python.h"
        if lacking or sys.platform != "linux":
            self.app.display_warning(f"{SOURCE} is not compiled, NumPy does its work: {lacking or 'made on Linux only'}")
            return
        self._folder = tempfile.TemporaryDirectory()
        folder = Path(self._folder.name)
        platform = next(tag for tag in platform_tags() if tag.startswith("linux_"))
        kinds = {EXTENSION: ()} | ({FOR_AVX2: ("-mavx2", "-DFOR_AVX2")} if platform == "linux_x86_64" else {})
        for extension, options in kinds.items():
            compiled = Path(self.root, extension) if version == "editable" else folder / Path(extension).name
            command = [
                *compiler,
                *OPTIONS,
                *options,
                f"-I{headers}",
                *shlex.split(os.environ.get("CFLAGS", "")),
                SOURCE,
                "-o",
                str(compiled),
            ]
            if subprocess.run(command, cwd=self.root, check=False).returncode:
                self.app.abort(f"{SOURCE} does not compile: {shlex.join(command)}")
            build_data["force_include"] |= {} if version == "editable" else {str(compiled): extension}
        if version == "editable":
            return
        build_data |= {"pure_python": False, "tag": f"cp311-abi3-{platform}"}
        if _wants_mypyc():
            python = next(sys_tags())
            build_data["tag"] = f"{python.interpreter}-{python.abi}-{platform}"
            for module in self._modules_compiled(folder):
                build_data["force_include"][str(module)] = str(module.relative_to(folder / "modules"))

    def _modules_compiled(self, folder: Path) -> list[Path]:
        """Shared objects of the listed modules, in `folder`/modules, each at its place in the package."""
        import mypyc
        from mypyc.build import mypycify
        from setuptools import Distribution

        listed = [path for path in self.config["mypyc"] if not (_device_wing_only() and path.startswith(WORKSHOP))]
        with contextlib.chdir(self.root), contextlib.redirect_stdout(sys.stderr):
            modules = mypycify([f"--cache-dir={folder / 'types'}", *listed], target_dir=str(folder / "c"), group_name="controller")
            for module in modules:  # without asserts, and no path of this computer in it: the same bytes for everybody
                places = {Path(mypyc.__file__).parent: "mypyc", folder: "build"}
                module.extra_compile_args += ["-DNDEBUG", *(f"-ffile-prefix-map={place}={name}" for place, name in places.items())]
                module.extra_link_args.append("-Wl,--strip-all")
            command = Distribution({"ext_modules": modules}).get_command_obj("build_ext")
            command.build_lib, command.build_temp = str(folder / "modules"), str(folder / "objects")
            command.parallel = os.cpu_count()
            command.ensure_finalized()
            command.run()
        return list((folder / "modules").rglob("*.so"))

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:  # noqa: ARG002
        """Remove what was compiled for the wheel."""
        if folder := getattr(self, "_folder", None):
            folder.cleanup()


def _wants_mypyc() -> bool:
    return os.environ.get("HAPTIC_PANEL_MYPYC", "") not in ("", "0")


def _device_wing_only() -> bool:
    return os.environ.get("HAPTIC_PANEL_WING") == "device"


def _compiler() -> list[str]:
    named = shlex.split(os.environ.get("CC", ""))
    return named or [name for name in ("cc", "gcc", "clang") if shutil.which(name)][:1]

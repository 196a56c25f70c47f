"""Machines of the kernel tests are made at the same time, on a computer that may lack all they need: one installs, others wait."""

import os
import subprocess
from pathlib import Path

SCRIPT = Path(__file__).parent / "install_packages.sh"
DPKG = """#!/bin/sh
echo >>"$STATE/asked"
if [ -e "$STATE/installed" ]; then echo installed; else echo config-files; fi
"""
APT = """#!/bin/sh
mkdir "$STATE/lock" || { echo "Could not get lock" >&2; exit 100; }
until [ "$(wc -l <"$STATE/asked")" -ge 3 ]; do :; done
echo "$*" >>"$STATE/calls"
case $* in *install*) touch "$STATE/installed" ;; esac
rmdir "$STATE/lock"
"""


def test_who_comes_while_another_one_installs_waits_and_finds_it_done(tmp_path):
    for name, text in (("dpkg-query", DPKG), ("apt-get", APT)):
        (tmp_path / name).write_text(text)
        (tmp_path / name).chmod(0o755)
    places = {"STATE": str(tmp_path), "XDG_CACHE_HOME": str(tmp_path / "cache"), "PATH": f"{tmp_path}:{os.environ['PATH']}"}
    runs = [subprocess.Popen(["bash", SCRIPT, "qemu"], env=os.environ | places) for _ in range(3)]
    assert [run.wait() for run in runs] == [0, 0, 0]
    first, second = (tmp_path / "calls").read_text().splitlines()
    assert first.endswith("update -q")
    assert second.endswith("install -y -q --no-install-recommends qemu")

#!/bin/sh
# Renews the lock files: what a device gets (requirements.lock), and what wheels are built with (build.lock), for every
# platform, with the hashes of all files. Run it to take newer versions, then run the tests, then commit both.
# usage: make_lock_files.sh      needs uv (`pip install uv`); versions stay within the ranges of pyproject.toml
set -eu
cd "$(dirname "$0")/.."
lock() { uv pip compile --quiet --upgrade --universal --python-version 3.11 --generate-hashes --no-emit-index-url --custom-compile-command "sh systemd/make_lock_files.sh" "$@"; }
echo pip | lock pyproject.toml - --extra update --extra watch --extra page -o systemd/requirements.lock
printf '%s\n' hatchling setuptools 'mypy[mypyc]' numpy msgspec platformdirs | lock - -c systemd/requirements.lock -o systemd/build.lock

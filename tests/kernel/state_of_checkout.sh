#!/bin/bash
# What in this checkout a release depends on, as a word: what is made of it is made once for each state.
# usage: state_of_checkout.sh FILE...     the files are scripts of this folder that make something of it
set -euo pipefail
cd "$(dirname "$0")/../.."
sources=(controller boards fpga_rtl systemd pyproject.toml README.md LICENSE "${@/#/tests/kernel/}")
find "${sources[@]}" -type f ! -name '*.pyc' ! -name '*.so' | sort | xargs sha256sum | sha256sum | cut -c1-16

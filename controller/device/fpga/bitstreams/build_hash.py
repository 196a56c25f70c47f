"""Hash of the Verilog from which a bitstream is built; the host refuses to arm any other gateware."""

from __future__ import annotations

import zlib
from pathlib import Path


def build_hash(folder: Path) -> int:
    """CRC-32 over the bytes of the `.v` and `.vh` files of a folder, in the order of their names.

    Raises FileNotFoundError if the folder holds no Verilog.
    """
    files = sorted((file for file in folder.iterdir() if file.suffix in (".v", ".vh")), key=lambda file: file.name)
    if not files:
        raise FileNotFoundError(f"{folder} holds no Verilog")
    crc = 0
    for file in files:
        crc = zlib.crc32(file.read_bytes(), crc)
    return crc

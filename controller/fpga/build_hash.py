"""Which Verilog a bitstream was built from: the link refuses to arm any other."""

from __future__ import annotations

import zlib
from pathlib import Path


def build_hash(folder: Path) -> int:
    """CRC-32 over the bytes of the `.v` and `.vh` files of a folder, in the order of their names.

    Raises
    ------
    FileNotFoundError
        If the folder holds no Verilog.
    """
    files = sorted((file for file in folder.iterdir() if file.suffix in (".v", ".vh")), key=lambda file: file.name)
    if not files:
        raise FileNotFoundError(f"{folder} holds no Verilog")
    crc = 0
    for file in files:
        crc = zlib.crc32(file.read_bytes(), crc)
    return crc

"""The simulated board with another plate, driver or waveform: what the stress tests compute with."""

import msgspec


def changed(board, **tables):
    """`board` with keys of its tables replaced, as in `changed(board, plate={"thickness_mm": 0.1})`; checked as a file is."""
    replaced = {}
    for name, keys in tables.items():
        table = getattr(board, name)
        replaced[name] = msgspec.convert(msgspec.to_builtins(table) | keys, type(table))
    return msgspec.structs.replace(board, **replaced)

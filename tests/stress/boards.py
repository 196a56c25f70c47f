"""The simulated board with another plate, driver or waveform: what the stress tests compute with."""

import msgspec

from controller.workshop.benchmark.focus.focus_emission import emission_at, evaluated_foci


def changed(board, **tables):
    """`board` with keys of its tables replaced, as in `changed(board, plate={"thickness_mm": 0.1})`; checked as a file is."""
    replaced = {}
    for name, keys in tables.items():
        table = getattr(board, name)
        replaced[name] = msgspec.convert(msgspec.to_builtins(table) | keys, type(table))
    return msgspec.structs.replace(board, **replaced)


def scaled(board, larger, thickness_mm):
    """Plate and patches `larger` times as long and wide, and so thick."""
    plate = {"thickness_mm": thickness_mm, "length_mm": board.plate.length_mm * larger, "width_mm": board.plate.width_mm * larger}
    patches = tuple(
        msgspec.structs.replace(a, x_mm=a.x_mm * larger, y_mm=a.y_mm * larger, size_mm=a.size_mm * larger) for a in board.actuators
    )
    table = msgspec.convert(msgspec.to_builtins(board.plate) | plate, type(board.plate))
    return msgspec.structs.replace(board, plate=table, actuators=patches)


def focus_on(board, points_m, memory_mb=None):
    """The field at T of an emission that focuses on points, and the figures of each focus."""
    emission = emission_at(board, points_m, memory_mb)
    return emission.field, evaluated_foci(emission, board.waveform.duration_s)

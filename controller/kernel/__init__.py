"""Inner loops of the device on buffers that the caller owns: waveforms to frames."""

from controller.kernel.twin import (
    SHORT_FRAME_BYTES,
    load_frames_bytes,
    pack_loads,
    renumber_loads,
    seal_short_frames,
    unpack_loads,
)

__all__ = ["SHORT_FRAME_BYTES", "load_frames_bytes", "pack_loads", "renumber_loads", "seal_short_frames", "unpack_loads"]

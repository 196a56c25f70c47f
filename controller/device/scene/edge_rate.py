"""How many edges a second a scene can ask for, against the limits at which the FPGA switches off."""

from __future__ import annotations

from controller.device.board.board import Board
from controller.device.scene.scene import Scene


def edge_warnings(scene: Scene, board: Board, channel_edges: int, all_edges: int) -> list[str]:
    """One line for each edge limit of the board that the scene's fixed emitters and trains would exceed.

    Edges are those in one emission, of its busiest channel and of all channels together: the worst of a bank.
    """
    spots_hz = sum({emitter.rate_hz for emitter in scene.emitters})  # fixed emitters of one rate share their emissions
    trains_hz = max((region.train_rate_hz for region in scene.regions), default=0.0)
    rate_hz = min(spots_hz + trains_hz, board.limits.max_duty / board.waveform.duration_s)
    limits = board.limits
    return [
        f"up to {rate_hz:g} emissions a second make {rate_hz * edges:.4g} edges a second {whose}, above"
        f" limits.{name} = {limit:g} of board {board.name!r}: the FPGA will switch off"
        for name, limit, edges, whose in (
            ("max_channel_edge_rate_hz", limits.max_channel_edge_rate_hz, channel_edges, "on one channel"),
            ("max_total_edge_rate_hz", limits.max_total_edge_rate_hz, all_edges, "on all channels"),
        )
        if rate_hz * edges > limit * (1 + 1e-9)
    ]

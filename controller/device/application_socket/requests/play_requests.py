"""What a client asks to be played, and where: checked before anything of it is handed to the loop."""

from __future__ import annotations

from typing import Final, NamedTuple

from controller.device.application_socket.connections.connection import Connection
from controller.device.application_socket.protocol.client_messages import Aimed, Clip, Id, PlayRequest
from controller.device.application_socket.requests.answers import Answers
from controller.device.application_socket.requests.tickets import FULL
from controller.device.board.board import Board
from controller.device.board.devices import MIN_AMPLITUDE, ApplicationSocket
from controller.device.loop.control import PanelControl
from controller.device.scene.effects import clips
from controller.device.scene.effects.clips import read_clip
from controller.errors import ConfigError, ControllerError

MOST_KEPT: Final = 64  # clips under names, of one client
MOST_KEPT_POINTS: Final = 8000  # of them all: a megabyte
CLIP_LINES: Final = 8  # that a clip counts as to its client's rate: checking the largest takes half a millisecond
UNNAMED: Final = "clip"


class Aim(NamedTuple):
    """Where an effect is to be played, and how strongly: at a point, or at fingers if that is not None."""

    x_m: float
    y_m: float
    fingers: tuple[int, ...] | None
    amplitude: float


class PlayRequests:
    """Hands what one panel's clients want to feel to the loop.

    The board's plate limits where effects can be played, its duty limit how fast.
    """

    def __init__(self, board: Board, settings: ApplicationSocket, answers: Answers) -> None:
        self._board = board
        self._max_amplitude = settings.max_amplitude
        self._answers = answers

    def play(self, client: Connection, request: PlayRequest | Clip, now_s: float, control: PanelControl) -> None:
        """Play an effect, or keep it, or say why not."""
        if isinstance(request, Clip) and not client.rate.take(now_s, CLIP_LINES - 1):
            self._answers.over_rate(client, request.id)
            return
        try:
            aim = self._aim(client, request, control)
            effect = self._effect(client, request)
        except ConfigError as error:
            self._answers.invalid(client, request.id, str(error))
            return
        if aim is None:
            self._answers.answer(client, request.id, "done")
        elif aim.fingers == ():
            self._answers.answer(client, request.id, "skipped", f"no finger is in region {request.region!r}")
        else:
            self._start(client, request.id, effect, aim, now_s, control)

    def _start(
        self, client: Connection, number: Id, effect: str | clips.ClientEffect, aim: Aim, now_s: float, control: PanelControl
    ) -> None:
        """Play at a point or at fingers; the outcome is that at the first of them."""
        ticket = self._answers.ticket(client, number)
        if ticket == FULL:
            return
        try:
            for finger in aim.fingers or (None,):
                control.play(ticket, effect, aim.x_m, aim.y_m, finger, aim.amplitude, now_s)
                ticket = FULL  # nobody waits for the others
        except ControllerError as error:
            if ticket != FULL:
                self._answers.outcome(ticket, "refused", reason=str(error))

    def _aim(self, client: Connection, request: PlayRequest | Clip, control: PanelControl) -> Aim | None:
        """Where it is to be played; None: a clip that is only kept.

        Raises ConfigError if that is no place on the plate, or the amplitude is not allowed.
        """
        places = (request.x_mm is not None or request.y_mm is not None, request.finger is not None, request.region is not None)
        if isinstance(request, Clip) and request.name is not None and not any(places):
            return None
        amplitude = self._max_amplitude if request.amplitude is None else request.amplitude
        if not MIN_AMPLITUDE <= amplitude <= self._max_amplitude:
            raise ConfigError(f"amplitude = {amplitude:g} is not {MIN_AMPLITUDE:g} to {self._max_amplitude:g}")
        if sum(places) != 1:
            kept = ", or with a name to keep it" if isinstance(request, Clip) else ""
            raise ConfigError(f"either x_mm and y_mm, or finger, or region{kept}")
        if request.finger is not None:
            return Aim(0.0, 0.0, (request.finger,), amplitude)
        if request.region is not None:
            return Aim(0.0, 0.0, control.fingers_in(client.serial, request.region), amplitude)
        return Aim(*self._point_m(request), None, amplitude)

    def _effect(self, client: Connection, request: PlayRequest | Clip) -> str | clips.ClientEffect:
        """What is to be played: a name of the scene's, or a clip, which is kept if it has a name.

        Raises ConfigError if the clip is invalid, or one too many.
        """
        if isinstance(request, PlayRequest):
            return client.clips.get(request.effect, request.effect)
        clip = read_clip(request.name or UNNAMED, request.effect, self._board)
        if request.name is not None:
            self._keep(client, request.name, clip)
        return clip

    def _keep(self, client: Connection, name: str, clip: clips.ClientEffect) -> None:
        others = [kept for other, kept in client.clips.items() if other != name]
        if len(others) >= MOST_KEPT:
            raise ConfigError(f"{MOST_KEPT} clips are kept for this client already: use one of their names again")
        points = sum(len(kept.train.rhythm) + len(kept.train.envelope) for kept in (*others, clip))
        if points > MOST_KEPT_POINTS:
            raise ConfigError(f"the clips kept for this client would have {points:,} points: at most {MOST_KEPT_POINTS:,}")
        client.clips[name] = clip

    def _point_m(self, request: Aimed) -> tuple[float, float]:
        plate = self._board.plate
        if request.x_mm is None or request.y_mm is None:
            raise ConfigError("either x_mm and y_mm, or finger, or region")
        for key, at_mm, most_mm in (("x_mm", request.x_mm, plate.length_mm), ("y_mm", request.y_mm, plate.width_mm)):
            if not 0.0 <= at_mm <= most_mm:
                raise ConfigError(f"{key} = {at_mm:g} is off the plate (0 to {most_mm:g})")
        return request.x_mm * 1e-3, request.y_mm * 1e-3

"""Clients' layers of regions over the scene: which are in force, which are being prepared, and where each lies."""

from __future__ import annotations

from dataclasses import dataclass

from controller.device.loop.commands import CommandSource
from controller.device.loop.preparation import AcceptedLayer, LayerPreparation, LayerResult
from controller.device.loop.scheduler import Scheduler
from controller.device.scene.layers import UNMOVED, Layer, Placement
from controller.device.scene.scene import Scene
from controller.errors import ConfigError


@dataclass(slots=True, eq=False)
class _Wanted:
    """A layer that was sent and is not in force yet: its line, and where it is to lie (None: where the one before lies)."""

    ticket: int
    line: bytes
    placed: Placement | None
    given_s: float
    moved: Placement | None = None  # sent after the line


@dataclass(slots=True, eq=False)
class _Client:
    """Layers of one client: in force, being prepared, waiting for that."""

    in_force: AcceptedLayer | None = None
    placement: Placement = UNMOVED
    prepared: _Wanted | None = None
    waiting: _Wanted | None = None


class Layers:
    """Layers over the scene of one loop; each is taken over between two turns.

    What became of each layer is reported to `commands`; without `preparation` there are none.
    """

    def __init__(self, scheduler: Scheduler, preparation: LayerPreparation | None, commands: CommandSource | None) -> None:
        self._scheduler = scheduler
        self.scene = scheduler.scene  # that lies below, alone
        self._preparation = preparation
        self._commands = commands
        self._clients: dict[int, _Client] = {}
        self.pending = False  # a layer is being prepared
        self._in_turn = -1  # owner of the layer that is, or was last, prepared

    def fileno(self) -> int | None:
        """File that becomes readable when a layer is prepared; None while none is being prepared."""
        return None if self._preparation is None else self._preparation.fileno()

    def put(self, ticket: int, owner: int, line: bytes, placement: Placement | None, now_s: float) -> None:
        """Replace a client's layer of regions, once it is checked outside the loop; `CommandSource.layered` follows.

        The layer of a higher owner lies on top. `line` is JSON, as `layer_tables.read_layer` takes it. With no placement the
        layer lies where the one before lies. Raises ConfigError, and `layered` does not follow, if this panel takes no layers.
        """
        if self._preparation is None:
            raise ConfigError("this panel takes no regions: it was started without the process that checks them")
        client = self._clients.setdefault(owner, _Client())
        wanted = _Wanted(ticket, line, placement, now_s)
        if client.waiting is not None:
            if placement is None:
                wanted.placed, wanted.moved = client.waiting.placed, client.waiting.moved
            self._report(client.waiting.ticket, LayerResult(now_s - client.waiting.given_s))
        client.waiting = wanted
        self._begin_next()

    def move(self, owner: int, placement: Placement) -> None:
        """Move a client's layer: at once, or with the one that is being prepared; ConfigError if it has sent none."""
        client = self._clients.get(owner)
        if client is None:
            raise ConfigError("there is nothing to move: this client has sent no regions")
        newest = client.waiting or client.prepared
        if newest is not None:
            newest.moved = placement
        elif placement != client.placement:
            client.placement = placement
            self._take_over()

    def drop(self, owner: int, now_s: float) -> None:
        """Remove the layer of a client that has gone."""
        client = self._clients.pop(owner, None)
        if client is None:
            return
        if client.waiting is not None:
            self._report(client.waiting.ticket, LayerResult(now_s - client.waiting.given_s))
        if client.prepared is not None:
            self._report(client.prepared.ticket, LayerResult(now_s - client.prepared.given_s))
        if client.in_force is not None:
            self._take_over()

    def over(self, scene: Scene) -> Scene:
        """Another scene, with the layers that are in force; the scheduler is to take it."""
        self.scene = scene
        return scene.under(self._stack())

    def turn(self, now_s: float) -> None:
        """Take over the layer that is prepared, and have the next one prepared."""
        if self._preparation is None:
            return
        taken = self._preparation.take()
        if taken is None:
            return
        self.pending = False
        client = self._clients.get(self._in_turn)
        if client is not None and client.prepared is not None:
            wanted, client.prepared = client.prepared, None
            self._settle(client, wanted, taken, now_s)
        self._begin_next()

    def _settle(self, client: _Client, wanted: _Wanted, taken: AcceptedLayer | str, now_s: float) -> None:
        """A layer was prepared or refused: it is in force, or the one before stays; and report it."""
        age_s = now_s - wanted.given_s
        before = client.in_force
        if not isinstance(taken, str):
            client.in_force = taken if taken.regions else None
            client.placement = wanted.placed or client.placement
        client.placement = wanted.moved or client.placement
        if before is not None or client.in_force is not None:
            self._take_over()
        self._report(
            wanted.ticket, LayerResult(age_s, reason=taken) if isinstance(taken, str) else LayerResult(age_s, accepted=taken)
        )

    def _begin_next(self) -> None:
        """Have the layer prepared that waits for longest since its client's turn; clients take turns."""
        assert self._preparation is not None
        if self.pending:
            return
        owners = [owner for owner, client in self._clients.items() if client.waiting is not None]
        if not owners:
            return
        self._in_turn = min(owners, key=lambda owner: (owner <= self._in_turn, owner))
        client = self._clients[self._in_turn]
        wanted = client.prepared = client.waiting
        client.waiting = None
        assert wanted is not None
        self._preparation.begin(wanted.line, wanted.moved or wanted.placed or client.placement)
        self.pending = True

    def _stack(self) -> tuple[Layer, ...]:
        """Layers in force, the topmost first: that of the client that connected last."""
        found = []
        for owner in sorted(self._clients, reverse=True):
            client = self._clients[owner]
            if client.in_force is not None:
                found.append(Layer(owner, client.in_force.regions, client.in_force.lookup, client.placement))
        return tuple(found)

    def _take_over(self) -> None:
        self._scheduler.change_layers(self.scene.under(self._stack()))

    def _report(self, ticket: int, result: LayerResult) -> None:
        if self._commands is not None:
            self._commands.layered(ticket, result)

"""Layers of clients in the loop: whose lies on top, what is prepared when, where each lies, and who is answered what."""

import pytest

from controller.clocks import FpgaTime
from controller.device.loop.layers import Layers
from controller.device.loop.preparation import AcceptedLayer
from controller.device.loop.scheduler import Scheduler
from controller.device.scene.effects.trains import Train
from controller.device.scene.layers import UNMOVED, Placement
from controller.device.scene.scene import Region, Scene, SpatialIndex
from controller.device.scene.shapes import Rectangle
from controller.errors import ConfigError
from controller.metrics import Counters

MOVED, ELSEWHERE = Placement(0.01), Placement(0.02, 0.0, 2.0)


def accepted(*names):
    regions = tuple(Region(name, Rectangle(0.0, 0.0, 0.1, 0.1), press=(Train(),)) for name in names)
    return AcceptedLayer(regions, SpatialIndex.of(regions).lookup(regions), 0, (), 0)


class Prepares:
    """A `LayerPreparation` that is done when the test says so."""

    def __init__(self):
        self.begun = []
        self.busy = False
        self.done = None

    def begin(self, line, placement):
        assert not self.busy
        self.busy = True
        self.begun.append((line, placement))

    def fileno(self):
        return None

    def take(self):
        done, self.done = self.done, None
        self.busy = self.busy and done is None
        return done


class Told:
    def __init__(self):
        self.said, self.ages_s = [], []

    def layered(self, ticket, result):
        self.ages_s.append(result.age_s)
        self.said.append((ticket, "refused" if result.reason else "merged" if result.accepted is None else "done"))


class Stack:
    def __init__(self):
        self.preparation, self.told = Prepares(), Told()
        self.scheduler = Scheduler(Scene(accepted("scene").regions), Counters(), lambda _: True, 9, lambda *_: None)
        self.layers = Layers(self.scheduler, self.preparation, self.told)
        self.tickets = 0

    def put(self, owner, line=b"{}", placement=None):
        self.tickets += 1
        self.layers.put(self.tickets, owner, line, placement, 1.0)
        return self.tickets

    def prepared(self, result):
        self.preparation.done = result
        self.layers.turn(2.0)

    @property
    def names(self):
        return [region.name for region in self.scheduler.scene.regions]

    @property
    def placements(self):
        return [layer.placement for layer in self.scheduler.scene.layers]


@pytest.fixture
def stack():
    return Stack()


def test_the_layer_of_who_connected_last_is_on_top_whoever_sends_last(stack):
    for owner, name in ((2, "new"), (1, "old"), (2, "newer")):
        stack.put(owner)
        stack.prepared(accepted(name))
    assert stack.names == ["newer", "old", "scene"]
    assert stack.told.said == [(1, "done"), (2, "done"), (3, "done")]


def test_one_is_prepared_at_a_time_the_clients_take_turns_and_of_each_the_newest_counts(stack):
    first = stack.put(1, b"1a")
    overtaken = stack.put(1, b"1b")
    stack.put(3, b"3")
    stack.put(2, b"2")
    stack.put(1, b"1c")
    assert stack.told.said == [(overtaken, "merged")]
    for name in ("a", "b", "c", "d"):
        stack.prepared(accepted(name))
    assert [line for line, _ in stack.preparation.begun] == [b"1a", b"2", b"3", b"1c"]
    assert stack.told.said[1] == (first, "done")
    assert stack.names == ["c", "b", "d", "scene"]
    assert not stack.layers.pending


def test_a_refused_layer_leaves_the_one_before_and_an_empty_one_removes_it(stack):
    stack.put(1)
    stack.prepared(accepted("a"))
    stack.put(1, placement=MOVED)
    stack.prepared("no")
    assert (stack.names, stack.placements) == (["a", "scene"], [UNMOVED])
    stack.put(1)
    stack.prepared(accepted())
    assert (stack.names, stack.placements) == (["scene"], [])
    assert stack.told.said == [(1, "done"), (2, "refused"), (3, "done")]


def test_a_transform_is_in_force_at_once_or_with_the_layer_that_is_prepared(stack):
    stack.put(1, placement=MOVED)
    stack.prepared(accepted("a"))
    assert stack.placements == [MOVED]
    stack.layers.move(1, ELSEWHERE)
    assert stack.placements == [ELSEWHERE]
    stack.put(1, placement=UNMOVED)
    stack.layers.move(1, MOVED)
    assert stack.placements == [ELSEWHERE]
    stack.prepared(accepted("b"))
    assert (stack.names, stack.placements) == (["b", "scene"], [MOVED])
    stack.put(1)
    stack.prepared(accepted("c"))
    assert stack.placements == [MOVED]


def test_a_transform_sent_to_a_layer_that_is_overtaken_or_refused_is_not_lost(stack):
    stack.put(1)
    stack.prepared(accepted("a"))
    stack.put(1)  # is being prepared
    stack.put(1)
    stack.layers.move(1, MOVED)
    stack.put(1)
    stack.prepared(accepted("b"))
    stack.prepared("no")
    assert (stack.names, stack.placements) == (["b", "scene"], [MOVED])


def test_layers_go_with_their_client_whatever_of_them_is_under_way(stack):
    stack.put(1)
    stack.prepared(accepted("a"))
    stack.put(1)
    stack.put(1)
    stack.layers.drop(1, 3.0)
    assert stack.names == ["scene"]
    assert stack.told.said == [(1, "done"), (3, "merged"), (2, "merged")]
    stack.put(2)
    stack.prepared(accepted("of the one that has gone"))
    assert stack.names == ["scene"]
    stack.prepared(accepted("b"))
    assert stack.names == ["b", "scene"]
    stack.layers.drop(7, 3.0)


def test_each_is_answered_how_long_ago_it_was_sent(stack):
    for ticket, sent_s in ((1, 1.0), (2, 1.25), (3, 2.0)):  # is prepared; waits, and is overtaken; waits
        stack.layers.put(ticket, 1, b"{}", None, sent_s)
    stack.preparation.done = accepted("a")
    stack.layers.turn(2.5)
    stack.layers.put(4, 1, b"{}", None, 3.0)
    stack.layers.drop(1, 4.0)
    assert [ticket for ticket, _ in stack.told.said] == [2, 1, 4, 3]
    assert stack.told.ages_s == [0.75, 1.5, 1.0, 2.0]


def test_another_scene_comes_below_the_layers(stack):
    stack.put(1)
    stack.prepared(accepted("a"))
    stack.scheduler.change_scene(stack.layers.over(Scene(accepted("other").regions)), FpgaTime(1.0))
    assert stack.names == ["a", "other"]
    stack.layers.drop(1, 1.0)
    assert stack.names == ["other"]


def test_without_a_preparation_there_are_no_layers(stack):
    layers = Layers(stack.scheduler, None, stack.told)
    with pytest.raises(ConfigError, match="takes no regions"):
        layers.put(1, 1, b"{}", None, 0.0)
    with pytest.raises(ConfigError, match="nothing to move"):
        layers.move(1, MOVED)
    layers.turn(0.0)
    assert (layers.fileno(), layers.pending) == (None, False)

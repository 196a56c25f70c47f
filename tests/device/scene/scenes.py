"""Scenes and shapes that several tests use."""

from hypothesis import strategies as st

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.scene.effects.trains import Train
from controller.device.scene.fingers import ActiveEffects
from controller.device.scene.scene import Region, Scene, load_scene
from controller.device.scene.shapes import Circle, Polygon, Rectangle
from controller.device.touch.source import TouchSample

BOARD = load_board(data_folder("boards") / "simulated")


def square(effects, name="square", x_mm=50, size_mm=40):
    place = f"x_mm = {x_mm}\ny_mm = 50\nwidth_mm = {size_mm}\nheight_mm = {size_mm}"
    return f'name = "{name}"\nshape = "rectangle"\n{place}\neffects = [{effects}]'


CLICK = '{ effect = "click" }'


TRAIN = '{ effect = "train", rate_hz = 100, duration_ms = 30 }'


TEXTURE = '{ effect = "texture", spacing_mm = 5 }'


ALWAYS = '{ effect = "always", rate_hz = 20 }'


PRESS, RELEASE, ENTER, LEAVE = (f'{{ when = "{occasion}" }}' for occasion in ("press", "release", "enter", "leave"))


FIVE = "rate_hz = 100, count = 5"


PRESSED = f'{{ when = "press", {FIVE} }}'


SHAPES = [
    Rectangle(0.02, 0.03, 0.09, 0.04),
    Rectangle(0.0, 0.0, 0.210, 0.148),
    Circle(0.05, 0.06, 0.0501),
    Circle(0.2052, 0.0811, 0.0012),
    Polygon(((0.01, 0.01), (0.2, 0.02), (0.1, 0.04), (0.15, 0.14), (0.02, 0.1), (0.06, 0.05))),
    Polygon(((0.0, 0.0), (0.0, 0.0011), (0.2, 0.148))),
]


fractions = st.floats(0, 1)


def point_in(shape, u, v):
    """A point of the shape, near the given place of its bounds; None if that place is not in it."""
    low_x, low_y, high_x, high_y = shape.bounds
    x, y = low_x + u * (high_x - low_x), low_y + v * (high_y - low_y)
    return (x, y) if shape.contains(x, y) else None


LIBRARY_SCENE = load_scene(BOARD.folder / "library.toml", BOARD)


def at(x_mm, y_mm=70.0, time_s=0.0, contact=True, finger=3):
    return TouchSample(finger, x_mm * 1e-3, y_mm * 1e-3, time_s, contact)


def on_touch(scene, active, sample):
    """Active effects of a finger after a sample (None: it is lifted), and the emissions that are due; `active` None: it is new."""
    if active is None:
        active = ActiveEffects(scene, sample.finger, sample.x_m, sample.y_m)
        return (active, active.press(sample.time_s)) if sample.contact else (None, ())
    if sample.contact:
        return active, active.move(sample.x_m, sample.y_m, sample.time_s)
    return None, active.release(sample.time_s)


def touch(scene, *samples):
    """Emissions of each sample of one finger, as (x in mm, region) or None, and its state after them."""
    state, felt = None, []
    for sample in samples:
        state, emissions = on_touch(scene, state, sample)
        assert len(emissions) <= 1
        assert all((e.time_s, e.finger, e.owner, e.y_m, e.amplitude) == (sample.time_s, 3, 3, sample.y_m, 1.0) for e in emissions)
        felt.append((round(emissions[0].x_m * 1e3, 6), emissions[0].region) if emissions else None)
    return felt, state


def press_scene(shape):
    """A scene of one region of this shape, felt at a press."""
    return Scene((Region("a", shape, press=(Train(),)),))

"""The field view in a real browser: what it computes is what `focus` computes, and what it shows can be used and read."""

import base64
import os
from pathlib import Path

import numpy as np
import pytest
from chromium import PROGRAM, browser

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.workshop.benchmark.focus.focus_emission import emission_at, evaluated_foci
from controller.workshop.benchmark.focus.focus_figures import emit
from controller.workshop.physics.field import map_axis
from controller.workshop.physics.pictures.field_file import write_field
from controller.workshop.physics.pictures.movie import Movie

pytestmark = [pytest.mark.slow, pytest.mark.skipif(PROGRAM is None, reason="no browser: apt-get install chromium")]
PICTURES = os.environ.get("HAPTIC_PANEL_PICTURES")  # a folder: store what the page looks like there
BOARD = load_board(find_board("simulated"))
EVERY = 25  # frames
NOBODY = "/nowhere/panel.sock"  # the view needs no panel


@pytest.fixture(scope="module")
def page():
    with browser() as tab:
        yield tab


@pytest.fixture(scope="module")
def field_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("field") / "simulated.field"
    write_field(BOARD, path)
    return path


@pytest.fixture
def view(page, bridge_with, field_file):
    """The page in a window, when it has shown its first emission; the reader has asked for no less motion."""
    bridge = bridge_with(f'field = "{field_file}"', socket=NOBODY)

    def view(width=1280, height=900, scale=1, *, mobile=False, scheme="light", motion="no-preference"):
        page.size(width, height, scale, mobile=mobile)
        media = {"prefers-color-scheme": scheme, "prefers-reduced-motion": motion}
        page.call("Emulation.setEmulatedMedia", features=[{"name": name, "value": value} for name, value in media.items()])
        page.open(f"{bridge.address}live/field.html")
        page.until("document.getElementById('state').textContent.startsWith('At ')")
        return page

    page.said.clear()
    yield view
    page.call("Page.navigate", url="about:blank")
    assert page.said == []


def array(page, expression, of):
    """What JavaScript has as a typed array."""
    to_text = "(one) => btoa(Array.from(new Uint8Array(one.buffer), (byte) => String.fromCharCode(byte)).join(''))"
    return np.frombuffer(base64.b64decode(page.value(f"({to_text})({expression})")), of)


def text(page, name):
    return page.value(f"document.getElementById('{name}').textContent")


def seek(page, frame):
    page.value(
        f"{{ const time = document.getElementById('time'); time.value = {frame}; time.dispatchEvent(new Event('input')); }} 0"
    )


@pytest.mark.parametrize("point_mm", [(100.0, 70.0), (60.3, 90.7), (22.5, 127.4)])
def test_the_field_is_that_of_focus_and_of_the_plate_twin(view, point_mm):
    """At T by the twin's sum over steps, at other times by the movie's recursion over blocks: neither is the page's own."""
    page = view()
    page.value(
        "import('/live/field_model.js').then(async ({FieldModel}) => {"
        " window.model = new FieldModel(await (await fetch('/live/plate.field')).arrayBuffer()); })"
    )
    x_m, y_m = np.array(point_mm) * 1e-3
    page.value(f"window.words = model.words({x_m}, {y_m}); window.played = model.play(words); 0")
    words = array(page, "words", "<u4")
    played = array(page, "played", "<f4").reshape(page.value("model.frames"), -1)
    emission = emission_at(BOARD, [(x_m, y_m)])
    twin, (figures,) = emission.twin, evaluated_foci(emission, BOARD.waveform.duration_s)

    field = emit(twin, words)
    at_t = len(words) - 1
    assert np.abs(played[at_t] - field.modal).max() < 1e-4 * np.abs(field.modal).max()
    movie = Movie.of(twin, -at_t * 2e-6, (len(played) - 1 - at_t) * 2e-6, EVERY * 2e-6)
    modal = np.concatenate(list(movie.amplitudes(twin, words)))
    assert len(modal) == len(movie.bits) > 40
    assert np.abs(played[movie.bits] - modal).max() < 1e-4 * np.abs(modal).max()
    assert np.abs(played[movie.bits - 1] - modal).max() > 1e-2 * np.abs(modal).max(), "a frame beside it is another"

    history = array(page, f"model.history(played, {x_m}, {y_m})", "<f8")
    assert history[at_t] == pytest.approx(field.at([(x_m, y_m)])[0], rel=1e-4)
    assert abs(np.argmax(np.abs(history)) - at_t) <= 1
    columns, rows = page.value("[model.columns, model.rows]")
    x, y = map_axis(BOARD.plate.length_m, BOARD.plate.length_m / columns), map_axis(BOARD.plate.width_m, BOARD.plate.width_m / rows)
    shown = array(page, f"model.map(played, {at_t})", "<f4").reshape(rows, columns)
    assert np.abs(shown - twin.modes.on_grid(field.modal, x, y)).max() < 1e-3 * abs(history[at_t])

    field.__dict__["modal"] = played[at_t].astype(float)  # figures of merit of the page's own field
    pages = field.focus_metrics(x_m, y_m)
    assert pages.amplitude_m * 1e6 == pytest.approx(figures["amplitude_um"], rel=0.02)
    assert pages.spot_m * 1e3 == pytest.approx(figures["spot_mm"], rel=0.02)
    assert pages.contrast == pytest.approx(figures["contrast"], rel=0.02)
    print(
        f"{point_mm}: {figures['amplitude_um']:.3f} um, {figures['spot_mm']:.3f} mm, {figures['contrast']:.2f} by focus;"
        f" {pages.amplitude_m * 1e6:.3f}, {pages.spot_m * 1e3:.3f}, {pages.contrast:.2f} by the page"
    )


def test_a_press_plays_once_and_keys_move_the_point(view):
    page = view()
    page.until("document.getElementById('play').textContent === 'Pause'")
    left, top, width, height = page.value(
        "(({x, y, width, height}) => [x, y, width, height])(document.getElementById('plate').getBoundingClientRect())"
    )
    for kind in ("mousePressed", "mouseReleased"):
        place = {"x": left + width * 0.25, "y": top + height * 0.75}
        page.call("Input.dispatchMouseEvent", type=kind, button="left", buttons=1, clickCount=1, **place)
    page.until("document.getElementById('state').textContent.startsWith('At 52.')")
    x_mm, y_mm = (float(page.value(f"document.getElementById('{axis}').value")) for axis in ("x_mm", "y_mm"))
    assert (x_mm, y_mm) == (pytest.approx(52.5, abs=0.3), pytest.approx(37.0, abs=0.3))
    page.until("Number(document.getElementById('time').value) > 950")
    page.until("document.getElementById('play').textContent === 'Play'")  # at the end, by itself
    page.value("document.getElementById('plate').focus(); 0")
    for key, shift in (("ArrowRight", 0), ("ArrowUp", 8), ("ArrowUp", 0)):
        page.call("Input.dispatchKeyEvent", type="keyDown", key=key, modifiers=shift)
    page.until(f"document.getElementById('state').textContent.startsWith('At {x_mm + 1:.1f}, {y_mm + 11:.1f} mm')")
    page.call("Input.dispatchKeyEvent", type="keyDown", key=" ")
    page.until("document.getElementById('play').textContent === 'Pause'")
    seek(page, 999)
    assert text(page, "play") == "Play"
    assert text(page, "now").startswith("0.000 ms from T: ")
    assert page.value("document.getElementById('time').getAttribute('aria-valuetext')") == "0.000 ms from T"
    label = page.value("document.getElementById('map').getAttribute('aria-label')")
    assert label.startswith(
        f"Displacement of the plate 0.000 ms from T: {text(page, 'now').split(': ')[1].removesuffix(' at the point')}"
    )
    assert page.value("document.querySelector('#map[role=img]') !== null")


def test_whoever_asked_for_less_motion_sees_the_focus_and_may_play(view):
    page = view(motion="reduce")
    assert page.value("document.getElementById('time').value") == "999"
    assert text(page, "play") == "Play"
    page.value("document.getElementById('play').click(); 0")
    page.until("Number(document.getElementById('time').value) > 999")


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize(("called", "window"), [("desktop", (1280, 900, 1)), ("phone", (390, 844, 2))])
def test_what_it_looks_like(view, scheme, called, window, tmp_path):
    page = view(*window, mobile=called == "phone", scheme=scheme)
    folder = Path(PICTURES) if PICTURES else tmp_path
    assert page.value("document.documentElement.scrollWidth") == window[0]
    for frame, moment in ((955, "before"), (999, "focus")):
        seek(page, frame)
        page.picture(folder / f"field_{called}_{scheme}_{moment}.png")
    image = "(({width, height}) => map.getContext('2d').getImageData(0, 0, width, height).data)(map)"
    lightness = array(page, image, np.uint8).reshape(-1, 4)[:, :3].sum(axis=1).astype(int)
    stands_out = lightness.max() - np.median(lightness) if scheme == "dark" else np.median(lightness) - lightness.min()
    assert stands_out > 300, "by its lightness alone"


def test_without_the_file_the_page_says_how_to_make_it(page, bridge_with):
    page.open(f"{bridge_with(socket=NOBODY).address}live/field.html")
    page.until("document.getElementById('state').textContent.includes('haptic-panel focus --field-out FILE')")
    assert page.value("document.querySelector('main').hidden")
    page.said.clear()  # the browser writes that it is not there

"""haptic.js and the live page in a real browser, before the simulated panel: a finger feels the element under it, and no other.

What the page has sent is compared with the browser's own hit test: at random points of the plate, the first region there has to be
that of the element that a touch at this point would meet.
"""

import itertools
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from chromium import PROGRAM, browser
from kernel.serial_finger import LARGEST, SerialPanel
from patience import wait_for

from controller.device.application_socket.client import PanelClient
from controller.device.scene.scene import load_scene

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(PROGRAM is None, reason="no browser: apt-get install chromium"),
]
FOLDER = Path(__file__).parent
POINTS = 2000
PICTURES = os.environ.get("HAPTIC_PANEL_PICTURES")  # a folder: store what the live page looks like there


@pytest.fixture(scope="module")
def page():
    with browser() as tab:
        tab.size(1000, 700)
        yield tab


@pytest.fixture
def elements(page, bridge_with, tmp_path):
    """The page of the elements, whose layer has arrived."""
    (tmp_path / "www").mkdir()
    for name in ("elements.css", "elements.js"):
        shutil.copy(FOLDER / name, tmp_path / "www")
    shutil.copy(FOLDER / "elements.html", tmp_path / "www" / "index.html")
    bridge = bridge_with("messages_per_s = 1000\nburst = 1000", www=tmp_path / "www")
    page.leave()
    page.size(1000, 700)
    page.open(bridge.address)
    settled(page)
    yield page
    page.call("Page.navigate", url="about:blank")
    assert page.said == []


def settled(page):
    """Until the panel has what is seen."""
    page.value("HapticPanel.look(); new Promise((done) => setTimeout(done, 300))")
    page.until("layers.length && layers.at(-1).answer.kind === 'layer'")
    assert page.value("layers.at(-1).answer.refused") == []


def right(page):
    settled(page)
    found = page.value(f"compare({POINTS})")
    assert found["asked"] > 0.9 * POINTS, found
    assert found["right"] >= 0.995 * found["asked"], found
    assert found["felt"] > 0.02 * POINTS, found


def test_what_is_felt_is_what_a_touch_would_meet(elements):
    right(elements)
    names = elements.value("layers.at(-1).regions.filter((one) => one.effects.length).map((one) => one.name)")
    for hidden in ("hidden", "invisible", "transparent", "disabled", "inert", "untouchable", "none", "aria"):
        assert not [name for name in names if name.startswith(f"{hidden} ")], names


@pytest.mark.parametrize(
    "change",
    [
        "document.getElementById('list').scrollTop = 90",
        "document.getElementById('list').scrollTop = 25",
        "document.getElementById('turned').style.transform = 'rotate(73deg) scale(1.3)'",
        "document.getElementById('moved').style.left = '500px'",
        "document.getElementById('moved').style.translate = '60px 20px'",
        "document.getElementById('zoomed').style.zoom = 2",
        "document.body.style.zoom = 1.25",
        "document.getElementById('above').style.zIndex = -1",
        "document.getElementById('below').remove()",
        "document.getElementById('dialog').showModal()",
        "document.querySelector('fieldset').disabled = true",
        "document.styleSheets[0].insertRule('#plain { display: none }')",
    ],
)
def test_it_follows_what_changes(elements, change):
    elements.value(f"{change}; 0")
    elements.value("new Promise((done) => setTimeout(done, 700))")  # what no event announces is looked for twice a second
    right(elements)


def test_it_follows_the_window_and_its_pixels(elements):
    for size in ((800, 600), (1200, 500)):
        elements.size(*size, 2)
        right(elements)


def test_an_animation_is_followed_to_its_end(elements):
    before = elements.value("layers.length")
    elements.value("moves('moved', '300px 100px', 1500)")
    assert elements.value("layers.length") - before >= 3
    right(elements)


def test_a_page_that_is_hidden_takes_its_layer_along_and_brings_it_again(elements):
    elements.value("hide(true)")
    elements.until("layers.at(-1).regions.length === 0")
    elements.value("hide(false)")
    right(elements)


def test_effects_are_those_of_attribute_property_and_other_names(elements):
    effects = elements.value(
        "Object.fromEntries(layers.at(-1).regions.map((one) => [one.name.replace(/ \\d+$/, ''), one.effects]))"
    )
    assert effects["plain"] == [{"effect": "click"}]
    assert effects["weak"] == [{"effect": "click", "amplitude": 0.5}]
    assert effects["styled"] == [{"effect": "buzz", "amplitude": 0.5}]
    assert effects["foreign"] == [{"effect": "click", "amplitude": 0.3}]
    assert effects["on"] == [{"effect": "click", "when": ["press", "enter"]}]


WAYS = """
  window.ways = [];
  window.WebSocket = class extends WebSocket {
    constructor(address) { super(String(address).replace(/stop$/, "%s")); }
    send(text) { ways.push([new URL(this.url).pathname, JSON.parse(text).kind]); super.send(text); }
  };
"""
FLOODS = """(async () => {
  for (let i = 0; i < 10000; i++) HapticPanel.send({ kind: "state" });
  const before = performance.now(), { outcome } = await HapticPanel.stop();
  return [outcome, performance.now() - before, ...ways.at(-1)];
})()"""


@pytest.mark.parametrize("way", ["stop", "panel"])
def test_a_stop_has_a_way_of_its_own_and_without_it_takes_that_of_all_messages(elements, way):
    """With 10,000 messages in front: how long each takes is printed."""
    script = elements.call("Page.addScriptToEvaluateOnNewDocument", source=WAYS % ("stop" if way == "stop" else "none"))
    try:
        elements.call("Page.reload")
        elements.until("typeof layers !== 'undefined' && layers.length")
        outcome, took_ms, *taken = elements.value(FLOODS)
    finally:
        elements.call("Page.removeScriptToEvaluateOnNewDocument", identifier=script["identifier"])
    assert (outcome, taken) == ("done", [f"/{way}", "stop"])
    print(f"by /{way}, with 10,000 messages before it: {took_ms:.0f} ms")
    if way != "stop":
        assert "/none" in elements.said.pop()  # the browser names what it could not open


def test_calls_play_at_places_elements_and_pointers(elements):
    for where in ("{x: 500, y: 350}", "document.getElementById('plain')"):
        assert elements.value(f"HapticPanel.play('tick', {where})")["outcome"] == "played"
    assert elements.value("HapticPanel.play('click', 77)")["reason"] == "no such place"
    assert elements.value("HapticPanel.play('nothing', {x: 500, y: 350})")["outcome"] == "refused"
    assert elements.value("HapticPanel.play({pulses: [[0, 1], [40, 0.5]]}, {x: 500, y: 350})")["outcome"] == "played"
    assert "is no effect" in elements.value("HapticPanel.play({effect: 'nothing'}, {x: 500, y: 350})")["reason"]
    point = [{"x": 300, "y": 300, "id": 1}]
    elements.value("addEventListener('pointerdown', (event) => window.pointer = event.pointerId); 0")
    elements.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=point)
    assert elements.value("HapticPanel.play('click', pointer)")["outcome"] == "played"
    elements.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])


@pytest.fixture
def touched_panel(board, bank_file, folder, tmp_path):
    """`haptic-panel run` with a touch panel at a serial port, and an FPGA that is not there: the panel, and the socket."""
    panel, socket, copy = SerialPanel(), folder / "touched.sock", tmp_path / "touched"
    shutil.copytree(board.folder, copy)
    head, tail = (copy / "board.toml").read_text().split("[touch]\n")
    link = tail.partition("[link]\n")[2].replace(
        'kind = "simulated"', f'kind = "serial"\ndevice = "{tmp_path / "fpga"}"\nbaud = 12_000_000'
    )
    touch = (
        f'[touch]\nkind = "serial_panel"\ndevice = "{panel.device}"\nx_mm_from_axes = [210.0, 0.0, 0.0]\n'
        f'y_mm_from_axes = [0.0, 148.0, 0.0]\n\n[application_socket]\npath = "{socket}"\n\n'
        "[realtime]\npriority = 0\nlock_memory = false\n\n"
    )
    (copy / "board.toml").write_text(f"{head}{touch}[link]\n{link}")
    command = [sys.executable, "-m", "controller", "run", "--board", copy, "--bank", bank_file]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as service:
        wait_for("its socket", socket.exists)
        yield panel, str(socket)
        service.terminate()


def test_four_taps_say_where_the_screen_lies(page, bridge_with, touched_panel, tmp_path):
    """A screen that is turned, smaller than the plate and not at its corner, with two device pixels to one of CSS."""
    panel, socket = touched_panel
    bridge = bridge_with('[origins]\nself = ["screen", "play"]', socket=socket)
    truth = np.array([[0.0805, 0.0012, 11.0], [0.0011, -0.0795, 139.0]])  # mm from device pixels
    page.leave()
    page.size(1000, 700, 2)
    page.open(f"{bridge.address}live/screen.html")
    page.until("!document.getElementById('begin').disabled")
    page.value("document.getElementById('begin').click(); 0")
    page.value(
        "reports = 0; lifted = false; HapticPanel.addEventListener('message', ({detail: {kind, contact}}) =>"
        " { if (kind === 'touch') [reports, lifted] = contact ? [reports + 1, false] : [0, true]; }); 0"
    )

    def tap(number, off_mm=0.0):
        """Touch the cross of this number, or a place beside it."""
        page.until(f"document.getElementById('cross').dataset.number === '{number}'")
        left, top = page.value("['left', 'top'].map((side) => parseFloat(document.getElementById('cross').style[side]))")
        x_mm, y_mm = truth @ [2 * left, 2 * top, 1] + off_mm
        with panel.finger(itertools.repeat((round(x_mm / 210 * LARGEST), round(y_mm / 148 * LARGEST)))):
            page.until("reports")
        page.until("lifted")

    for number in range(1, 5):
        tap(number, off_mm=8.0 if number == 4 else 0.0)
    page.until("document.getElementById('say').textContent.startsWith('These touches do not fit together')")
    assert page.value("document.getElementById('keep').hidden")
    for number in range(1, 5):
        tap(number)
    page.until("document.getElementById('say').textContent.startsWith('Found')")
    page.picture((Path(PICTURES) if PICTURES else tmp_path) / "screen_found.png")
    page.value("document.getElementById('keep').click(); 0")
    page.until("document.getElementById('say').textContent.startsWith('Kept')")
    kept = json.loads((tmp_path / "state/screen.json").read_text())
    found = np.array([kept["x_mm_from_pixels"], kept["y_mm_from_pixels"]])
    corners = np.array([[0, 0, 1], [2000, 0, 1], [0, 1400, 1], [2000, 1400, 1]])
    assert np.abs(corners @ (found - truth).T).max() < 0.1
    assert all("requestFullscreen" in said for said in page.said), "it was no gesture of a person"


def test_what_is_drawn_is_felt_and_saved_as_a_scene(page, bridge_with, board, tmp_path):
    bridge = bridge_with()
    page.leave()
    page.size(1280, 900)
    page.open(f"{bridge.address}live/editor.html")
    page.value("layers = []; HapticPanel.addEventListener('layer', ({detail}) => layers.push(detail)); 0")
    page.until("document.getElementById('effect').options.length > 5")
    left, top, width, height = page.value("(({x, y, width, height}) => [x, y, width, height])(plate.getBoundingClientRect())")

    def drag(*shares):
        for kind, (x, y) in zip(("mousePressed", *["mouseMoved"] * (len(shares) - 2), "mouseReleased"), shares, strict=True):
            place = {"x": left + x * width, "y": top + y * height}
            page.call("Input.dispatchMouseEvent", type=kind, button="left", buttons=1, clickCount=1, **place)

    drag((0.1, 0.1), (0.2, 0.2), (0.3, 0.5), (0.3, 0.5))
    drag((0.5, 0.5), (0.6, 0.9), (0.6, 0.9))
    page.value(
        "for (const [id, value] of [['effect', 'texture'], ['amplitude', '0.5'], ['name', 'so \"called\"']])"
        " { const one = document.getElementById(id); one.value = value; one.dispatchEvent(new Event('change')); } 0"
    )
    page.until("layers.length && layers.at(-1).answer.regions === 2 && layers.at(-1).regions[0].effects[0].effect === 'texture'")
    page.picture((Path(PICTURES) if PICTURES else tmp_path) / "editor.png")
    (tmp_path / "drawn.toml").write_text(page.value("document.getElementById('toml').textContent"))
    scene = load_scene(tmp_path / "drawn.toml", board)
    assert [region.name for region in scene.regions] == ['so "called"', "region 1"]
    newest, first = (np.array(region.shape.bounds) for region in scene.regions)
    plate = np.array([board.plate.length_m, board.plate.width_m, board.plate.length_m, board.plate.width_m])
    assert newest == pytest.approx([0.5, 0.1, 0.6, 0.5] * plate, abs=0.6e-3)
    assert first == pytest.approx([0.1, 0.5, 0.3, 0.9] * plate, abs=0.6e-3)
    assert scene.regions[0].spacings[0].amplitude == 0.5
    page.value("document.getElementById('delete').click(); 0")
    page.until("layers.at(-1).answer.regions === 1")
    page.value("document.getElementById('add').click(); 0")
    page.until("layers.at(-1).answer.regions === 2")
    page.call("Page.navigate", url="about:blank")  # else it tries to reach a bridge that has ended
    assert page.said == []


def test_an_operator_saves_what_is_drawn_on_the_panel_and_loads_it(page, bridge_with, served, board, tmp_path):
    bridge = bridge_with('[origins]\nself = ["operate"]')
    page.said.clear()
    page.size(1280, 900)
    page.dark("light")
    page.open(f"{bridge.address}live/editor.html")
    page.until("!document.getElementById('keeping').hidden && document.getElementById('keep').disabled")
    page.value("document.getElementById('add').click(); 0")

    def save(name):
        page.value(f"document.getElementById('scene-name').value = {json.dumps(name)}; document.getElementById('keep').click(); 0")

    save("../drawn")  # the field itself is against it
    assert page.value(
        "document.querySelector('#scene-name:invalid') !== null && document.getElementById('kept').textContent === ''"
    )
    save("keyboard")
    page.until("document.getElementById('kept').textContent.startsWith(\"Not saved: 'keyboard' is taken by the board's own\")")
    assert page.value("document.getElementById('load').hidden")
    save("drawn")
    page.until("document.getElementById('kept').textContent === 'Saved as drawn.'")
    kept = served.state / "scenes/simulated/drawn.toml"
    assert kept.read_text() == page.value("document.getElementById('toml').textContent")
    assert [region.name for region in load_scene(kept, board).regions] == ["region 1"]
    page.picture((Path(PICTURES) if PICTURES else tmp_path) / "editor_saved.png")
    page.value("document.getElementById('load').click(); 0")
    page.until("document.getElementById('kept').textContent.startsWith('drawn is in force')")
    page.value("HapticPanel.send({kind: 'describe'}).then(({scene, regions}) => now = [scene, regions[0].name])")
    assert page.value("now") == ["drawn", "region 1"]
    assert page.value("HapticPanel.send({kind: 'load_scene', name: 'scene'})")["outcome"] == "done"
    page.call("Page.navigate", url="about:blank")
    assert page.said == []


def test_the_live_page(page, bridge_with, asks, tmp_path):
    """Also that a stop by its button is one, and that arming asks."""
    bridge = bridge_with('[origins]\nself = ["operate"]')
    folder = Path(PICTURES) if PICTURES else tmp_path
    page.leave()
    page.size(1280, 900)
    page.dark("light")
    page.open(f"{bridge.address}live/")
    page.until("document.querySelectorAll('.region').length >= 4 && document.querySelectorAll('.finger').length === 4")
    page.until("document.body.dataset.state === 'on' && document.querySelectorAll('#figures dd').length")
    page.until("document.querySelectorAll('.focus').length")
    page.until("document.getElementById('log-lines').children.length")
    page.picture(folder / "live_page.png")
    page.value("[...document.querySelectorAll('#effects button')].find((one) => one.textContent === 'click').click(); 0")
    page.until("document.getElementById('outcome').textContent.startsWith('click: played')")
    page.value("document.getElementById('channel').value = 13; document.getElementById('chirp').click(); 0")
    page.until("document.getElementById('outcome').textContent.startsWith('channel 13: played')")
    page.until("document.querySelectorAll('#patch-13.tested').length")
    page.size(390, 844, 2, mobile=True)
    page.dark()
    assert page.value("document.documentElement.scrollWidth") == 390
    page.picture(folder / "live_page_phone.png")
    box = page.value(
        "(({x, y, width, height}) => [x + width / 2, y + height / 2])(document.getElementById('stop').getBoundingClientRect())"
    )
    page.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": box[0], "y": box[1]}])
    page.until("document.getElementById('state-word').textContent === 'disarmed'")  # before the finger is lifted
    page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    page.picture(folder / "live_page_stopped.png")
    page.value("document.getElementById('arm').click(); 0")
    page.picture(folder / "live_page_asks.png")
    assert page.value("document.getElementById('state-word').textContent") == "disarmed"
    page.value("document.getElementById('arm-yes').click(); 0")
    page.until("document.body.dataset.state === 'on'")
    for button in page.value(
        "[...document.querySelectorAll('button, input, a')].map((one) => one.textContent || one.labels?.[0]?.textContent || '')"
    ):
        assert button.strip()
    bridge.end()
    page.until("document.getElementById('state-word').textContent === 'no panel'")
    page.picture(folder / "live_page_no_panel.png")
    assert all("ERR_CONNECTION_REFUSED" in said or "WebSocket" in said for said in page.said), page.said


@pytest.fixture
def framed(page, bridge_with, tmp_path):
    """A page of four frames of its own origin."""
    (tmp_path / "www").mkdir()
    for name in ("elements.css", "elements.js", "frames.html", "frames.css", "framed.html", "framed.css", "framed.js"):
        shutil.copy(FOLDER / name, tmp_path / "www")
    bridge = bridge_with("messages_per_s = 1000\nburst = 1000", www=tmp_path / "www")
    page.leave()
    page.size(1000, 700)
    page.open(f"{bridge.address}frames.html")
    settled(page)
    yield page, bridge
    page.leave()


@pytest.mark.parametrize(
    "change",
    [
        "0",
        "document.getElementById('box').scrollTop = 120",
        "document.getElementById('plain').contentWindow.scrollTo(0, 90)",
        "document.getElementById('turned').contentDocument.querySelector('.turned').style.rotate = '60deg'",
        "document.getElementById('cover').style.left = '200px'",
    ],
)
def test_elements_in_frames_are_felt_where_they_are_seen(framed, change):
    page, _ = framed
    page.value(f"{change}; 0")
    page.value("new Promise((done) => setTimeout(done, 700))")
    right(page)
    names = page.value("layers.at(-1).regions.filter((one) => one.effects.length).map((one) => one.name)")
    assert {"plain", "turned", "scrolled"} <= {one.partition("-")[0] for one in names}
    assert not [one for one in names if one.startswith(("transparent-", "plain-3 "))], names


def test_a_frame_has_its_pages_connection_and_its_own_coordinates(framed):
    page, _ = framed
    inner = "document.getElementById('turned').contentWindow"
    assert page.value(f"{inner}.told.includes('open') && {inner}.told.includes('layer')")
    assert page.value(f"{inner}.HapticPanel.plate.board") == "simulated"
    middle = page.value(f"{inner}.HapticPanel.toPlate(124, 94)")
    assert middle == pytest.approx([0.63 * 210, (1 - 160 / 700) * 148], abs=0.05)
    assert page.value(f"{inner}.HapticPanel.play('click', {{x: 20, y: 20}})")["outcome"] == "played"
    assert page.value(f"{inner}.HapticPanel.play('tick', {inner}.document.querySelector('button'))")["outcome"] == "played"
    clients = page.value("HapticPanel.send({kind: 'describe'})")["clients"]
    assert clients["connected"] == 2, "the page's, and one for stops: the four frames have none of their own"
    page.value("document.getElementById('turned').remove(); 0")
    page.value("new Promise((done) => setTimeout(done, 700))")
    names = page.value("layers.at(-1).regions.map((one) => one.name)")
    assert not [one for one in names if one.startswith("turned-")]


def test_a_frame_of_another_origin_is_not_felt(page, bridge_with, tmp_path):
    """What it covers of the page around is not, either."""
    for folder, files in {
        "other": ("framed.html", "framed.css", "framed.js"),
        "www": ("elements.css", "elements.js", "frames.css"),
    }.items():
        (tmp_path / folder).mkdir()
        for name in files:
            shutil.copy(FOLDER / name, tmp_path / folder)
    other = bridge_with('content_security_policy = "frame-ancestors *"', www=tmp_path / "other")
    (tmp_path / "www" / "index.html").write_text(
        (FOLDER / "frames.html").read_text().partition("<iframe")[0]
        + '<button id="below" data-haptic="click" data-expected="felt">below</button>'
        + f'<iframe id="plain" src="{other.address}framed.html?plain">'
    )
    (tmp_path / "www" / "frames.css").write_text(
        (FOLDER / "frames.css").read_text() + "#below { left: 100px; top: 100px; width: 200px; height: 80px; }"
    )
    page.leave()
    page.size(1000, 700)
    page.call("Page.addScriptToEvaluateOnNewDocument", source="heard = []; onmessage = ({data}) => heard.push(data)")
    page.open(bridge_with("messages_per_s = 1000\nburst = 1000\ncontent_security_policy = ''", www=tmp_path / "www").address)
    settled(page)
    page.until("heard.some(({type}) => type === 'layer')")
    assert {(one["regions"], one["outcome"]) for one in page.value("heard.filter(({type}) => type === 'layer')")} == {
        (0, "the page's place on the plate is unknown")
    }
    right(page)
    regions = page.value("layers.at(-1).regions.map((one) => [one.name.replace(/ \\d+$/, ''), one.effects.length])")
    assert regions == [["plain", 0], ["below", 1], ["beside", 1]]


def test_a_page_in_a_window_plays_nothing_and_in_full_screen_all_of_it(page, bridge_with, tmp_path):
    """A window may lie anywhere on the screen."""
    (tmp_path / "www").mkdir()
    shutil.copy(FOLDER / "elements.js", tmp_path / "www")
    (tmp_path / "www" / "index.html").write_text(
        '<!doctype html><link rel="icon" href="elements.js"><script defer src="/haptic.js"></script>'
        '<script defer src="elements.js"></script><script defer src="button.js"></script><button id="whole" data-haptic="click">all'
    )
    (tmp_path / "www" / "button.js").write_text(
        "document.getElementById('whole').onclick = () => document.fullscreenElement ? document.exitFullscreen()"
        " : document.documentElement.requestFullscreen();"
    )
    page.leave()
    page.call("Emulation.clearDeviceMetricsOverride")
    page.open(bridge_with(www=tmp_path / "www").address)
    page.until("layers.length")
    left, top = page.value("(({x, y, width, height}) => [x + width / 2, y + height / 2])(whole.getBoundingClientRect())")

    def click():
        for kind in ("mousePressed", "mouseReleased"):
            page.call("Input.dispatchMouseEvent", type=kind, button="left", clickCount=1, x=left, y=top)

    def is_off():
        assert page.value("layers.at(-1).regions") == []
        assert page.value("HapticPanel.toPlate(0, 0)") is None
        assert "unknown" in page.value("HapticPanel.play('click', whole)")["reason"]

    is_off()
    click()
    page.until("document.fullscreenElement && layers.at(-1).regions.length === 1")
    assert page.value("HapticPanel.toPlate(0, 0)") == pytest.approx([0, 148])
    assert page.value("HapticPanel.toPlate(innerWidth, innerHeight)") == pytest.approx([210, 0])
    assert page.value("HapticPanel.play('click', whole)")["outcome"] == "played"
    click()
    page.until("!document.fullscreenElement && layers.at(-1).regions.length === 0")
    is_off()
    assert page.said == []


def test_what_is_scrolled_is_off_until_it_rests_but_for_what_pans(elements):
    elements.value("document.getElementById('row3').setAttribute('scroll', 'pan'); 0")
    settled(elements)
    during = elements.value(
        """new Promise((done) => {
          const list = document.getElementById("list"), before = layers.length;
          let steps = 0;
          (function scroll() {
            list.scrollTop += steps++ % 40 < 20 ? 3 : -3;
            if (steps < 80) requestAnimationFrame(scroll);
            else done(layers.slice(before + 1).map(({ regions }) => regions.map((one) => one.name)));
          })();
        })"""
    )
    felt = [{one.rpartition(" ")[0] for one in names} for names in during]
    assert len(felt) >= 3
    assert all("plain" in names and not names & {"row1", "row2", "row4"} for names in felt), felt
    assert any("row3" in names for names in felt)
    right(elements)


def test_a_bridge_that_is_killed_and_comes_back_has_the_layer_again_once(page, served, bridge_at, tmp_path):
    (tmp_path / "www").mkdir()
    for name in ("elements.css", "elements.js"):
        shutil.copy(FOLDER / name, tmp_path / "www")
    shutil.copy(FOLDER / "elements.html", tmp_path / "www" / "index.html")
    bridge = bridge_at(tmp_path / "www", port=0)
    page.leave()
    page.size(1000, 700)
    page.open(bridge.address)
    settled(page)
    page.value("events = []; for (const type of ['open', 'close']) HapticPanel.addEventListener(type, () => events.push(type)); 0")
    before = page.value("layers.at(-1).regions")
    with PanelClient(served.socket, timeout_s=60) as client:
        wait_for("the page, its stops and this client", lambda: client.describe().clients.connected == 3)
        for times in (1, 2):
            bridge.process.kill()
            bridge.process.wait()
            page.until("events.at(-1) === 'close'")
            assert page.value("HapticPanel.send({kind: 'state'})")["reason"] == "no panel"
            wait_for("the layer's end", lambda: client.describe().clients.connected == 1)
            page.value("layers.length = 0; 0")
            bridge = bridge_at(tmp_path / "www", port=bridge.port)
            page.until("layers.length && layers.at(-1).answer.kind === 'layer'")
            assert page.value("layers.at(-1).regions") == before
            wait_for("both connections", lambda: client.describe().clients.connected == 3)
            tried = page.value("events")  # the bridge may not have been there yet when the page tried again
            assert [kind for kind, _ in itertools.groupby(tried)] == ["close", "open"] * times
    right(page)
    page.leave()

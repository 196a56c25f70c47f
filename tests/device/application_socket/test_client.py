"""The Python client and its command line, against the panel's own end of the socket."""

import grp
import json
import os
import socket
import threading
from collections import deque

import pytest

from controller.device.application_socket.client import PanelClient, Transform
from controller.device.application_socket.client.command_line import main
from controller.device.board.panel_state import Condition, PanelState
from controller.device.loop.commands import Outcome
from controller.device.loop.preparation import AcceptedLayer, LayerResult
from controller.device.scene.layers import Placement, RefusedRegion
from controller.device.touch.source import TouchSample
from controller.errors import ControllerError, LinkError


@pytest.fixture
def served(panel):
    """A panel whose loop turns in a thread: every command is played, a scene is taken over unless it is called `absent`."""
    ended = threading.Event()
    panel.conditions = deque()

    def loop():
        while not ended.is_set():
            panel.socket.serve(panel.now_s, panel.control)
            while panel.control.plays:
                panel.socket.outcome(panel.control.plays.pop(0)[0], Outcome.PLAYED, 1.5e-3)
            while panel.control.scenes:
                ticket, name = panel.control.scenes.pop(0)
                panel.socket.loaded(ticket, "absent.toml: no such scene" if name == "absent" else "")
            while len(panel.control.layers) > panel.answered:
                ticket, _, line, _ = panel.control.layers[panel.answered]
                panel.answered += 1
                layer = AcceptedLayer((), None, 0, (RefusedRegion(0, "a", "no"),), 1)
                panel.socket.layered(
                    ticket, LayerResult(1e-3, reason="no such thing") if b"broken" in line else LayerResult(1e-3, layer)
                )
            while panel.conditions:
                panel.socket.changed(panel.conditions.popleft())
            if not any(client.open and client.unsent for client in panel.socket._clients.places):  # on a busy machine it reads late
                panel.socket.touches([TouchSample(7, 0.1, 0.07, panel.now_s, True, 8e-3)])
            panel.now_s += 1e-3

    thread = threading.Thread(target=loop)
    thread.start()
    yield panel
    ended.set()
    thread.join()


def test_a_command_is_played_and_says_what_became_of_it(served):
    with PanelClient(served.settings.path) as client:
        answer = client.play("click", at_mm=(100, 70), amplitude=0.5)
        assert (answer.outcome, answer.age_ms) == ("played", 1.5)
        assert client.play("click", finger=7).outcome == "played"
        refused = client.play("click", at_mm=(300, 70))
        assert (refused.outcome, refused.reason) == ("refused", "x_mm = 300 is off the plate (0 to 210)")


def test_several_commands_may_be_under_way_and_are_waited_for_in_any_order(served):
    with PanelClient(served.settings.path) as client:
        numbers = [client.start_play("click", at_mm=(10 * number, 70)) for number in range(1, 10)]
        assert [client.wait(number).id for number in reversed(numbers)] == list(reversed(numbers))


def test_touches_are_iterated_with_commands_in_between_and_no_more_come_after(served):
    with PanelClient(served.settings.path) as client:
        touches = client.touches()
        for touch in (next(touches), next(touches)):
            assert (touch.finger, touch.x_mm, touch.y_mm, touch.contact, touch.size_mm) == (7, 100.0, 70.0, True, 8.0)
            assert client.play("click", finger=touch.finger).outcome == "played"
        touches.close()
        assert client.hello().board == "simulated"
        assert served.socket._clients.touch_subscribers == 0


def test_regions_are_replaced_and_moved_and_what_was_refused_is_said(served):
    with PanelClient(served.settings.path) as client:
        with pytest.raises(ControllerError, match="the panel refused: there is nothing to move"):
            client.move_regions(x_mm=1)
        answer = client.put_regions([{"name": "a"}], effects={"e": {"when": "press"}}, transform=Transform(scale=2.0))
        assert (answer.regions, answer.refused[0].reason) == (0, "no")
        client.move_regions(x_mm=5, y_mm=-2.5)
        assert [placement for _, placement in served.control.moves] == [Placement(5e-3, -2.5e-3, 1.0)]
        _, _, line, placement = served.control.layers[0]
        assert (json.loads(line)["effects"], placement) == ({"e": {"when": "press"}}, Placement(0.0, 0.0, 2.0))
        with pytest.raises(ControllerError, match="the panel refused: no such thing"):
            client.put_regions([{"name": "broken"}])


def test_the_regions_of_a_scene_file_are_laid_from_the_shell(served, tmp_path, capsys):
    file = tmp_path / "layer.toml"
    file.write_text('[[regions]]\nname = "a"\nshape = "plate"\neffects = ["click"]\n')
    shown = ["--socket", served.settings.path, "regions", str(file), "--once"]
    assert main(shown) == 0
    assert json.loads(capsys.readouterr().out)["kind"] == "layer"
    assert json.loads(served.control.layers[0][2])["regions"] == [{"name": "a", "shape": "plate", "effects": ["click"]}]
    assert main([*shown[:-2], str(tmp_path / "none.toml")]) == 78
    assert "none.toml: cannot be read" in capsys.readouterr().err


def test_scenes_figures_and_who_is_there(served):
    with PanelClient(served.settings.path) as client:
        client.load_scene("drums")
        with pytest.raises(ControllerError, match=r"the panel refused: absent.toml: no such scene"):
            client.load_scene("absent")
        client.save_scene("mine", "text")
        assert served.control.saved == [("mine", "text")]
        assert client.figures()["emissions"] == 7
        assert client.hello().effects == ("click", "buzz")


def test_a_scene_is_saved_from_the_shell(served, tmp_path, capsys):
    file = tmp_path / "scene.toml"
    file.write_text("# mine\n")
    asked = ["--socket", served.settings.path, "save", "mine"]
    assert main([*asked, str(file)]) == 0
    assert served.control.saved == [("mine", "# mine\n")]
    file.write_bytes(b"\xff")
    assert main([*asked, str(file)]) == main([*asked, str(tmp_path / "none.toml")]) == 78
    unread, absent = capsys.readouterr().err.splitlines()[-2:]
    assert unread.startswith(f"haptic-panel: {file}: line 1 is not UTF-8")
    assert absent.endswith("none.toml: cannot be read (No such file or directory)")


def test_without_a_service_it_says_so(folder):
    with pytest.raises(LinkError, match=r"nobody.sock: no panel to talk to \(No such file or directory\)"):
        PanelClient(str(folder / "nobody.sock"))


def test_a_panel_that_says_nothing_is_not_waited_for_without_end(folder):
    with socket.socket(socket.AF_UNIX) as silent:
        silent.bind(str(folder / "silent.sock"))
        silent.listen()
        client = PanelClient(str(folder / "silent.sock"), timeout_s=0.05)
        with client, pytest.raises(LinkError, match=r"does not answer within 0\.05 s"):
            client.hello()


@pytest.mark.parametrize(
    ("said", "words"),
    [
        (b'{"kind":"farewell","reason":"the service ends"}\n', "has ended the connection: the service ends"),
        (b"", "has ended the connection"),
        (b"HTTP/1.1 400 Bad Request\r\n", "the answer is not that of a panel of this version"),
        (b'{"kind":"hello","id":1,"version":"9"}\n', "the answer is not that of a panel of this version"),
    ],
)
def test_an_end_and_a_stranger_are_distinguished(folder, said, words):
    with socket.socket(socket.AF_UNIX) as other:
        other.bind(str(folder / "other.sock"))
        other.listen()
        with PanelClient(str(folder / "other.sock")) as client:
            accepted, _ = other.accept()
            accepted.sendall(said)
            accepted.shutdown(socket.SHUT_WR)
            with pytest.raises(LinkError, match=words):
                client.hello()
            accepted.close()


@pytest.mark.parametrize(
    ("arguments", "shown"),
    [
        (["play", "click", "--at", "100", "70"], {"kind": "answer", "id": 1, "outcome": "played", "age_ms": 1.5}),
        (["play", "buzz", "--finger", "7", "--amplitude", "0.5"], {"kind": "answer", "id": 1, "outcome": "played", "age_ms": 1.5}),
        (["figures"], {"emissions": 7}),
        (["hello"], {"board": "simulated", "length_mm": 210.0}),
    ],
)
def test_the_command_line_prints_what_the_panel_says(served, capsys, arguments, shown):
    assert main(["--socket", served.settings.path, *arguments]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert shown.items() <= printed.items()


def test_the_command_line_fails_in_one_line(served, folder, capsys):
    assert main(["--socket", served.settings.path, "load", "drums"]) == 0
    capsys.readouterr()
    assert main(["--socket", served.settings.path, "load", "absent"]) == 1
    *_, last = capsys.readouterr().err.splitlines()  # behind what the panel, in this process too, has to say
    assert last == "haptic-panel: the panel refused: absent.toml: no such scene"
    assert main(["--socket", served.settings.path, "play", "click", "--at", "-1", "70"]) == 1
    assert json.loads(capsys.readouterr().out)["outcome"] == "refused"
    assert main(["--socket", str(folder / "nobody.sock"), "hello"]) == 69
    assert capsys.readouterr().err.count("\n") == 1


def test_the_panel_is_armed_and_disarmed_and_says_how_it_is(served, capsys):
    path = served.settings.path
    with PanelClient(path) as client:
        assert client.hello().rights == ("play", "regions", "operate")
        states = client.states()
        assert next(states).state == "waiting for FPGA"
        client.disarm()
        served.conditions.append(
            Condition(PanelState.DISARMED, "switched off by user 'anna' (uid 1002, pid 358)", temperature_c=23.5)
        )
        state = next(states)
        assert (state.state, state.temperature_c, client.state().state) == ("disarmed", 23.5, "disarmed")
        assert (state.id, state.outputs_on, state.panel_present) == (None, False, True)
        states.close()
        client.arm()
    assert main(["--socket", path, "disarm"]) == main(["--socket", path, "arm"]) == 0
    assert served.control.switched == [False, True, False, True]
    capsys.readouterr()
    assert main(["--socket", path, "state"]) == 0
    assert json.loads(capsys.readouterr().out)["state"] == "disarmed"


def test_one_without_the_right_is_informed_which_one_and_who_gives_it(panel_with, folder, another):
    """A file of another user's group, and a socket that everybody may connect to."""
    if os.geteuid() != 0:
        pytest.skip("takes root: processes of other users are made")
    group = next(group for group in grp.getgrall() if group.gr_gid)
    panel = panel_with(group=group.gr_name, mode="660")
    folder.chmod(0o755)

    def connects(says, hears):
        try:
            PanelClient(panel.settings.path)
        except ControllerError as error:
            says.write(f"{error.exit_code} {error}".encode())

    with another(connects, uid=65534) as (_, hears):
        said = hears.read().decode()
    assert said.startswith(f"1 {panel.settings.path}: user ")
    assert f"group {group.gr_name!r} may: have root do `adduser " in said
    assert "running" not in said

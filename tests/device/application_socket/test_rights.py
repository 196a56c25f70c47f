"""Who may do what: rights by group, shares by user, and nobody who keeps another one out."""

import grp
import json
import os
import re
import select
from collections import Counter
from pathlib import Path

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

from controller.device.application_socket.client import PanelClient
from controller.device.application_socket.connections.peers import Peer, Rights
from controller.device.application_socket.protocol.client_messages import BY_CHARACTERS, LAST_CHANNEL
from controller.device.application_socket.requests.pending_commands import WAITING_PER_CLIENT
from controller.device.application_socket.switched_off import SwitchedOff
from controller.device.board.panel import CHANNELS, FPGAS_MAX
from controller.device.board.panel_state import Condition, PanelState
from controller.device.loop.commands import Outcome
from controller.device.loop.playing.due_emissions import MAX_WAITING_COMMANDS
from controller.errors import ControllerError

PLAY_GROUP, OPERATE_GROUP = [group for group in grp.getgrall() if group.gr_gid not in (0, os.getegid(), 65534)][:2]
GROUPS = {"play_group": PLAY_GROUP.gr_name, "operate_group": OPERATE_GROUP.gr_name}
KIOSK = Peer(50_001, 11, frozenset({50_001, PLAY_GROUP.gr_gid}))
GUEST = Peer(50_002, 12, frozenset({50_002, PLAY_GROUP.gr_gid}))
OPERATOR = Peer(50_003, 13, frozenset({50_003, OPERATE_GROUP.gr_gid}))
STRANGER = Peer(50_004, 14, frozenset({50_004}))
PLAY = {"kind": "play", "effect": "click", "x_mm": 100, "y_mm": 70}
TEST = {"kind": "test_channel", "channel": 5}
SAVE = {"kind": "save_scene", "name": "mine", "toml": ""}
OPERATIONS = ({"kind": "arm"}, {"kind": "disarm"}, {"kind": "load_scene", "name": "drums"}, {"kind": "trace"}, TEST, SAVE)


@pytest.fixture
def panel(panel_with):
    return panel_with(**GROUPS)


@pytest.mark.parametrize("request_", OPERATIONS)
def test_one_who_may_only_play_is_informed_which_right_that_takes_and_which_group_gives_it(panel, request_):
    client = panel.connect(KIOSK)
    (answer,) = panel.ask(client, {**request_, "id": 1})
    assert answer["outcome"] == "refused"
    assert answer["reason"] == f"uid 50001 (pid 11) does not have the right to operate: group {OPERATE_GROUP.gr_name!r} gives it"
    assert panel.control.switched == panel.control.scenes == []
    assert panel.socket.counters.not_allowed == 1
    panel.ask(client, PLAY)
    assert len(panel.control.plays) == 1


def test_an_operator_arms_disarms_and_loads_and_the_journal_says_who(panel, capsys):
    client = panel.connect(OPERATOR)
    answers = panel.ask(
        client, *({**request, "id": number} for number, request in enumerate(OPERATIONS)), {"kind": "hello", "id": 9}
    )
    assert [(answer["id"], answer.get("outcome", answer["kind"])) for answer in answers] == [
        (0, "done"),
        (1, "done"),
        (3, "done"),
        (9, "hello"),
    ]
    assert panel.control.traces == ["uid 50003 (pid 13) asked for it"]
    assert answers[-1]["rights"] == ["play", "regions", "operate"]
    assert panel.control.switched == [True, False]
    assert [name for _, name in panel.control.scenes] == ["drums", "mine"]
    assert panel.control.saved == [("mine", "")]
    assert capsys.readouterr().err.splitlines() == [
        "haptic-panel: uid 50003 (pid 13) arms the panel",
        "haptic-panel: uid 50003 (pid 13) disarms the panel",
        "haptic-panel: uid 50003 (pid 13) loads the scene 'drums'",
        "haptic-panel: uid 50003 (pid 13) saves the scene 'mine'",
    ]


def test_a_channel_is_tested_at_the_place_of_its_patch_and_answered_as_a_play(panel, board):
    assert LAST_CHANNEL == CHANNELS * FPGAS_MAX - 1
    client = panel.connect(OPERATOR)
    assert panel.ask(client, {**TEST, "id": 1}) == []
    patch = next(actuator for actuator in board.actuators if actuator.channel == 5)
    ((ticket, channel, x_m, y_m),) = panel.control.tests
    assert (channel, x_m, y_m) == (5, pytest.approx(patch.x_mm * 1e-3), pytest.approx(patch.y_mm * 1e-3))
    panel.socket.outcome(ticket, Outcome.PLAYED, 2e-3)
    assert panel.ask(client) == [{"kind": "answer", "id": 1, "outcome": "played", "age_ms": 2.0}]
    for wrong in (-1, 128, 5.5, "5", None):
        (answer,) = panel.ask(client, {**TEST, "channel": wrong, "id": 2})
        assert (answer["outcome"], answer["reason"][:10]) == ("refused", "channel = ")


def test_one_who_may_do_nothing_is_informed_and_takes_no_place(panel):
    for _ in range(20):
        stranger = panel.connect(STRANGER)
        panel.settle()
        assert json.loads(stranger.recv(1000)) == {
            "kind": "farewell",
            "lacks": "play",
            "reason": f"uid 50004 (pid 14) does not have the right to play: group {PLAY_GROUP.gr_name!r} gives it",
        }
        assert stranger.recv(1) == b""
    assert (panel.socket.counters.without_right, panel.socket.counters.clients_accepted) == (20, 0)


def test_that_it_was_disarmed_is_known_to_the_next_service_until_somebody_arms(panel, board, changed):
    client = panel.connect(OPERATOR)
    assert panel.socket.disarmed_by == ""
    panel.ask(client, {"kind": "disarm"}, {"kind": "disarm"})
    panel.ask(panel.connect(KIOSK), {"kind": "stop"})
    panel.socket.close()
    again = type(panel)(board, panel.settings)
    assert again.socket.disarmed_by == "uid 50003 (pid 13)", "the first who did"
    assert again.ask(again.connect(OPERATOR), {"kind": "arm", "id": 1})[0]["outcome"] == "done"
    assert again.socket.disarmed_by == ""
    again.close()


@pytest.mark.parametrize("content", [b"", b"\xff", b"x" * 5000, None])
def test_a_file_that_says_nothing_readable_is_somebody_who_has_switched_it_off(panel, content):
    file = Path(f"{panel.settings.path}.disarmed")
    file.mkdir() if content is None else file.write_bytes(content)
    assert SwitchedOff(panel.settings.path).by == "a client"


def test_who_switched_the_panel_off_is_one_line_of_text_whatever_the_file_says_and_no_link_is_followed(panel, tmp_path):
    file = Path(f"{panel.settings.path}.disarmed")
    file.write_text("anna\nhaptic-panel: the outputs are on\x1b[2J" + 300 * "x")
    assert re.fullmatch(r"[ -~]{200}", SwitchedOff(panel.settings.path).by)
    file.unlink()
    (tmp_path / "precious").write_text("precious")
    file.symlink_to(tmp_path / "precious")
    assert SwitchedOff(panel.settings.path).by == "a client"
    SwitchedOff("/nowhere").remember("anna")
    kept = SwitchedOff(panel.settings.path)
    kept.remember("")
    file.symlink_to(tmp_path / "precious")
    assert kept.remember("anna")
    assert (tmp_path / "precious").read_text() == "precious"
    assert kept.by == "anna", "though only until a restart"


def test_a_client_that_stops_again_and_again_is_slowed_down_and_touches_file_and_journal_once(panel, capsys):
    client = panel.connect(KIOSK)
    panel.ask(client, {"kind": "stop"})
    file = Path(f"{panel.settings.path}.disarmed")
    before = file.stat().st_mtime_ns
    began_s = panel.now_s
    answers = panel.ask(client, *[{"kind": "stop", "id": number} for number in range(400)])
    assert [answer["outcome"] for answer in answers] == ["done"] * 400
    assert capsys.readouterr().err.count("stops the panel") == 1
    assert file.stat().st_mtime_ns == before
    assert panel.now_s > began_s, "it was not read for a while"
    assert panel.socket.counters.over_rate == 0


def test_every_client_may_stop_whatever_its_rights_and_its_rate_and_only_an_operator_may_arm(panel_with):
    panel = panel_with(play_group=PLAY_GROUP.gr_name, look_group=OPERATE_GROUP.gr_name)
    for peer in (KIOSK, OPERATOR):  # who may only play, and who may only look
        client = panel.connect(peer)
        panel.ask(client, *[{"kind": "hello"}] * 200)  # over its rate
        (answer,) = panel.ask(client, {"kind": "stop", "id": 1})
        assert answer == {"kind": "answer", "id": 1, "outcome": "done"}
        assert panel.control.switched.pop() is False
        assert panel.control.switched_by == f"uid {peer.uid} (pid {peer.pid})"
        (answer,) = panel.ask(client, {"kind": "arm"})
        assert answer["outcome"] == "refused"
        assert not panel.control.switched


def test_for_whom_a_client_stops_stands_behind_its_user(panel, capsys):
    client = panel.connect(KIOSK)
    panel.ask(client, {"kind": "stop", "by": "a page of 'http://kiosk' at 127.0.0.1"})
    who = f"uid {KIOSK.uid} (pid {KIOSK.pid}) for a page of 'http://kiosk' at 127.0.0.1"
    assert panel.control.switched_by == panel.socket.disarmed_by == who
    assert f"{who} stops the panel" in capsys.readouterr().err
    for by in ("a\nb", "\x1b[2J", "ü", "x" * (BY_CHARACTERS + 1), 7, None):
        (answer,) = panel.ask(client, {"kind": "stop", "by": by, "id": 1})
        assert answer["reason"].startswith("by = ")


def test_without_groups_whoever_may_connect_plays_and_only_the_services_own_user_and_root_operate(panel_with):
    panel = panel_with()
    for peer, rights in (
        (STRANGER, ["play"]),
        (Peer(0, 1, frozenset()), ["play", "regions", "operate"]),
        (None, ["play", "regions", "operate"]),
    ):
        (hello,) = panel.ask(panel.connect(peer), {"kind": "hello"})
        assert hello["rights"] == rights
    (answer,) = panel.ask(panel.connect(STRANGER), {"kind": "disarm"})
    assert "names no operate_group" in answer["reason"]


@pytest.mark.parametrize("key", ["play_group", "operate_group"])
def test_a_group_that_does_not_exist_is_refused_by_name(settings, changed, key):
    with pytest.raises(ControllerError, match=rf"application_socket.{key} = 'nobody-like-this': no such group"):
        Rights(changed(settings, **{key: "nobody-like-this"}))


# Places


def is_served(panel, client):
    answers = panel.ask(client, {"kind": "hello"})
    return [answer["kind"] for answer in answers] == ["hello"]


def test_silent_clients_of_one_user_do_not_keep_out_another(panel):
    hogs = [panel.connect(GUEST) for _ in range(8)]
    panel.settle()
    assert panel.socket.counters.turned_away == 8 - panel.settings.clients_per_user
    assert json.loads(hogs[-1].recv(1000))["reason"] == "5 clients of uid 50002 (pid 12) are connected already"
    assert is_served(panel, panel.connect(KIOSK))


def test_silent_clients_of_many_users_give_way_when_they_were_silent_for_long_the_longest_first(panel):
    silent = [panel.connect(Peer(60_000 + number, 1, KIOSK.groups)) for number in range(panel.settings.max_clients)]
    panel.settle()
    panel.now_s += 1.0
    assert is_served(panel, silent[0])
    panel.now_s += panel.settings.idle_s - 0.5
    assert is_served(panel, panel.connect(KIOSK))
    assert json.loads(silent[1].recv(1000)) == {
        "kind": "farewell",
        "reason": "its place was needed, and it had been silent for longest",
    }
    assert is_served(panel, silent[0])
    assert panel.socket.counters.gave_way == 1


def test_one_that_waits_for_something_is_not_silent(panel):
    others = [panel.connect(Peer(60_000 + number, 1, KIOSK.groups)) for number in range(panel.settings.max_clients)]
    for number, client in enumerate(others):
        panel.ask(client, ({"kind": "subscribe"}, {"kind": "subscribe", "to": ["state"]}, PLAY)[number % 3])
    panel.now_s += 1000.0
    late = panel.connect(KIOSK)
    panel.settle()
    assert json.loads(late.recv(1000))["reason"] == "9 clients are connected already"


def test_an_operator_always_finds_a_place(panel):
    others = [panel.connect(Peer(60_000 + number, 1, KIOSK.groups)) for number in range(panel.settings.max_clients)]
    for client in others:
        panel.ask(client, {"kind": "subscribe"})
    operator = panel.connect(OPERATOR)
    assert panel.ask(operator, {"kind": "disarm", "id": 1}) == [{"kind": "answer", "id": 1, "outcome": "done"}]
    assert panel.socket.counters.gave_way == 1
    assert panel.socket._clients.touch_subscribers == panel.settings.max_clients - 1


def test_when_one_gives_way_while_it_speaks_nothing_is_mixed_up(panel):
    """In one turn of the loop: those who have to go say something or hang up, and operators knock."""
    others = [panel.connect(Peer(60_000 + number, 1, KIOSK.groups)) for number in range(panel.settings.max_clients)]
    panel.settle()
    for number, client in enumerate(others):
        client.close() if number % 2 else client.sendall(b'{"kind": "hello"}\n')
    operators = [panel.connect(OPERATOR) for _ in range(panel.settings.max_clients)]
    panel.settle()
    assert all(is_served(panel, operator) for operator in operators)


# The queue


def test_commands_of_one_user_do_not_push_out_those_of_another(panel_with):
    panel = panel_with(**GROUPS, commands_per_s=10_000, burst=1000)
    hog, kiosk = [panel.connect(GUEST), panel.connect(GUEST)], panel.connect(KIOSK)
    panel.settle()
    reported = [answer for client in hog for answer in panel.ask(client, *({**PLAY, "id": number} for number in range(50)))]
    assert len(panel.control.plays) == MAX_WAITING_COMMANDS // 2
    assert Counter(answer["outcome"] for answer in reported) == {"refused": 100 - MAX_WAITING_COMMANDS // 2}
    assert panel.ask(kiosk, *({**PLAY, "id": number} for number in range(MAX_WAITING_COMMANDS // 2))) == []
    for ticket, *_ in panel.control.plays:
        panel.socket.outcome(ticket, Outcome.PLAYED, 0.0)
    panel.ask(hog[0], PLAY)
    assert panel.socket.waiting == 1
    for client in hog:
        panel.ask(client, *[PLAY] * 50)
    assert panel.socket.waiting == MAX_WAITING_COMMANDS // 2, "each that was answered is given back once"


def test_a_share_is_not_had_anew_by_connecting_again(panel_with):
    panel = panel_with(**GROUPS, burst=1000)
    panel.connect(KIOSK)
    for _ in range(5):
        hog = panel.connect(GUEST)
        panel.ask(hog, *[PLAY] * 20)
        hog.close()
        panel.settle()
    assert len(panel.control.plays) == MAX_WAITING_COMMANDS // 2


def test_a_user_alone_has_all_of_it(panel_with):
    panel = panel_with(**GROUPS, burst=1000)
    panel.ask(panel.connect(GUEST), *[PLAY] * WAITING_PER_CLIENT)
    assert len(panel.control.plays) == WAITING_PER_CLIENT


# How the panel is


def test_the_state_comes_at_once_and_with_every_change_until_unsubscribed(panel):
    client, other = panel.connect(KIOSK), panel.connect(GUEST)
    panel.socket.changed(Condition(PanelState.NO_PERMIT, "the run permit is not given", temperature_c=None))
    first = {
        "kind": "state",
        "id": None,
        "state": "no permit",
        "cause": "the run permit is not given",
        "outputs_on": False,
        "panel_present": True,
        "temperature_c": None,
    }
    assert panel.ask(client, {"kind": "subscribe", "id": 1, "to": ["state", "touches"]}) == [
        {"kind": "answer", "id": 1, "outcome": "done"},
        first,
    ]
    assert panel.ask(other, {"kind": "state", "id": 7}) == [first | {"id": 7}]
    panel.socket.changed(Condition(PanelState.ARMED, "", outputs_on=True, temperature_c=31.25))
    armed = {"state": "armed", "cause": "", "outputs_on": True, "temperature_c": 31.25}
    assert panel.ask(client) == [first | armed]
    panel.ask(client, {"kind": "unsubscribe"})
    panel.socket.changed(Condition(PanelState.FAULTED, "too hot"))
    assert panel.ask(client) == panel.ask(other) == []


# With the kernel's own credentials


def test_the_kernel_says_who_it_is(panel_with, folder, another):
    """As root with processes of other users; else with our own, who is the service's."""
    panel = panel_with(**GROUPS, mode="666")
    folder.chmod(0o755)
    many = [70_000 + number for number in range(300)]  # more groups than are asked for at first
    cases = [(None, [], "done")] if os.geteuid() else [
        (65534, [], "play"),
        (65534, [PLAY_GROUP.gr_gid], "operate"),
        (65534, [*many, PLAY_GROUP.gr_gid], "operate"),
        (65534, [*many, OPERATE_GROUP.gr_gid], "done"),
        (OPERATE_GROUP.gr_gid, [], "done"),
    ]  # fmt: skip
    for uid, groups, said in cases:

        def disarms(says, hears):
            try:
                with PanelClient(panel.settings.path) as client:
                    client.disarm()
            except ControllerError as error:
                says.write(str(error).encode())
            else:
                says.write(b"done")

        with another(disarms, uid=uid, groups=groups) as (_, hears):
            while not select.select([hears], [], [], 0.01)[0]:
                panel.socket.serve(panel.now_s, panel.control)
                panel.now_s += 0.01
            answer = hears.read().decode()
        assert answer == said or f"does not have the right to {said}: group " in answer
        if uid is not None and said != "done":
            assert f"uid {uid}, pid" in answer or f"uid {uid} (pid" in answer
    assert panel.control.switched == [False] * sum(said == "done" for *_, said in cases)


class Clients(RuleBasedStateMachine):
    """Whatever users with and without rights do: only operators operate, and each line is answered once."""

    @initialize()
    def begin(self):
        self.panel = self.make(**GROUPS, max_clients=4, clients_per_user=2, burst=1000)
        self.clients = []
        self.operated = self.answered = 0

    @rule(peer=st.sampled_from([KIOSK, GUEST, OPERATOR, STRANGER]))
    def connect(self, peer):
        self.clients.append((self.panel.connect(peer), peer))
        self.panel.settle()

    @rule(data=st.data(), request=st.sampled_from([*OPERATIONS, PLAY, {"kind": "state"}, {"kind": "subscribe", "to": ["state"]}]))
    def ask(self, data, request):
        if not self.clients:
            return
        client, peer = data.draw(st.sampled_from(self.clients))
        lines = self.panel.socket.counters.lines
        try:
            self.panel.ask(client, {**request, "id": lines})
        except (BrokenPipeError, ConnectionResetError):
            return
        served = self.panel.socket.counters.lines > lines
        assert not (served and peer is STRANGER)
        self.operated += served and peer is OPERATOR and request in OPERATIONS

    @rule()
    def decide(self):
        for ticket, *_ in self.panel.control.plays:
            self.panel.socket.outcome(ticket, Outcome.PLAYED, 0.0)
        self.panel.control.plays.clear()
        self.panel.socket.changed(Condition(PanelState.ARMED, outputs_on=True))
        self.panel.settle()

    @rule(data=st.data())
    def leave(self, data):
        if self.clients:
            client, _ = self.clients.pop(data.draw(st.integers(0, len(self.clients) - 1)))
            client.close()
            self.panel.settle()

    @rule(passed_s=st.sampled_from([0.1, 20.0]))
    def wait(self, passed_s):
        self.panel.now_s += passed_s

    @invariant()
    def holds(self):
        panel = self.panel
        counters = panel.socket.counters
        assert len(panel.control.switched) + len(panel.control.scenes) == self.operated
        waiting = panel.socket.waiting
        answered = counters.played + counters.merged + counters.skipped + counters.refused + counters.done
        assert counters.lines == answered + waiting
        assert sum(panel.socket._pending.of_user.values()) == waiting
        there = list(panel.socket._clients)
        of = Counter(client.peer.uid for client in there if "operate" not in client.rights)
        assert all(count <= 2 for count in of.values())
        assert STRANGER.uid not in of

    def teardown(self):
        self.panel.close()


def test_whatever_users_do_only_operators_operate(panel_with):
    from hypothesis.stateful import run_state_machine_as_test

    class Bound(Clients):
        make = staticmethod(panel_with)

    run_state_machine_as_test(Bound, settings=settings(max_examples=30, stateful_step_count=25, deadline=None))

"""How a recorded conversation is compared with what a panel says; and that the recorded one has every kind of request."""

import json
import socket
import threading
import time

from device.application_socket.test_protocol_schema import fits
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.application_socket.protocol.schema import protocol_schema
from controller.workshop.simulation.conformance import ATTEMPT_PAUSE_S, ATTEMPTS, CONVERSATION, has, main, named, steps_of

JSON = st.recursive(
    st.none() | st.booleans() | st.integers(-9, 9) | st.text(max_size=3),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=2), inner, max_size=3),
    max_leaves=8,
)


@given(JSON)
def test_whatever_is_said_has_itself_and_anything(value):
    assert has(value, value)
    assert has(value, "…")


@each_row(
    ("value", "wanted", "found"),
    [
        ({"a": 1, "b": 2}, {"a": 1}, True),
        ({"b": 2}, {"a": "…"}, False),
        ({"a": 1}, {"a": True}, False),
        ({"a": 1}, {"a": 1.0}, False),
        ([{"a": 1}], [{"a": 1}, {"a": 1}], False),
        ([{"a": 1, "b": 2}], [{"a": "…"}], True),
        ("a", {"a": 1}, False),
        (None, {}, False),
    ],
)
def test_what_a_message_has(value, wanted, found):
    assert has(value, wanted) is found


def test_names_stand_for_what_was_called_so():
    assert named({"finger": "FINGER", "place": {"x": "X"}, "list": ["FINGER"]}, {"FINGER": 7}) == {
        "finger": 7,
        "place": {"x": "X"},
        "list": ["FINGER"],
    }


def test_the_recorded_conversation_asks_for_all_there_is():
    steps = steps_of(CONVERSATION)
    kinds = {step.say["kind"] for step in steps if step.say}
    every = {name.rpartition("/")[2] for name in protocol_schema()["$defs"]["Request"]["discriminator"]["mapping"]}
    assert kinds - {"plai"} == every - {"disarm"}, "which is as stop"
    for step in steps:
        if step.answer.get("outcome") in ("played", "done"):
            assert fits("Request", {**step.say, "finger": 1} if "finger" in step.say else step.say)


@each_row(
    "text", ["", "{", "[]", '{"steps"', json.dumps({"step": []}), json.dumps({"steps": [{"says": 1}]}), json.dumps({"steps": [7]})]
)
def test_a_file_that_is_none_is_one_line(tmp_path, text, capsys):
    (tmp_path / "mine.json").write_text(text)
    assert main(["--socket", "x", "--conversation", str(tmp_path / "mine.json")]) == 1
    assert f"{tmp_path / 'mine.json'}: cannot be read as a conversation" in capsys.readouterr().err


def test_without_a_panel_it_says_so(tmp_path, capsys):
    assert main(["--socket", str(tmp_path / "none.sock")]) == 69
    assert "no panel" in capsys.readouterr().err


def test_what_answers_in_another_language_is_one_line(tmp_path, capsys):
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(str(tmp_path / "s"))
        listener.listen()

        def answer():
            with listener.accept()[0] as client:
                client.recv(1000)
                client.sendall(b"HTTP/1.1 400 Bad Request\r\n\r\n")

        thread = threading.Thread(target=answer)
        thread.start()
        assert main(["--socket", str(tmp_path / "s")]) == 69
        thread.join()
    assert "what answers is no panel" in capsys.readouterr().err


@each_row(("skipped", "code"), [(2, 0), (1000, 1)], ids=["later", "never"])
def test_a_play_that_is_skipped_is_sent_again_and_not_for_ever(tmp_path, capsys, monkeypatch, skipped, code):
    pauses = []
    monkeypatch.setattr(time, "sleep", pauses.append)
    step = {"say": {"kind": "play", "effect": "click", "id": 1}, "answer": {"outcome": "played"}}
    (tmp_path / "mine.json").write_text(json.dumps({"steps": [step]}))
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(str(tmp_path / "s"))
        listener.listen()
        asked = []

        def answer():
            with listener.accept()[0] as client, client.makefile("rw") as lines:
                for line in lines:
                    asked.append(json.loads(line))
                    lines.write(
                        json.dumps(
                            {"id": 1, "outcome": ("skipped", "merged")[len(asked) % 2] if len(asked) <= skipped else "played"}
                        )
                        + "\n"
                    )
                    lines.flush()

        thread = threading.Thread(target=answer)
        thread.start()
        assert main(["--socket", str(tmp_path / "s"), "--conversation", str(tmp_path / "mine.json")]) == code
        thread.join()
    assert asked == [step["say"]] * min(skipped + 1, ATTEMPTS)
    assert pauses == [ATTEMPT_PAUSE_S] * (len(asked) - 1)
    assert ("1 steps, all as recorded" in capsys.readouterr().out) == (code == 0)

"""Every number of a request at the ends of its range, and just beyond: one answer; beyond, it names key, value and range."""

import json

import pytest
from device.board.numbers_of import beyond, ends, numbers_of
from tables import each_row

from controller.device.application_socket.protocol.client_messages import AnyRequest
from controller.device.board.descriptions import described, type_info, unit_of
from controller.device.board.validation import dotted

FOUND = numbers_of(type_info(AnyRequest), None)
NUMBERS = {f"{made(0)['kind']}.{dotted(path)} of {at}": (path, kind, made) for at, (path, kind, made) in enumerate(FOUND)}


def answer_to(panel, client, message):
    """The one answer to a message; that of a command whose outcome the loop owes, once it has come."""
    answers = panel.ask(client, message)
    control = panel.control
    if panel.socket.waiting:
        assert answers == []
        ticket, *_ = (control.plays + control.tests + control.scenes + control.layers)[-1]
        panel.socket._answers.outcome(ticket, "done")
        answers = panel.ask(client)
        for commands in (control.plays, control.tests, control.scenes):
            commands.clear()
    return answers[0]


@pytest.mark.parametrize("called", NUMBERS)
def test_each_has_one_answer(called, panel):
    path, kind, made = NUMBERS[called]
    with panel.connect() as client:
        for number in ends(kind):
            assert "must be" not in answer_to(panel, client, made(number)).get("reason", "")
        for number in beyond(kind):
            (answer,) = panel.ask(client, made(number))
            assert answer["outcome"] == "refused"
            if path != ("id",):  # a number or a text
                assert answer["reason"].startswith(f"{dotted(path)} = {number!r}: must be ")
                assert described(kind, unit_of(path[-1])) in answer["reason"]


@each_row("called", NUMBERS)
@each_row("number", ["NaN", "Infinity", "-Infinity", "1e999", "1" * 5000, "0x10", "1e", "-"])
def test_what_is_no_number_has_one_too(called, number, panel):
    made = NUMBERS[called][2]
    line = json.dumps(made(123454321)).replace("123454321", number).encode() + b"\n"
    with panel.connect() as client:
        (answer,) = panel.ask(client, line)
    panel.turn()
    assert answer["outcome"] == "refused"
    assert answer["reason"].isprintable()

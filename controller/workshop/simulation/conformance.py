"""A recorded conversation, held with a running panel: what a client in any language has to be able to say and to read.

`python -m controller.workshop.simulation.conformance --socket S` holds `conversation.json` with a panel of
`haptic-panel serve`. A client's own tests hold the same file with the same panel: each step's `say` (or `line`, as it is) is sent,
its answer has to have what is in `answer`, and before the next step a message comes that has what is in `await`. `…` is any value;
`call` gives names to values of that message, for later steps. A play that is skipped where `played` is recorded is sent again, and
so is one that is merged with what is left of one before: a simulated panel on a busy computer may be late, or be arming again.
"""

import argparse
import json
import socket
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import msgspec

from controller.console import program, say
from controller.device.application_socket import protocol
from controller.errors import ControllerError, LinkError
from controller.regular_file import read_regular

CONVERSATION: Final = Path(protocol.__file__).with_name("conversation.json")
ANYTHING: Final = "…"
TIMEOUT_S: Final = 30.0
BYTES_MAX: Final = 1 << 20
ATTEMPTS: Final = 20  # of a play that a panel on a busy computer does not play as it is
ATTEMPT_PAUSE_S: Final = 0.05  # between them: together longer than outputs need to be on again
NOT_AS_IT_IS: Final = ("skipped", "merged")


@program
def main(arguments: list[str] | None = None) -> int:
    """Command line: a line for each step, 0 if all were as recorded, 1 at the first that was not."""
    parser = argparse.ArgumentParser(
        prog="python -m controller.workshop.simulation.conformance",
        description="Hold a recorded conversation with a running panel (`haptic-panel serve --background SOCKET`).",
    )
    parser.add_argument("--socket", required=True, metavar="S", help="the panel's socket")
    parser.add_argument("--conversation", type=Path, default=CONVERSATION, metavar="FILE.json", help="default: the one shipped")
    options = parser.parse_args(arguments)
    count = 0
    for count, step in enumerate(held(options.socket, steps_of(options.conversation)), 1):
        say(f"PASS {count}: {step}")
    say(f"{count} steps, all as recorded")
    return 0


class ConversationStep(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One step: what is said and what its answer has, or what a message has that comes by itself."""

    about: str = ""
    say: dict[str, Any] | None = None
    line: str = ""
    answer: dict[str, Any] = {}
    awaited: dict[str, Any] | None = msgspec.field(default=None, name="await")
    call: dict[str, str] = {}


class Conversation(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The whole file."""

    steps: tuple[ConversationStep, ...]
    title: str = ""


def steps_of(file: Path) -> tuple[ConversationStep, ...]:
    """Steps of a conversation; raises ControllerError if the file cannot be read."""
    try:
        return msgspec.json.decode(read_regular(file, BYTES_MAX), type=Conversation).steps
    except (OSError, ValueError) as error:  # msgspec's among them
        raise ControllerError(f"{file}: cannot be read as a conversation: {error}") from error


def held(path: str, steps: tuple[ConversationStep, ...]) -> Iterator[str]:
    """Hold a conversation; each step in words, once it was as recorded.

    Raises LinkError if there is no panel, or it does not answer; ControllerError if it answers otherwise than recorded, with step,
    answer and what was recorded.
    """
    names: dict[str, Any] = {}
    try:
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as panel:
            panel.settimeout(TIMEOUT_S)
            panel.connect(path)
            with panel.makefile("rb") as lines:
                messages = (msgspec.json.decode(line, type=dict[str, Any]) for line in lines)
                for number, step in enumerate(steps, 1):
                    yield _hold(panel, messages, step, number, names)
    except OSError as error:  # TimeoutError among them
        raise LinkError(f"{path}: no panel, or it does not answer ({error})") from error
    except msgspec.DecodeError as error:
        raise LinkError(f"{path}: what answers is no panel ({error})") from error


def _hold(
    panel: socket.socket, messages: Iterator[dict[str, Any]], step: ConversationStep, number: int, names: dict[str, Any]
) -> str:
    """One step."""
    if step.awaited is not None:
        notice = next((message for message in messages if has(message, step.awaited)), None)
        if notice is None:
            raise LinkError(f"step {number}: the panel has ended the connection")
        names |= {name: notice.get(key) for name, key in step.call.items()}
        return f"reported: {step.awaited.get('kind')}"
    request = None if step.say is None else named(step.say, names)
    line = step.line if request is None else json.dumps(request)
    wanted = None if request is None else request.get("id")
    for attempt in range(ATTEMPTS):
        if attempt:
            time.sleep(ATTEMPT_PAUSE_S)
        panel.sendall(line.encode() + b"\n")
        answer = next((message for message in messages if answers(message, wanted)), None)
        if answer is None:
            raise LinkError(f"step {number}: the panel has ended the connection")
        if answer.get("outcome") not in NOT_AS_IT_IS or step.answer.get("outcome") != "played":
            break
    if not has(answer, step.answer):
        raise ControllerError(f"step {number}: {line}: answered with {json.dumps(answer)}; recorded: {json.dumps(step.answer)}")
    return step.about or line


def answers(message: dict[str, Any], wanted: Any) -> bool:
    """Whether a message is the answer to the request with this id; None: to one that had none."""
    return "id" in message and bool(message["id"] == wanted) and not is_notice(message)


def is_notice(message: dict[str, Any]) -> bool:
    """Whether it is sent without a request: a state or a description without an id; touches, emissions and faults have none."""
    return message["id"] is None and message.get("kind") in ("state", "description")


def has(value: Any, wanted: Any) -> bool:
    """Whether a message has what is wanted, and perhaps more; lists are as long as wanted."""
    if wanted == ANYTHING:
        return True
    if isinstance(wanted, dict):
        return isinstance(value, dict) and all(key in value and has(value[key], inner) for key, inner in wanted.items())
    if isinstance(wanted, list):
        return isinstance(value, list) and len(value) == len(wanted) and all(map(has, value, wanted))
    return type(value) is type(wanted) and bool(value == wanted)


def named(value: Any, names: dict[str, Any]) -> Any:
    """A request with the values that have names."""
    if isinstance(value, dict):
        return {key: named(inner, names) for key, inner in value.items()}
    return names.get(value, value) if isinstance(value, str) else value


if __name__ == "__main__":
    raise SystemExit(main())

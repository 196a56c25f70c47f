"""What a page that floods does to its own stop: nothing; and to the bridge: no whole core, no memory."""

import asyncio
import json
import socket

import pytest

from controller.device.application_socket.token_bucket import TokenBucket
from controller.device.page import relay
from controller.device.page.outbox import WAITING_BYTES_MAX, Outbox

STOP = '{"kind":"stop","id":1}'
PAUSES_S = 0.1  # of all before a stop is passed on; 0.005 after each would be half a minute


@pytest.fixture
def paused(monkeypatch):
    """Seconds for which the bridge has let a page wait, without any that pass."""
    pauses, sleep = [], asyncio.sleep

    async def at_once(delay_s):
        pauses.append(delay_s)
        await sleep(0)

    monkeypatch.setattr(asyncio, "sleep", at_once)
    return pauses


def passed_on(frames, outbox):
    """Lines that the panel gets of a page's frames."""

    async def page():
        for frame in frames:
            yield frame

    async def run():
        ours, theirs = socket.socketpair()
        with theirs:
            _, to_panel = await asyncio.open_connection(sock=ours)
            judge = relay._Judge(frozenset({"look", "play"}), TokenBucket(1e-3, 1), {})
            await relay._requests(page(), to_panel, outbox, asyncio.Event(), judge)
            to_panel.close()
            await to_panel.wait_closed()
            return theirs.makefile().read().splitlines()

    return asyncio.run(run())


@pytest.mark.parametrize("frame", ['{"kind":"state","id":7}', '{"kind":"arm"}', "[", '{"kind":"state","id":"' + "x" * 7000 + '"}'])
def test_a_stop_waits_for_no_message_that_was_refused_before_it(paused, frame):
    lines = passed_on([frame] * 6000 + [STOP], Outbox())
    assert json.loads(lines[-1])["kind"] == "stop"
    assert len(lines) <= 2  # one state is within the rate
    assert sum(paused) <= PAUSES_S
    assert sum(pause > 0 for pause in paused) >= 6000 // relay.REFUSED_AT_ONCE - 1
    assert len(paused) >= 5999  # others get their turn in between


def test_answers_to_a_page_that_does_not_read_are_left_out_before_it_is_dropped(paused):
    outbox = Outbox()
    passed_on(['{"kind":"state","id":7}'] * 6000 + [STOP], outbox)
    assert WAITING_BYTES_MAX / 2 < sum(map(len, outbox._lines.values())) < WAITING_BYTES_MAX / 2 + 100
    outbox.put(b'{"kind":"touch","finger":1}')
    assert 0 < len(outbox) < 6000
    assert paused

"""Layers checked by a real helper process, and what becomes of everything that can go wrong with it."""

import json
import os
import selectors
import signal
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device.bank.reader import Bank
from controller.device.loop.preparation import AcceptedLayer
from controller.device.scene.layer_tables import REFUSED_MOST, read_layer
from controller.device.scene.layers import UNMOVED, Placement
from controller.device.scene.scene import SpatialIndex
from controller.device.service.scenes import helper_process
from controller.device.service.scenes.layer_helper import LayerChecker
from controller.device.service.scenes.layer_message import (
    pack_layer,
    pack_refusal,
    pack_request,
    pack_setup,
    unpack_layer,
    unpack_request,
    unpack_setup,
)
from controller.device.service.scenes.layer_preparer import LayerPreparer
from controller.device.service.scenes.message_frame import MessageError, board_of
from controller.errors import BankError


def rectangles(count=5, **more):
    return [
        {"name": f"r{at}", "shape": "rectangle", "x_mm": at % 20 * 10, "y_mm": at // 20 * 10, "width_mm": 9, "height_mm": 9}
        | {"effects": ["click"]}
        | more
        for at in range(count)
    ]


def line(*regions, **more):
    return json.dumps({"kind": "regions", "regions": regions, **more}).encode()


@pytest.fixture
def bank(bank_file, board):
    with Bank.open(bank_file, board) as opened:
        yield opened


@pytest.fixture
def preparer(board, bank):
    preparer = LayerPreparer(board, bank, [], limit_s=60)  # however busy the machine
    yield preparer
    preparer.close()


def prepared(preparer, text, placement=UNMOVED):
    """Wait as the loop does."""
    preparer.begin(text, placement)
    with selectors.DefaultSelector() as selector:
        while (done := preparer.take()) is None:
            if preparer.fileno() is not None:
                selector.register(preparer.fileno(), selectors.EVENT_READ)
                selector.select(0.05)  # a heartbeat comes as often
                selector.unregister(preparer.fileno())
    assert preparer.fileno() is None
    return done


def works(preparer):
    done = prepared(preparer, line(*rectangles()))
    assert isinstance(done, AcceptedLayer), done
    assert [region.name for region in done.regions] == ["r0", "r1", "r2", "r3", "r4"]


def test_a_layer_comes_back_as_it_was_sent_one_after_the_other(preparer, board):
    for count in (5, 200, 0, 1):
        sent = line(*rectangles(count, effects=["click", {"effect": "detent", "amplitude": 0.5}, "edge"]))
        done = prepared(preparer, sent)
        assert done.regions == read_layer(sent, board).regions
        assert (len(done.regions), done.refused) == (count, ())
    assert prepared(preparer, line(*rectangles(5)), Placement(-0.1)).off_plate == 5


def test_what_is_refused_is_named_up_to_a_number_and_counted(preparer):
    done = prepared(preparer, line(*rectangles(50, effects=["clik"]), *rectangles(1, name="good")))
    assert [region.name for region in done.regions] == ["good"]
    assert (len(done.refused), done.refused_count) == (REFUSED_MOST, 50)


@each_row(
    ("text", "reason"),
    [
        (b"", "checking the regions failed: DecodeError: Input data was truncated"),
        (b"\xff", "checking the regions failed"),
        (b"[" * 50_000, "Expected `object`, got `array`"),
        (b'{"regions": [{"name": ' + b"[" * 50_000, "checking the regions failed: RecursionError"),
        (line(effects={"a": {"when": "x"}}), "effects.a.when = 'x'"),
    ],
    afresh=[bank, preparer],
)
def test_a_line_that_is_no_layer_is_a_refusal_and_not_the_end(preparer, text, reason):
    done = prepared(preparer, text)
    assert isinstance(done, str)
    assert done.startswith(reason)
    assert "\n" not in done
    works(preparer)


def test_regions_that_share_long_rhythms_are_sent_once_and_too_many_different_ones_refused(preparer):
    rhythm = [[10 * at, 1] for at in range(1000)]
    shared = prepared(preparer, line(*rectangles(200, effects=["r"]), effects={"r": {"when": "press", "pulses": rhythm}}))
    assert len(shared.regions) == 200
    different = [region | {"amplitude": 1 - number / 100} for number, region in enumerate(rectangles(50, effects=["r"]))]
    assert "too large" in prepared(preparer, line(*different, effects={"r": {"when": "press", "pulses": rhythm}}))


def test_a_layer_takes_limited_time(board, bank):
    preparer = LayerPreparer(board, bank, [], limit_s=1e-4)
    assert prepared(preparer, line(*rectangles(250))) == "checking the regions took longer than 0.0001 s"
    preparer.close()


def test_a_helper_that_dies_is_replaced_and_asked_again(preparer):
    works(preparer)
    before = preparer.helper.process.pid
    os.kill(before, signal.SIGKILL)
    works(preparer)
    assert preparer.helper.process.pid != before


def test_a_helper_that_hangs_is_ended_and_the_next_layer_is_checked(preparer, monkeypatch):
    works(preparer)
    before = preparer.helper.process.pid
    os.kill(before, signal.SIGSTOP)
    monkeypatch.setattr(helper_process, "GRACE_S", -60)
    waited = iter([0.0, 3600.0, 3600.0, 0.0])  # at the start; twice it had no processor; then it had
    monkeypatch.setattr(helper_process, "starved_s", lambda _: next(waited))
    assert "hangs, and was ended" in prepared(preparer, line(*rectangles()))
    assert not list(waited)
    monkeypatch.undo()
    works(preparer)
    assert preparer.helper.process.pid != before


def test_what_a_process_waited_for_a_processor_is_what_the_kernel_counts():
    counted = Path("/proc/self/schedstat")
    if not counted.exists():
        pytest.skip("this kernel does not count it")
    before_s, found_s, after_s = [
        int(counted.read_text().split()[1]) * 1e-9,
        helper_process.starved_s(os.getpid()),
        int(counted.read_text().split()[1]) * 1e-9,
    ]
    assert 0 < before_s <= found_s <= after_s
    assert helper_process.starved_s(0) == 0, "there is no such process"


def test_no_process_left_is_a_refusal(preparer, monkeypatch):
    os.kill(preparer.helper.process.pid, signal.SIGKILL)
    os.waitid(os.P_PID, preparer.helper.process.pid, os.WEXITED | os.WNOWAIT)
    monkeypatch.setattr(helper_process, "start_program", lambda *_: -1)
    assert prepared(preparer, line(*rectangles())) == "there is no process that checks regions"
    monkeypatch.undo()
    works(preparer)


def test_it_ends_with_the_loop(preparer):
    works(preparer)
    pid = preparer.helper.process.pid
    preparer.helper.process.socket.close()
    assert os.waitid(os.P_PID, pid, os.WEXITED | os.WNOWAIT).si_status == 0


def test_a_bank_that_is_gone_is_a_refusal(board, bank, tmp_path):
    with pytest.raises(BankError, match="cannot be read"):
        LayerChecker(board, tmp_path / "none.bank", b"")


@pytest.fixture
def checker(board, bank):
    return LayerChecker(board, bank.path, bytes(bank.grid.cells))


def test_cells_are_checked_once_and_those_of_the_scene_never(checker, board, bank):
    counters = checker._bank.counters
    text = line(*rectangles(5))
    checker.answer(text, UNMOVED)
    once = counters.drive_checked
    assert 0 < once < bank.grid.cells
    checker.answer(text, UNMOVED)
    assert counters.drive_checked == once
    checker.answer(text, Placement(0.1, 0.05))
    assert counters.drive_checked > once
    known = LayerChecker(board, bank.path, bytes([1]) * bank.grid.cells)
    known.answer(text, UNMOVED)
    assert known._bank.counters.drive_checked == 0


def test_only_regions_whose_cells_the_bank_lacks_are_refused(checker):
    lacks = checker._bank.grid.points()[:, 0] < 30e-3
    checker._has = ~lacks
    layer = unpack_layer(checker.answer(line(*rectangles(20)), UNMOVED))
    kept = [int(region.name[1:]) for region in layer.regions]
    assert kept == list(range(kept[0], 20))
    assert kept[0] >= 3
    assert layer.refused_count == kept[0]
    assert layer.refused[0].reason.startswith("regions[0] ('r0'): the bank has no entry for ")
    moved = unpack_layer(checker.answer(line(*rectangles(5)), Placement(0.1)))
    assert moved.refused_count == 0
    shrunk = unpack_layer(checker.answer(line(*rectangles(20)), Placement(0.0, 0.0, 0.05)))
    assert len(shrunk.regions) == 0


def test_messages_survive_the_way(board, bank):
    setup = unpack_setup(pack_setup(board, bank.path, b"\1\0"))
    assert (board_of(setup.board).name, setup.bank, setup.checked) == (board.name, str(bank.path), b"\1\0")
    request = unpack_request(pack_request(b"{}", Placement(1.0, -2.0, 0.5)))
    assert (request.line, request.placement) == (b"{}", Placement(1.0, -2.0, 0.5))
    assert unpack_layer(pack_refusal("a\nb")) == "a b"


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(where=st.floats(0, 1, exclude_max=True), bits=st.integers(1, 255))
def test_a_damaged_message_is_refused_and_never_a_layer(board, where, bits):
    regions = read_layer(line(*rectangles(3)), board).regions
    message = bytearray(pack_layer(regions, SpatialIndex.of(regions), 0, ()))
    at = int(where * len(message))
    message[at] ^= bits
    with pytest.raises(MessageError):
        unpack_layer(bytes(message))
    with pytest.raises(MessageError):
        unpack_layer(bytes(message[:at]))

"""Another scene prepared by a helper process: what it gives back, and what becomes of everything that can go wrong."""

import os
import selectors
import shutil
import signal
import socket
from pathlib import Path
from types import SimpleNamespace

import msgspec
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device.bank.reader import Bank
from controller.device.scene.scene import FixedEmitter, Scene, load_scene
from controller.device.service.scenes import helper_process, message_frame, prepare_scene, scene_reload
from controller.device.service.scenes.helper_process import HelperProcess
from controller.device.service.scenes.message_frame import HEADER, MOST_BYTES, MessageError, board_of
from controller.device.service.scenes.prepare_scene import populate
from controller.device.service.scenes.scene_message import pack_request, pack_scene, unpack_request, unpack_scene
from controller.device.service.scenes.scene_reload import SceneChanger
from controller.errors import BankError, ConfigError

CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'


def prepared(changer):
    """Wait as the loop does."""
    with selectors.DefaultSelector() as selector:
        while (done := changer.take()) is None:
            selector.register(changer.fileno(), selectors.EVENT_READ)
            selector.select(0.05)  # a heartbeat comes as often
            selector.unregister(changer.fileno())
    return done


def test_the_same_scene_read_again_is_the_one_in_the_file(changer, folder):
    (folder / "scene.toml").write_text(CLICK.replace('"all"', '"another"'))
    changer.begin(None, 0)
    done = prepared(changer)
    assert isinstance(done.scene, Scene)
    assert [region.name for region in done.scene.regions] == ["another"]
    assert (done.ticket, done.selection, done.reason) == (0, None, "")
    assert changer.fileno() is None


def test_a_bad_scene_is_reported_with_its_file_and_key(changer):
    changer.begin("bad", 5)
    done = prepared(changer)
    assert (done.ticket, done.scene) == (5, None)
    assert "bad.toml" in done.reason
    assert "shape" in done.reason


def test_a_bank_that_took_the_place_of_the_old_one_is_opened(changer, bank_file, folder):
    shutil.copy(bank_file, folder / "new.bank")
    (folder / "new.bank").replace(folder / "own.bank")
    changer.begin(None, 0)
    done = prepared(changer)
    selection = done.selection
    with Bank.open(folder / "own.bank") as bank:
        assert done.expected == bank.header.board_digest
    assert selection.composes, "the memory for composing is taken before it plays"
    changer.begin(None, 0)
    assert prepared(changer).selection is None, "once"


def test_a_damaged_bank_leaves_the_old_one(changer, bank_file, folder):
    content = bytearray(bank_file.read_bytes())
    content[len(content) // 2] ^= 1
    (folder / "new.bank").write_bytes(content)
    (folder / "new.bank").replace(folder / "own.bank")
    changer.begin(None, 0)
    done = prepared(changer)
    assert (done.scene, done.selection) == (None, None)
    assert "damaged" in done.reason


def test_only_one_is_prepared_at_a_time_and_a_reload_meanwhile_is_not_lost(changer):
    changer.begin("scene", 1)
    with pytest.raises(ConfigError, match="another scene is being prepared"):
        changer.begin("bad", 2)
    changer.begin(None, 0)
    assert prepared(changer).ticket == 1
    assert changer.fileno() is not None, "the reload"
    assert prepared(changer).ticket == 0


def works(changer, name="scene"):
    changer.begin(name, 99)
    done = prepared(changer)
    assert done.scene is not None, done.reason
    return done


def test_a_scene_that_takes_too_long_is_refused_and_the_next_one_is_prepared(board, folder, bank):
    """Two million numbers take seconds to read."""
    (folder / "slow.toml").write_text(f"numbers = [{'0, ' * 2_000_000}]\n")
    changer = SceneChanger(msgspec.structs.replace(board, folder=folder), "scene", bank, limit_s=0.3)
    changer.begin("slow", 6)
    assert prepared(changer).reason == "preparing the scene took longer than 0.3 s"
    helper = changer.helper.process.pid
    while True:  # on a busy computer the next one, too, may take longer
        changer.begin("nowhere", 7)
        reason = prepared(changer).reason
        if "took longer" not in reason:
            break
    assert "'nowhere' not found" in reason
    assert changer.helper.process.pid == helper
    changer.close()


def test_after_a_child_that_was_killed_the_same_helper_prepares_the_next(changer):
    helper = changer.helper.process.pid
    works(changer)
    changer.begin("scene", 7)
    while not (child := children(helper)):
        if changer.take() is not None:  # it was too quick for us
            changer.begin("scene", 7)
    os.kill(child[0], signal.SIGKILL)
    done = prepared(changer)
    assert done.scene is not None or "SIGKILL" in done.reason
    works(changer)
    assert changer.helper.process.pid == helper


def children(pid):
    return [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def test_a_scene_that_takes_too_much_memory_is_refused(changer, folder):
    (folder / "huge.toml").write_text(f"a = '''\U0001f600{'x' * 32_000_000}'''\r\n", encoding="utf-8")  # 4 bytes for each character
    changer.begin("huge", 8)
    assert prepared(changer).reason == "preparing the scene takes more memory than 256 MB beside the bank"
    works(changer)


def test_a_scene_too_large_to_be_handed_over_is_refused(changer, folder):
    row = '[[regions]]\nname = "{0:0200}"\nshape = "circle"\nx_mm = {1}\ny_mm = 9\nradius_mm = 1\neffects = []\n'
    (folder / "large.toml").write_text("".join(row.format(k, 2 + k / 10) for k in range(1300)))
    changer.begin("large", 9)
    assert "the scene is too large" in prepared(changer).reason
    works(changer)


def test_a_helper_that_died_is_replaced_by_the_next_change(changer):
    works(changer)
    before = changer.helper.process.pid
    os.kill(before, signal.SIGKILL)
    os.waitid(os.P_PID, before, os.WEXITED | os.WNOWAIT)
    works(changer)
    assert changer.helper.process.pid != before


def test_of_a_helper_that_dies_at_work_another_one_takes_over_once(changer):
    for deaths in (1, 2):
        before = changer.helper.process.pid
        os.kill(changer.helper.process.pid, signal.SIGSTOP)
        changer.begin("scene", 10)
        os.kill(changer.helper.process.pid, signal.SIGKILL)
        if deaths == 2:
            while changer.helper.process.pid == before:
                assert changer.take() is None
            os.kill(changer.helper.process.pid, signal.SIGSTOP)
            os.kill(changer.helper.process.pid, signal.SIGKILL)
        done = prepared(changer)
        assert (done.ticket, done.scene is not None) == (10, deaths == 1)
    assert done.reason == "the process that prepares scenes ends again and again"
    works(changer)


def test_a_helper_that_hangs_is_ended_and_the_next_change_is_made(changer, monkeypatch):
    monkeypatch.setattr(helper_process, "GRACE_S", -scene_reload.LIMIT_S)
    before = changer.helper.process.pid
    os.kill(before, signal.SIGSTOP)
    changer.begin("scene", 11)
    done = prepared(changer)
    assert (done.ticket, done.scene) == (11, None)
    assert "hangs, and was ended" in done.reason
    monkeypatch.undo()
    works(changer)
    assert changer.helper.process.pid != before


def test_no_process_left_is_a_refusal_and_not_the_end(changer, monkeypatch):
    os.kill(changer.helper.process.pid, signal.SIGKILL)
    os.waitid(os.P_PID, changer.helper.process.pid, os.WEXITED | os.WNOWAIT)
    monkeypatch.setattr(helper_process, "start_program", lambda *_: -1)
    changer.begin("scene", 4)
    done = changer.take()
    assert (done.ticket, done.scene, done.reason) == (4, None, "there is no process that prepares scenes")
    monkeypatch.undo()
    works(changer)


def test_nothing_of_the_working_directory_is_run_or_read(board, bank, folder, tmp_path, monkeypatch):
    here = tmp_path / "here"
    (here / "controller/device/service/scenes").mkdir(parents=True)
    for name in (
        "controller/__init__.py",
        "controller/device/service/scenes/scene_helper_process.py",
        "msgspec.py",
        "numpy.py",
        "sitecustomize.py",
    ):
        (here / name).write_text(f"open({str(here / 'was run')!r}, 'w')\nraise SystemExit('the wrong {name}')\n")
    (here / "drums").write_text(CLICK)
    monkeypatch.chdir(here)
    monkeypatch.setenv("PYTHONPATH", str(here))
    changer = SceneChanger(msgspec.structs.replace(board, folder=folder), "scene", bank)
    works(changer)
    changer.begin("drums", 1)
    assert "'drums' not found" in prepared(changer).reason
    assert not (here / "was run").exists()
    changer.close()


def test_the_helper_is_ordinary_nice_and_has_no_file_of_ours_but_its_socket(changer, folder):
    works(changer)
    assert os.sched_getscheduler(changer.helper.process.pid) == os.SCHED_OTHER
    assert os.getpriority(os.PRIO_PROCESS, changer.helper.process.pid) >= 5
    opened = {int(file.name): str(file.readlink()) for file in Path(f"/proc/{changer.helper.process.pid}/fd").iterdir()}
    assert opened[1] == "/dev/null"
    ours = {number for number, path in opened.items() if "/libffi.so" not in path}  # its trampolines map its own file
    assert ours == {0, 1, 2}, opened


def test_until_the_first_request_the_helper_has_imported_nothing_of_it(changer):
    def numpy_is_mapped():
        return "_multiarray_umath" in Path(f"/proc/{changer.helper.process.pid}/maps").read_text()

    while os.getpriority(os.PRIO_PROCESS, changer.helper.process.pid) < 5:
        os.sched_yield()
    assert not numpy_is_mapped()
    works(changer)
    assert numpy_is_mapped()


def test_it_ends_with_the_loop_though_nothing_was_asked(changer):
    pid = changer.helper.process.pid
    changer.helper.process.socket.close()
    assert os.waitid(os.P_PID, pid, os.WEXITED | os.WNOWAIT).si_status == 0


def test_it_ends_with_the_loop(changer):
    works(changer)
    pid = changer.helper.process.pid
    changer.helper.process.socket.close()
    assert os.waitid(os.P_PID, pid, os.WEXITED | os.WNOWAIT).si_status == 0


def test_a_bank_that_lacks_what_the_scene_reaches_is_refused(board, bank, folder, tmp_path):
    from controller.workshop.bank_builder.build import build_bank
    from controller.workshop.bank_builder.request import BankRequest

    file = tmp_path / "corner.bank"
    reached = (bank.grid.points() < 0.06).all(axis=1)
    build_bank(BankRequest(board, file, bank.grid.pitch_m, reached))
    scene = load_scene(folder / "scene.toml", board)
    with Bank.open(file, board) as small, pytest.raises(BankError, match="has no entry for"):
        populate(small, scene, "scene.toml")
    assert populate(bank, scene, "scene.toml") == bank.grid.cells
    without = SimpleNamespace(wave_scale=1.0, drive=SimpleNamespace(compositions=()))
    one = FixedEmitter(0.06, 0.05, 25.0, "spot")
    for emitters, served in (((), True), ((one,), True), ((one._replace(amplitude=0.5),), False), ((one, one), False)):
        assert prepare_scene._emitters_composed(without, SimpleNamespace(emitters=emitters)) is served


def test_at_the_start_every_entry_is_checked_and_no_response_is_read(board, bank_file, folder):
    """Nine tenths of a bank are responses: they are read where a finger is, when it comes there."""
    scene = load_scene(folder / "scene.toml", board)
    with Bank.open(bank_file, board) as bank:
        cells = populate(bank, scene, "scene.toml")
        assert (bank.counters.drive_checked, bank.counters.response_checked) == (cells, 0)
        assert bank.counters.mapped_bytes == {}, "and nothing that it takes is memory of this process"
        bank.drive.frames(cells // 2)
        assert bank.counters.drive_checked == cells, "by now it is known to be good"
        assert populate(bank, scene, "scene.toml", responses=True) == cells
        assert (bank.counters.drive_checked, bank.counters.response_checked) == (2 * cells, cells)


# What the other process says


def scene_data(board, folder):
    return pack_scene(load_scene(folder / "scene.toml", board))


def framed(data, version=message_frame.VERSION):
    return HEADER.pack(b"HPsc", version, len(data), message_frame.zlib.crc32(data)) + data


def test_a_scene_comes_over_as_it_was_and_a_request_too(board):
    for name in ("scene", "library"):
        scene = load_scene(board.folder / f"{name}.toml", board)
        copy = unpack_scene(pack_scene(scene))
        assert copy == scene
        assert copy.index == scene.index
        assert copy.emitters == scene.emitters
    request = unpack_request(pack_request(board, "drums", board.folder / "x.bank"))
    assert (board_of(request.board), request.scene, request.bank) == (board, "drums", str(board.folder / "x.bank"))
    assert board_of(request.board).digest() == board.digest()


def changed(message, path, value):
    """The message with another value somewhere in it, and the right CRC."""
    tree = msgspec.msgpack.decode(message[HEADER.size :])
    inner = tree
    for step in path[:-1]:
        inner = inner[step]
    inner[path[-1]] = value
    return framed(msgspec.msgpack.encode(tree))


AREA, SHAPE, TRAIN = ["scene", 0, 0], ["scene", 0, 0, 1], ["scene", 1, "click"]


@each_row(
    ("path", "value"),
    [
        (["software"], "0.0.1"),
        (["software"], None),
        (["more"], 1),
        (["reason"], "x" * 2000),
        ([*SHAPE, 1], float("nan")),
        ([*SHAPE, 1], float("inf")),
        ([*SHAPE, 0], "Sphere"),
        ([*AREA, 0], 7),
        ([*AREA], [1, 2]),
        ([*AREA, 1], None),
        ([*TRAIN, 0], float("nan")),
        ([*TRAIN, 0], 1.5),
        ([*TRAIN, 1], 0),
        ([*TRAIN, 1], 1 << 60),
        ([*TRAIN, 2], -1.0),
        ([*TRAIN, 3], float("nan")),
        (["scene", 1, "long"], [1.0, 1, 0.0, 0.0, [[0.0, 1.0]] * 1001]),
        (["scene", 2, 0], float("nan")),
        (["scene", 2, 2], 0.0),
        (["scene", 2, 2], float("inf")),
        (["scene", 2, 3], 1e300),
        (["scene", 2, 4], []),
        (["scene", 2, 4, 0], [1]),
        (["scene", 2, 4, 0], [-1]),
        (["scene", 2, 4, 0], [1 << 62]),
        (["scene", 2, 4, 0], "0"),
    ],
)
def test_a_value_that_cannot_be_is_refused_though_the_message_is_whole(board, folder, path, value):
    with pytest.raises(MessageError) as refused:
        unpack_scene(changed(scene_data(board, folder), path, value))
    assert "\n" not in str(refused.value)


@each_row(
    "damage",
    [
        lambda message: message[:-1],
        lambda message: message + b"x",
        lambda message: message[:10],
        lambda _: b"",
        lambda message: b"PK" + message[2:],
        lambda message: framed(message[HEADER.size :], version=message_frame.VERSION + 1),
        lambda message: HEADER.pack(b"HPsc", message_frame.VERSION, 0xFFFFFFFF, 0) + message[HEADER.size :],
        lambda _: framed(b"\x90" * 5000),
        lambda _: framed(b"\x91" * 5000),
        lambda _: framed(b"\xdd\xff\xff\xff\xff"),
        lambda _: framed(b""),
        lambda message: b"\x80\x04\x95" + message,
    ],
)
def test_what_is_no_message_is_refused(board, folder, damage):
    with pytest.raises(MessageError) as refused:
        unpack_scene(damage(scene_data(board, folder)))
    assert "\n" not in str(refused.value)


@pytest.fixture
def lied_to(board, folder, bank, monkeypatch):
    """A changer whose helper is the test: asked for a scene with ticket 3, what it makes of an answer."""
    ends = []

    def start(self):
        self.socket, other = socket.socketpair()
        self.socket.setblocking(False)
        ends.append(other)

    def end(self):
        if self.socket is not None:
            self.socket.close()
            self.socket = None

    monkeypatch.setattr(HelperProcess, "start", start)
    monkeypatch.setattr(HelperProcess, "end", end)

    def ask(answer):
        changer = SceneChanger(msgspec.structs.replace(board, folder=folder), "scene", bank)
        changer.begin("scene", 3)
        done = None
        while done is None:
            if ends:  # the first, or another one that is asked because the first has ended
                with ends.pop() as helper:
                    helper.sendall(answer)
            done = changer.take()
        assert changer.fileno() is None
        changer.close()
        while ends:  # of another helper that was started and not asked
            ends.pop().close()
        return done

    return ask


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(st.data())
def test_whatever_the_helper_answers_the_loop_gets_a_scene_that_is_right_or_a_line(board, folder, lied_to, data):
    answer = bytearray(scene_data(board, folder))
    for _ in range(data.draw(st.integers(0, 4))):
        at = data.draw(st.integers(0, max(len(answer) - 1, 0)))
        match data.draw(st.sampled_from(["flip", "cut", "insert", "drop", "repeat"])):
            case "flip" if answer:
                answer[at] ^= 1 << data.draw(st.integers(0, 7))
            case "cut":
                del answer[at:]
            case "insert":
                answer[at:at] = data.draw(st.binary(max_size=40))
            case "drop":
                del answer[at : at + data.draw(st.integers(1, 40))]
            case "repeat":
                answer += answer[:at]
    if data.draw(st.booleans()) and len(answer) > HEADER.size:  # as if it were meant
        answer = bytearray(framed(bytes(answer[HEADER.size :])))
    done = lied_to(bytes(answer))
    assert done.ticket == 3
    if done.scene is None:
        assert done.reason
        assert "\n" not in done.reason
    else:
        for x_m in (-1.0, 0.0, 0.1, 0.2, 5.0):
            assert -1 <= done.scene.lookup.at(x_m, 0.07) < len(done.scene.regions)


def test_an_answer_that_says_it_is_too_large_is_refused_before_it_is_there(lied_to):
    assert "too large" in lied_to(HEADER.pack(b"HPsc", message_frame.VERSION, MOST_BYTES + 1, 0)).reason
    assert "ends again and again" in lied_to(HEADER.pack(b"HPsc", message_frame.VERSION, MOST_BYTES, 0) + b"not as much").reason

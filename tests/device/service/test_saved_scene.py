"""Scenes that an operator saves: checked before they are kept, found by their name, never in place of the board's own."""

import errno
import os
import resource
import shutil
import signal

import msgspec
import pytest
from device.service.test_scene_reload import prepared, works
from tables import each_row

from controller.device.application_socket.protocol.client_messages import request_decoder
from controller.device.scene.scene_file import find_scene, read_scene
from controller.device.service.scenes import saved_scene
from controller.device.service.scenes.saved_scene import BYTES_MAX, SAVED_MAX, save_scene
from controller.errors import ConfigError

MINE = '[[regions]]\nname = "mine"\nshape = "plate"\neffects = ["click"]\n'
UNKNOWN = MINE.replace("click", "clik")


@pytest.fixture(autouse=True)
def state(tmp_path, monkeypatch):
    state = tmp_path / "state"
    monkeypatch.setenv("STATE_DIRECTORY", str(state))
    return state


@pytest.fixture
def own(board, folder):
    return msgspec.structs.replace(board, folder=folder)


def files(state):
    return sorted(str(file.relative_to(state)) for file in state.rglob("*") if file.is_file())


def test_what_is_saved_is_found_by_its_name_and_may_be_replaced(own, state):
    save_scene(own, "mine", MINE)
    file = state / "scenes" / own.key / "mine.toml"
    assert find_scene(own, "mine") == file
    assert file.read_text() == MINE
    save_scene(own, "mine", MINE.replace('"mine"', '"other"'))
    assert read_scene(find_scene(own, "mine"), own).regions[0].table.name == "other"
    assert files(state) == [f"scenes/{own.key}/mine.toml"]
    with pytest.raises(ConfigError, match=r"scene 'none' not found; .* has: .*mine"):
        find_scene(own, "none")


@pytest.mark.parametrize("name", ["scene", "bad", "board"])
def test_the_boards_own_is_never_replaced_and_comes_first(own, state, name):
    with pytest.raises(ConfigError, match=f"'{name}' is taken by the board's own {name}.toml"):
        save_scene(own, name, MINE)
    assert files(state) == []
    save_scene(own, "mine", MINE)
    shutil.copy(own.folder / "scene.toml", own.folder / "mine.toml")  # which a later release brings
    assert find_scene(own, "mine") == own.folder / "mine.toml"


@each_row(
    ("toml", "said"),
    [
        (UNKNOWN, r"mine.toml: regions\[0\].effects\[0\] = 'clik' is no effect; known: .*click"),
        (MINE + "[[regions]]\n", r"mine.toml: regions\[1\]"),
        ("[[regions]", "mine.toml: not valid TOML: "),
        ("a = " + "[" * 5000, "mine.toml: not valid TOML: "),
        ("a = '\0'", "mine.toml: not valid TOML: "),
        (MINE + "#" * BYTES_MAX, "mine.toml: 65,5.. bytes, a saved scene has at most 65,536"),
        (MINE + "#" + "ä" * (BYTES_MAX // 2), "bytes, a saved scene has at most 65,536"),
    ],
)
def test_what_is_no_scene_of_this_board_is_refused_with_the_readers_words_and_nothing_is_kept(own, state, toml, said):
    save_scene(own, "mine", MINE)
    with pytest.raises(ConfigError, match=said):
        save_scene(own, "mine", toml)
    assert find_scene(own, "mine").read_text() == MINE
    assert files(state) == [f"scenes/{own.key}/mine.toml"]


def test_there_are_so_many_and_no_more(own, state):
    for number in range(SAVED_MAX):
        save_scene(own, f"s{number}", MINE)
    with pytest.raises(ConfigError, match="64 scenes are saved, the most of one board"):
        save_scene(own, "more", MINE)
    save_scene(own, "s5", MINE + "\n")
    assert len(files(state)) == SAVED_MAX


def test_whoever_may_not_look_into_the_folder_finds_none_and_the_boards_own(own, state):
    save_scene(own, "mine", MINE)
    for folder in state.parents:
        if folder.name.startswith(("test_", "pytest-", "popen-")):  # of pytest, which lets nobody else in
            folder.chmod(0o755)
    state.chmod(0)

    def nobody():
        if os.geteuid() == 0:
            os.setgroups([])
            os.setuid(65534)
        try:
            return find_scene(own, "mine")
        except ConfigError as error:
            return f"{find_scene(own, 'scene').name}; {error}"

    said = in_child(nobody)
    state.chmod(0o755)
    assert said.startswith("scene.toml; scene 'mine' not found; ")


HOSTILE = ("../x", "a/b", ".", "..", "", "a.toml", ".hidden", "a\0b", "a\nb", "-rf", "a b", "x" * 65, "ä", "mine\n", "/etc/passwd")


@each_row("name", HOSTILE)
def test_a_name_that_is_none_does_not_come_this_far(name):
    line = msgspec.json.encode({"kind": "save_scene", "name": name, "toml": MINE})
    with pytest.raises(msgspec.ValidationError, match="name"):
        request_decoder().decode(line)


@pytest.mark.parametrize("name", ["../mine", "x/../mine"])
def test_nothing_is_found_beside_the_folder_of_saved_scenes(own, state, name):
    (state / "scenes" / own.key / "x").mkdir(parents=True)
    (state / "scenes/mine.toml").write_text(MINE)
    save_scene(own, "mine", MINE)
    with pytest.raises(ConfigError, match="not found"):
        find_scene(own, name)


def in_child(work):
    """What a function says in a process of its own."""
    reads, writes = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            os.write(writes, str(work()).encode())
        finally:
            os._exit(0)
    os.close(writes)
    with os.fdopen(reads, "rb") as said:
        text = said.read().decode()
    os.waitpid(child, 0)
    return text


def test_a_full_disk_leaves_what_was_there(own, state):
    """A limit of the process stands for it."""
    save_scene(own, "mine", MINE)

    def full():
        resource.setrlimit(resource.RLIMIT_FSIZE, (10, 10))
        try:
            save_scene(own, "mine", MINE + "\n")
        except ConfigError as error:
            return error

    assert f"mine.toml: cannot be written ({os.strerror(errno.EFBIG)})" in in_child(full)
    assert find_scene(own, "mine").read_text() == MINE
    assert files(state) == [f"scenes/{own.key}/mine.toml"]


def test_a_power_cut_at_any_moment_leaves_the_old_or_the_new_one(own, state, monkeypatch):
    """Killed before each system call that changes the disk."""
    save_scene(own, "mine", MINE)
    new = MINE + "# new\n"

    for name in ("fchmod", "fsync", "rename"):

        def killed(*_, **__):
            os.kill(os.getpid(), signal.SIGKILL)

        def cut(name=name):
            monkeypatch.setattr(os, name, killed) if name != "rename" else monkeypatch.setattr(type(state), "replace", killed)
            save_scene(own, "mine", new)

        assert in_child(cut) == ""
        assert find_scene(own, "mine").read_text() == MINE
    save_scene(own, "mine", new)
    assert files(state) == [f"scenes/{own.key}/mine.toml"], "and nothing stays of those before"


def test_nowhere_to_save_is_one_line(own, monkeypatch):
    monkeypatch.setattr(saved_scene, "saved_scenes", lambda _: None)
    with pytest.raises(ConfigError, match="set STATE_DIRECTORY"):
        save_scene(own, "mine", MINE)


# Beside the loop


def saved(changer, name="mine", toml=MINE, ticket=3):
    changer.save(name, toml, ticket)
    return prepared(changer)


def test_the_helper_saves_and_the_scene_in_force_stays(changer, state, own):
    done = saved(changer)
    assert (done.ticket, done.scene, done.reason, done.saves) == (3, None, "", True)
    assert changer.name == "scene"
    assert files(state) == [f"scenes/{own.key}/mine.toml"]
    assert [region.name for region in works(changer, "mine").scene.regions] == ["mine"]
    assert changer.name == "mine"


def test_the_helper_says_why_not(changer, state):
    done = saved(changer, toml=UNKNOWN)
    assert (done.scene, done.saves) == (None, True)
    assert done.reason.startswith("mine.toml: regions[0].effects[0] = 'clik' is no effect")
    assert files(state) == []
    assert saved(changer, toml=MINE + "#" * (BYTES_MAX - len(MINE))).reason == "", "the largest"


def test_while_a_scene_is_prepared_none_is_saved_and_the_other_way_round(changer):
    changer.begin("scene", 1)
    with pytest.raises(ConfigError, match="another scene is being prepared"):
        changer.save("mine", MINE, 2)
    assert prepared(changer).scene is not None
    changer.save("mine", MINE, 2)
    with pytest.raises(ConfigError, match="another scene is being prepared"):
        changer.begin("scene", 1)
    changer.begin(None, 0)
    assert prepared(changer).saves
    assert prepared(changer).scene is not None, "the reload that came meanwhile"

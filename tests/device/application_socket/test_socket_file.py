"""The socket's file: whose it is before anybody sees it, and from whom it may be taken."""

import fcntl
import grp
import os
import pwd
import resource
import socket
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from controller.device.application_socket.connections.socket_file import SocketFile
from controller.errors import ConfigError, ControllerError


def mode_of(path):
    return stat.S_IMODE(Path(path).lstat().st_mode)


def connects(path):
    with socket.socket(socket.AF_UNIX) as client:
        try:
            client.connect(str(path))
        except OSError:
            return False
        return True


@pytest.mark.parametrize(("mode", "is_"), [("660", 0o660), ("0600", 0o600), ("666", 0o666)])
def test_the_mode_is_the_boards_and_not_the_umasks(settings, changed, mode, is_):
    before = os.umask(0o027)
    try:
        made = SocketFile(changed(settings, mode=mode))
        assert os.umask(0o027) == 0o027
    finally:
        os.umask(before)
    assert mode_of(settings.path) == is_
    assert connects(settings.path)
    made.close()


def test_it_appears_only_when_it_is_complete(settings, changed, folder, monkeypatch):
    seen = []
    real = Path.rename

    def watched(self, target):
        seen.append((Path(target).exists(), mode_of(self), connects(self)))
        return real(self, target)

    monkeypatch.setattr(Path, "rename", watched)
    made = SocketFile(changed(settings, mode="640"))
    assert seen == [(False, 0o640, True)]
    assert [path.name for path in folder.iterdir()] == ["panel.sock"]
    made.close()


def test_until_it_has_its_mode_nobody_else_may_connect(settings, monkeypatch):
    seen = []
    real = Path.chmod

    def watched(self, mode):
        seen.append(mode_of(self))
        return real(self, mode)

    monkeypatch.setattr(Path, "chmod", watched)
    SocketFile(settings).close()
    assert seen == [0o600]


def test_owner_and_group_are_the_boards(settings, changed):
    if os.geteuid() == 0:
        user = next(entry for entry in pwd.getpwall() if entry.pw_uid)
        group = next(entry for entry in grp.getgrall() if entry.gr_gid not in (0, user.pw_gid))
    else:
        user, group = pwd.getpwuid(os.geteuid()), grp.getgrgid(os.getegid())
    made = SocketFile(changed(settings, owner=user.pw_name, group=group.gr_name))
    is_ = Path(settings.path).stat()
    assert (is_.st_uid, is_.st_gid) == (user.pw_uid, group.gr_gid)
    made.close()


@pytest.mark.parametrize(("key", "words"), [("owner", "no such user"), ("group", "no such group")])
def test_an_unknown_owner_or_group_is_refused_by_name(settings, changed, key, words):
    with pytest.raises(ConfigError, match=rf"application_socket.{key} = 'nobody-like-this': {words}"):
        SocketFile(changed(settings, **{key: "nobody-like-this"}))
    assert not Path(settings.path).exists()


def test_the_file_of_a_killed_service_is_replaced(settings):
    code = f"import os, socket; s = socket.socket(socket.AF_UNIX); s.bind({settings.path!r}); s.listen(); os.kill(os.getpid(), 9)"
    subprocess.run([sys.executable, "-c", code], check=False)
    assert Path(settings.path).is_socket()
    assert not connects(settings.path)
    made = SocketFile(settings)
    assert connects(settings.path)
    made.close()


def test_a_running_services_socket_is_left_alone(settings, folder):
    first = SocketFile(settings)
    with pytest.raises(ControllerError, match=r"panel\.sock: another service is running there; stop it"):
        SocketFile(settings)
    assert connects(settings.path)
    assert [path.name for path in folder.iterdir()] == ["panel.sock"]
    first.close()


def test_a_service_too_busy_to_accept_is_running_nevertheless(settings):
    with socket.socket(socket.AF_UNIX) as busy:
        busy.bind(settings.path)
        busy.listen(0)
        with socket.socket(socket.AF_UNIX) as client:
            client.connect(settings.path)  # the backlog is full now
            with pytest.raises(ControllerError, match="another service is running there"):
                SocketFile(settings)


def held(lock, mode=0o600):
    """The lock's file, held as another service that starts would hold it."""
    number = os.open(lock, os.O_RDWR | os.O_CREAT, 0o600)
    os.fchmod(number, mode)
    fcntl.flock(number, fcntl.LOCK_EX)
    return number


def test_two_services_do_not_start_at_once(settings, folder):
    number = held(folder / ".panel.sock.lock")
    with pytest.raises(ControllerError, match="another service makes its socket there"):
        SocketFile(settings)
    os.close(number)
    SocketFile(settings).close()
    assert not list(folder.iterdir())


def test_whoever_locks_the_folder_keeps_no_service_from_starting(settings, folder, another):
    """Any local user can: it is enough that the folder can be read."""
    folder.chmod(0o755)

    def locks(says, hears):
        fcntl.flock(os.open(folder, os.O_RDONLY), fcntl.LOCK_EX)
        says.write(b"locked\n")
        hears.readline()

    with another(locks, uid=65534) as (says, hears):
        assert hears.readline() == b"locked\n"
        SocketFile(settings).close()
        says.write(b"\n")


def test_a_lock_that_others_can_open_is_none(settings, folder):
    number = held(folder / ".panel.sock.lock", mode=0o644)
    with pytest.raises(ConfigError, match=r"\.panel\.sock\.lock is not a file that only this user can open"):
        SocketFile(settings)
    os.close(number)


def test_a_lock_that_its_holder_removed_meanwhile_is_taken_anew(settings, folder, monkeypatch):
    """Between our opening it and locking it: two could hold one each."""
    real, opened = fcntl.flock, []

    def removed_first(number, how):
        if not opened:
            (folder / ".panel.sock.lock").unlink()
        opened.append(os.fstat(number).st_nlink)
        real(number, how)

    monkeypatch.setattr(fcntl, "flock", removed_first)
    SocketFile(settings).close()
    assert opened == [0, 1]


@pytest.mark.parametrize("make", [lambda path: path.write_text("precious"), Path.mkdir, lambda path: path.symlink_to("/dev/null")])
def test_a_file_of_another_kind_is_not_replaced(settings, make):
    make(Path(settings.path))
    with pytest.raises(ConfigError, match="is a file of another kind"):
        SocketFile(settings)
    assert os.path.lexists(settings.path)


@pytest.mark.parametrize("path", ["missing/panel.sock", "x" * 120 + ".sock"])
def test_a_path_that_cannot_be_is_refused_in_one_line(settings, changed, folder, path):
    with pytest.raises(ConfigError, match=r"application_socket.path = '.*' cannot be made \(.+\)") as refused:
        SocketFile(changed(settings, path=str(folder / path)))
    assert "\n" not in str(refused.value)
    assert not list(folder.iterdir())


def test_closing_removes_the_file_unless_it_is_anothers_by_now(settings):
    first = SocketFile(settings)
    first.close()
    assert not Path(settings.path).exists()
    first = SocketFile(settings)
    Path(settings.path).unlink()
    second = SocketFile(settings)
    first.close()
    assert connects(settings.path)
    second.close()


def test_what_the_system_lacks_at_the_moment_is_no_wrong_setting(settings):
    """Exit code 78 would keep the service from being started again."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    free = os.dup(0)
    os.close(free)
    resource.setrlimit(resource.RLIMIT_NOFILE, (free + 1, hard))  # one more: for the socket, and none for its lock
    try:
        with pytest.raises(ControllerError, match="cannot be made") as caught:
            SocketFile(settings)
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))
    assert caught.value.exit_code == 1
    SocketFile(settings).close()

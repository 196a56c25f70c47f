"""Nothing of a release runs as root: /usr/bin/haptic-panel becomes another user before it, and leaves nothing of root's to it."""

import contextlib
import json
import os
import pty
import pwd
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from tables import each_row

from controller.cli import COMMANDS
from controller.commands.update import STEPS

SYSTEMD = Path(__file__).parents[3] / "systemd"
PYTHON = "/usr/bin/python3"  # one that every user may run
AS_ROOT = pytest.mark.skipif(os.geteuid() != 0 or not Path(PYTHON).exists(), reason="only root changes users")

PROBE = """
import json, os, signal
status = dict(line.split(":\\t", 1) for line in open("/proc/self/status").read().splitlines())
def reachable(path):
    try:
        open(path).close()
    except OSError:
        return False
    return True
print(json.dumps({
    "uids": os.getresuid(), "gids": os.getresgid(), "groups": os.getgroups(), "umask": os.umask(0),
    "capabilities": [status["Cap" + kind].strip("0") for kind in ("Inh", "Prm", "Eff", "Bnd", "Amb")],
    "no_new_privileges": status["NoNewPrivs"], "environment": dict(os.environ), "terminal": reachable("/dev/tty"),
    "files": [name for name in os.listdir("/proc/self/fd") if os.path.exists("/proc/self/fd/" + name)],
    "ignored": [s for s in range(1, 32) if signal.getsignal(s) is signal.SIG_IGN and s not in (signal.SIGPIPE, signal.SIGXFSZ)],
    "folder": os.stat(".").st_ino,
}))
"""


@pytest.fixture
def place():
    """A folder that every user may read, as those of pytest may not be."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)
        yield Path(folder)


def as_user(*command, user="nobody", **how):
    """A command run by the script."""
    how = {"stdin": subprocess.DEVNULL} | how
    return subprocess.run([SYSTEMD / "as-user", user, *command], capture_output=True, text=True, check=False, **how)


def probed(**how):
    """What a process finds that the script has begun."""
    done = as_user(PYTHON, "-c", PROBE, **how)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture(params=["no terminal", "a terminal beside"])
def session(request):
    """Session of a command whose input and output are no terminal, as a function to be called before it."""
    if request.param == "no terminal":
        yield os.setsid
        return
    master, slave = pty.openpty()
    name = os.ttyname(slave)

    def begin():
        os.setsid()
        os.close(os.open(name, os.O_RDWR))  # the first that it opens is its terminal

    yield begin
    os.close(master)
    os.close(slave)


@AS_ROOT
def test_nothing_of_roots_is_left_to_a_command(session):
    with Path("/etc/shadow").open() as one, Path("/etc/shadow").open() as two:
        os.dup2(two.fileno(), 93)
        os.set_inheritable(one.fileno(), True)
        secrets = {"SSH_AUTH_SOCK": "/run/agent", "LD_PRELOAD": "", "PYTHONPATH": "/tmp", "BASH_ENV": "/tmp/x", "ENV": "/tmp/x"}
        found = probed(
            pass_fds=(one.fileno(), 93), env=os.environ | secrets | {"LC_ALL": "C.UTF-8", "HOME": "/root"}, preexec_fn=session
        )
        os.close(93)
    nobody = pwd.getpwnam("nobody")
    assert found["uids"] == [nobody.pw_uid] * 3
    assert (found["gids"], found["groups"]) == ([nobody.pw_gid] * 3, [nobody.pw_gid])
    assert (found["capabilities"], found["no_new_privileges"]) == ([""] * 5, "1")
    assert not secrets.keys() & found["environment"].keys()
    assert (found["environment"]["HOME"], found["environment"]["LC_ALL"]) == ("/nonexistent", "C.UTF-8")
    assert found["environment"]["PATH"] == "/usr/sbin:/usr/bin:/sbin:/bin"
    assert sorted(found["files"]) == ["0", "1", "2"]
    assert (found["terminal"], found["ignored"], found["umask"]) == (False, [], 0o022)


@AS_ROOT
def test_a_program_that_would_make_root_of_a_user_does_not(place):
    shutil.copy("/usr/bin/id", place / "id")
    (place / "id").chmod(0o4755)
    assert as_user(str(place / "id"), "-u").stdout == "65534\n"


@AS_ROOT
def test_a_folder_that_only_root_reaches_is_left(place):
    closed = place / "closed/open"
    closed.mkdir(parents=True)
    assert probed(cwd=closed)["folder"] == closed.stat().st_ino
    closed.parent.chmod(0o700)
    assert probed(cwd=closed)["folder"] == Path("/").stat().st_ino
    refused = as_user("cat", "some.toml", cwd=closed.parent)
    assert "Permission denied" in refused.stderr, "and not that there is no such file"


@AS_ROOT
def test_arguments_input_output_and_exit_code_pass():
    words = ["a b", "c'd", "e\nf", '$HOME"`', "", "\\x", "é"]
    assert as_user("printf", "%s|", *words).stdout == "".join(f"{word}|" for word in words)
    done = as_user("sh", "-c", "cat; echo error >&2; exit 7", stdin=None, input="typed\n")
    assert (done.returncode, done.stdout, done.stderr) == (7, "typed\n", "error\n")
    done = as_user("sh", "-c", "kill -KILL $$")
    assert done.returncode in (137, -signal.SIGKILL), "as a shell tells it, or as it is"
    assert done.stderr == ""
    done = as_user("no-such-program")
    assert (done.returncode, done.stdout) == (127, "")


@AS_ROOT
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_the_command_and_its_own_exit_code_is_reported(number, session):
    code = f"import signal\nsignal.signal({number:d}, lambda *_: exit(13))\nprint('ready', flush=True)\nwhile True: signal.pause()"
    as_user_of_a_shell = ["env", "--default-signal", SYSTEMD / "as-user"]  # a shell ignores some in the background
    command = [*as_user_of_a_shell, "nobody", PYTHON, "-c", code]
    quiet = {"stdin": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    with subprocess.Popen(command, **quiet, stdout=subprocess.PIPE, text=True, preexec_fn=session) as process:  # noqa: PLW1509
        assert process.stdout.readline() == "ready\n"
        os.killpg(process.pid, number)
        assert process.wait() == 13
        assert process.stdout.read() == ""


@AS_ROOT
def test_what_kills_its_process_group_leaves_nothing_of_a_command():
    """As dpkg's end does, so that an installation that is begun again is the only one."""
    code = "import os, signal\nos.fork()\nprint('ready', flush=True)\nsignal.pause()"
    with subprocess.Popen(
        [SYSTEMD / "as-user", "nobody", "sh", "-c", f'{PYTHON} -c "$1"; :', "sh", code],
        stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, start_new_session=True,
    ) as process:  # fmt: skip
        assert [process.stdout.readline(), process.stdout.readline()] == ["ready\n"] * 2
        os.killpg(process.pid, signal.SIGKILL)
        assert process.stdout.read() == "", "its last process has closed it"


class Terminal:
    """A terminal with root's shell in it, which runs a command and then reads what is typed."""

    def __init__(self, *command, **redirected):
        self.pid, self._master = pty.fork()
        if not self.pid:
            for name, path in redirected.items():
                os.dup2(os.open(path, os.O_RDWR | os.O_CREAT), ("stdin", "stdout", "stderr").index(name))
            os.execv(sys.executable, [sys.executable, "-c", SHELL, json.dumps([str(word) for word in command])])
        self.shown = ""

    def type(self, text):
        os.write(self._master, text.encode())

    def wait_for(self, text):
        while text not in self.shown:
            try:
                self.shown += os.read(self._master, 4096).decode()
            except OSError as error:
                raise AssertionError(f"{text!r} was not said: {self.shown}") from error

    def close(self):
        """All that was shown."""
        with contextlib.suppress(OSError):  # Linux: the terminal's other end is closed
            while more := os.read(self._master, 4096):
                self.shown += more.decode()
        os.waitpid(self.pid, 0)
        os.close(self._master)
        return self.shown


SHELL = """
import json, os, subprocess, sys, termios
signals = __import__("signal")
signals.signal(signals.SIGINT, signals.SIG_IGN)
tty = os.open("/dev/tty", os.O_RDWR)
code = subprocess.run(json.loads(sys.argv[1]), preexec_fn=lambda: signals.signal(signals.SIGINT, signals.SIG_DFL)).returncode
how = termios.tcgetattr(tty)
how[3] &= ~termios.ICANON
how[6][termios.VMIN] = how[6][termios.VTIME] = 0
termios.tcsetattr(tty, termios.TCSANOW, how)
(at, *_) = (os.ttyname(file) for file in (0, 1, 2) if os.isatty(file))
os.write(tty, f"exit code {code}; typed: {os.read(tty, 100)}; at {at}\\n".encode())
"""
TYPES = """
import fcntl, os, sys, termios
for name in ("/proc/self/fd/0", "/proc/self/fd/1", "/proc/self/fd/2", "/dev/tty", *sys.argv[1:]):
    try:
        fcntl.ioctl(os.open(name, os.O_RDWR), termios.TIOCSTI, b"X")
    except OSError:
        pass
for file in (0, 1, 2):
    try:
        fcntl.ioctl(file, termios.TIOCSTI, b"X")
    except OSError:
        pass
print([os.isatty(file) for file in (0, 1, 2)], *{os.ttyname(file) for file in (0, 1, 2) if os.isatty(file)}, "end")
sys.exit(13)
"""


@AS_ROOT
@each_row("elsewhere", [(), ("stdin",), ("stdout",), ("stderr",)], afresh=[place])
def test_a_command_does_not_type_into_roots_terminal_nor_keep_it_open(place, elsewhere):
    terminal = Terminal(SYSTEMD / "as-user", "nobody", PYTHON, "-c", TYPES, **dict.fromkeys(elsewhere, place / "file"))
    shown = terminal.close()
    found = re.search(r"exit code 13; typed: b''; at (/dev/pts/\d+)", shown)
    assert found, shown
    reported = shown + ((place / "file").read_text() if elsewhere else "")
    (others,) = re.findall(r"(\[\w+, \w+, \w+\] .*)end", reported)
    if elsewhere:
        assert others == "[False, False, False] "
    else:
        assert re.fullmatch(r"\[True, True, True\] /dev/pts/\d+ ", others)
        assert found[1] not in others.split()


@AS_ROOT
def test_ctrl_c_reaches_a_command_at_a_terminal_and_what_it_says_then_is_shown(place):
    code = """
import os, signal, sys
signal.signal(signal.SIGINT, lambda *_: (os.write(1, b"ends\\n"), sys.exit(13)))
os.write(1, b"ready\\n")
while True: signal.pause()
"""
    for redirected in ({}, {"stdin": "/dev/null"}):
        terminal = Terminal(SYSTEMD / "as-user", "nobody", PYTHON, "-c", code, **redirected)
        terminal.wait_for("ready")
        terminal.type("\x03")
        shown = terminal.close()
        assert "ends" in shown
        assert "exit code 13; typed: b''" in shown


def test_without_that_user_nothing_is_run():
    done = as_user("touch", "/nowhere/file", user="no-such-user")
    assert (done.returncode, done.stdout) == (78, "")
    assert done.stderr.startswith("haptic-panel: there is no user no-such-user: install the Debian package")
    assert as_user(user="nobody").returncode == 2


class Installed:
    """The command as it is installed, but for its folder and its users, and a release that anybody may have spoilt."""

    def __init__(self, place):
        self.root = place / "root"
        self.release = self.root / "releases/1.0"
        text = (SYSTEMD / "haptic-panel").read_text()
        self.changed = text
        for before, after in {
            "root=/opt/haptic-panel": f"root={self.root}",
            "/usr/lib/haptic-panel/as-user haptic-update": f"{SYSTEMD / 'as-user'} nobody",
            "/usr/lib/haptic-panel/as-user haptic-panel": f"{SYSTEMD / 'as-user'} daemon",
        }.items():
            assert before in self.changed
            self.changed = self.changed.replace(before, after)
        self.command = place / "haptic-panel"
        self.command.write_text(self.changed)
        self.command.chmod(0o755)
        subprocess.run([PYTHON, "-I", "-m", "venv", "--without-pip", self.release / "venv"], check=True)
        (self.packages,) = self.release.glob("venv/lib/python3*/site-packages")
        (self.packages / "controller").mkdir()
        (self.packages / "controller/__main__.py").write_text("import sys\nprint(sys.argv[1:])\n")
        (self.root / "current").symlink_to("releases/1.0")

    def __call__(self, *arguments, **how):
        return subprocess.run(
            [self.command, *arguments], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL, **how
        )


@pytest.fixture
def installed(place):
    if not Path(PYTHON).exists():
        pytest.skip(f"there is no {PYTHON}")
    return Installed(place)


@AS_ROOT
def test_a_planted_file_of_a_release_never_runs_as_root_whatever_is_called(installed, place):
    seen = place / "seen"
    seen.mkdir()
    seen.chmod(0o777)
    (installed.packages / "planted.pth").write_text(f"import os; open('{seen}/%d' % os.getuid(), 'a').close()\n")
    users = {
        "65534": [("update", step) for step in STEPS],
        "1": [(), ("--version",), ("nonsense",), *((name,) for name in COMMANDS)],
    }
    users["1"].remove(("update",))
    for user, calls in users.items():
        for call in calls:
            done = installed(*call)
            assert (done.returncode, done.stdout) == (0, f"{list(call)}\n"), done.stderr
            assert [path.name for path in seen.iterdir()] == [user], call
            (seen / user).unlink()


def test_others_run_a_release_as_themselves(installed):
    user = {} if os.geteuid() else {"user": 65534, "group": 65534, "extra_groups": []}
    done = installed("status", "--json", **user)
    assert (done.returncode, done.stdout) == (0, "['status', '--json']\n"), done.stderr


@each_row("left", ["the interpreter", "another interpreter", "nothing", "a name for the terminal"], afresh=[place, installed])
def test_a_python_that_moved_on_is_one_line_that_says_what_to_do(installed, left):
    python = installed.release / "venv/bin/python"
    name = installed.packages.parent.name
    python.unlink()
    if left == "the interpreter":  # an environment of /usr/bin/python3, which is another version now
        python.symlink_to("/usr/bin/python3")
        installed.packages.parent.rename(installed.release / "venv/lib/python3.2")
        said = f"was installed for python3.2 and finds {Path(PYTHON).resolve().name}"
    elif left == "another interpreter":
        other = installed.root / "python3.99"
        other.symlink_to("/bin/true")
        python.symlink_to(other)
        said = None  # a link is followed to its end: `true` is no interpreter that has a version
    elif left == "nothing":
        python.symlink_to("/usr/bin/python3.0")
        said = f"was installed for {name} and finds "
    else:
        python.symlink_to("/usr/bin/\x1b[2Jpython3.0")
        installed.packages.parent.rename(installed.release / "venv/lib/python3\x1b[2J")
        said = "was installed for another Python and finds none"
    done = installed("status")
    if said is None:
        assert done.returncode == 0
        return
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (78, "", 1)
    assert done.stderr.startswith(f"haptic-panel: {installed.root}/releases/1.0: {said}")
    assert "install it again, from the Debian package or a checkout (systemd/README.md)" in done.stderr
    assert "\x1b" not in done.stderr


def test_without_a_release_it_says_so(installed):
    (installed.root / "current").unlink()
    done = installed("status")
    assert (done.returncode, done.stderr) == (
        78, f"haptic-panel: {installed.root}/current: no release is in use: install the Debian package again\n",
    )  # fmt: skip


def test_what_systemd_runs_as_root_is_nothing_of_a_release():
    for unit in [*SYSTEMD.glob("*.service"), *SYSTEMD.glob("*.path"), *SYSTEMD.glob("*.timer")]:
        lines = unit.read_text().splitlines()
        is_root = not any(re.match("(User=(?!root|0)|DynamicUser=yes)", line) for line in lines)
        for line in lines:
            if found := re.match(r"Exec\w+=([-@:+!|]*)(.*)", line):
                as_root = is_root or "+" in found[1] or "!" in found[1]
                assert not as_root or re.fullmatch(r"/usr/lib/haptic-panel/fall-back \w+", found[2]), f"{unit.name}: {line}"


def test_what_dpkg_and_udev_run_as_root_is_nothing_of_a_release():
    for script in [*(SYSTEMD / "package/debian").glob("p*"), SYSTEMD / "fall-back", SYSTEMD / "set-touch"]:
        code = "\n".join(re.sub(r"(^|\s)#.*", "", line) for line in script.read_text().splitlines())
        assert not re.search(r"\bpython[0-9.]* |venv/bin/python\"? [^]]|/usr/bin/haptic-panel|-m controller", code), script
    first = (SYSTEMD / "package/install-first-release").read_text()
    assert first.index("as-user haptic-update") < first.index('"$2" -I -m venv') < first.index("-m controller")
    rules = "".join(path.read_text() for path in (SYSTEMD / "udev").iterdir())
    assert "RUN" not in rules
    assert "PROGRAM" not in rules

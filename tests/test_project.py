"""The project as a whole: style, types, layers, layout, and documentation that runs."""

import ast
import re
import shutil
import subprocess
import sys
import tomllib
from collections import Counter
from pathlib import Path

import pytest
from quick import SECONDS, SLOWER
from readme_commands import works
from tables import each_row

ROOT = Path(__file__).parent.parent
TOP_LEVEL = {"pyproject.toml", "controller", "fpga_rtl", "boards", "systemd", "tests", "README.md", "LICENSE"}
TOOLS = Path(sys.executable).parent
MYPY_CACHE = ["--cache-dir", f"{sys.prefix}/mypy_cache"]  # not in the checkout: 20 s of every run but the first
FILES_A_FOLDER = 20
WORKSHOP = ROOT / "controller" / "workshop"  # a device needs none of it


def tracked():
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True)
    return [Path(line) for line in listed.stdout.splitlines()]


@pytest.mark.parametrize(
    "command",
    [
        ["ruff", "check", "--no-cache"],
        ["ruff", "format", "--check", "--no-cache"],
        pytest.param(["mypy", *MYPY_CACHE], marks=pytest.mark.kernel),  # a minute: with what CI runs too
        ["lint-imports", "--no-cache"],
    ],
)
def test_style_types_and_layers(command):
    if command[0] == "mypy" and sys.version_info[:2] != (3, 11):
        pytest.skip("types are those of the packages that Python 3.11 gets: the oldest, and Debian 12's")
    done = subprocess.run([TOOLS / command[0], *command[1:]], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_no_code_is_left_that_nothing_uses():
    """Tests do not count as use. Fields are left out: records go by name through TOML, JSON and `asdict`."""
    from vulture import Vulture

    settings = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["vulture"]
    found = Vulture(ignore_names=settings["ignore_names"], ignore_decorators=settings["ignore_decorators"])
    found.scavenge([ROOT / path for path in settings["paths"]])
    lines = {path: path.read_text().splitlines() for path in (ROOT / "controller").rglob("*.py")}
    unused = [
        item.get_report()
        for item in found.get_unused_code()
        if item.typ not in {"attribute", "variable"} or not lines[item.filename][item.first_lineno - 1][0].isspace()
    ]
    assert not unused, "\n".join(unused)
    text = "\n".join(line for file in lines.values() for line in file)
    stale = [name for name in settings["ignore_names"] if "*" not in name and not re.search(rf"\b{name}\b", text)]
    assert not stale, f"excepted in pyproject.toml, and not there any more: {stale}"


def test_the_map_of_the_rooms_is_that_of_the_contracts():
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]["contracts"]
    sections = re.split(r"^##+ ", (ROOT / "controller" / "README.md").read_text(), flags=re.MULTILINE)
    layers = [contract for contract in contracts if contract["type"] == "layers"]
    for contract, heading in zip(layers, ("The hall", "The device wing", "The workshop"), strict=True):
        rows = {name: row for row, names in enumerate(reversed(contract["layers"]), 1) for name in re.findall(r"\w+", names)}
        (section,) = [section for section in sections if section.startswith(f"{heading}\n")]
        lines = re.findall(r"^\| (`.*?) \| (\d+) \| (.*) \|$", section, re.MULTILINE)
        assert {name: int(row) for names, row, _ in lines for name in re.findall(r"`(\w+)/?`", names)} == rows
        folder = ROOT / contract["containers"][0].replace(".", "/")
        for names, _, holds in lines:
            room = folder / re.findall(r"`(\w+)/?`", names)[0]
            missing = [name for name in re.findall(r"`(\w+)`", holds) if room.is_dir() and not any(room.rglob(f"{name}.py"))]
            assert not missing, f"{names}: {missing}"


def test_no_folder_of_the_package_has_more_than_20_files():
    """Of any kind; `decisions` is a series, one page each."""
    in_folder = Counter(path.parent for path in tracked() if path.parts[0] == "controller")
    del in_folder[Path("controller/decisions")]
    assert in_folder[Path("controller/device/scene")] > 10
    assert {str(folder): count for folder, count in in_folder.items() if count > FILES_A_FOLDER} == {}


def test_the_way_of_a_touch_names_functions_that_are_there():
    text = (ROOT / "controller" / "README.md").read_text()
    named = re.findall(r"\[([\w/]+\.py)\]\(\1\) `([\w.]+)`", text)
    assert len(named) > 15
    for file, name in named:
        inside = ast.parse((ROOT / "controller" / file).read_text())
        for part in name.split("."):
            (inside,) = [node for node in inside.body if getattr(node, "name", None) == part] or [None]
            assert inside, f"{file}: {name}"


def test_what_the_quick_form_leaves_out_is_there():
    assert all((ROOT / "tests" / name).exists() for name in SLOWER)
    text = "\n".join(file.read_text() for file in (ROOT / "tests").rglob("test_*.py"))
    assert not [name for name in SECONDS if f"def {name}(" not in text]


def test_the_top_level_is_the_customers():
    if not (ROOT / ".git").exists() or not shutil.which("git"):
        pytest.skip("not a git checkout")
    names = {path.parts[0] for path in tracked()}
    assert {name for name in names if not name.startswith(".")} == TOP_LEVEL


def test_device_code_needs_nothing_of_the_offline_extra():
    """Imported in a process in which the packages of the extra cannot be found."""
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    only_offline = set(extras["offline"]) - set(extras["page"])  # the bridge to browsers is shown offline, too
    banned = sorted(re.match(r"\w+", requirement)[0] for requirement in only_offline)
    assert "scipy" in banned
    modules = [
        ".".join(path.relative_to(ROOT).with_suffix("").parts)
        for path in sorted((ROOT / "controller").rglob("*.py"))
        if not path.is_relative_to(WORKSHOP) and path.name != "__init__.py"
    ]
    code = (
        f"import sys, importlib\nfor name in {banned}: sys.modules[name] = None\n"
        f"for name in {modules}: importlib.import_module(name)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_command_line_begins_without_any_driver_or_offline_tool():
    """Each is imported where it is opened: a computer that builds banks has no drivers, a device no offline tools."""
    banned = ["spidev", "gpiod", "evdev", "smbus2", "serial", "cobs", "scipy", "matplotlib", "tqdm", "threadpoolctl"]
    code = f"import sys, controller.cli\nsys.exit(str([name for name in {banned} if name in sys.modules] or ''))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.stderr.strip() == ""


def test_no_code_of_the_device_reads_the_clock_of_the_day():
    """It may be set at any time: panels stamp their events, and the loop reads its time, by CLOCK_MONOTONIC."""
    for path in (ROOT / "controller").rglob("*.py"):
        if path.is_relative_to(WORKSHOP) or "update" in path.parts:  # what is signed expires on a date
            continue
        if path.name in {"expectation.py", "expected.py"}:  # the age of a bank, in days
            continue
        for node in ast.walk(ast.parse(path.read_text())):
            name = ast.unparse(node) if isinstance(node, ast.Attribute) else ""
            assert name not in {"time.time", "time.time_ns", "time.localtime", "time.gmtime", "time.CLOCK_REALTIME"}, path
            assert not (isinstance(node, ast.Import | ast.ImportFrom) and "datetime" in ast.unparse(node)), path


def test_every_public_name_says_what_it_is():
    """What ruff's D1 does not see: module docstrings are more than a word."""
    for path in (ROOT / "controller").rglob("*.py"):
        docstring = ast.get_docstring(ast.parse(path.read_text()))
        assert docstring, path
        assert len(docstring.split()) > 3, path


@pytest.mark.kernel
def test_every_command_of_every_readme_but_run_works(tmp_path, state_folder):
    assert "$ .venv/bin/haptic-panel bank build" in works(tmp_path, state_folder / "gateware", "sh", "others")


@pytest.mark.slow
def test_every_slow_command_of_every_readme_works(tmp_path, state_folder):
    assert "$ .venv/bin/haptic-panel benchmark" in works(tmp_path, state_folder / "gateware", "sh slow")


def test_the_four_lines_of_the_readme_are_short_and_whole():
    lines = [line for line in (ROOT / "README.md").read_text().splitlines() if "set_up.sh" in line and not line.startswith("`")]
    assert lines == [
        "sh controller/set_up.sh offline && .venv/bin/haptic-panel run",
        "sh controller/set_up.sh test && .venv/bin/pytest",
        "sh controller/set_up.sh test && .venv/bin/pytest -m gateware",
        "sh controller/set_up.sh test && .venv/bin/pytest -m kernel",
    ]


def set_up(folder, extra, missing=False, user=0, programs=("apt-get", "sudo")):
    """Lines that `set_up.sh` prints, with `dpkg-query`, `apt-get` and Python replaced by programs that print their calls."""
    said = "#!/bin/sh\necho $(basename $0) $@\n"
    own = {
        "dpkg-query": missing if isinstance(missing, str) else f"#!/bin/sh\necho {'config-files' if missing else 'installed'}\n",
        "id": f"#!/bin/sh\necho {user}\n",
        "python3": said,
    }
    for name, text in (own | dict.fromkeys(programs, said)).items():
        (folder / "bin").mkdir(exist_ok=True)
        (folder / "bin" / name).write_text(text)
        (folder / "bin" / name).chmod(0o755)
    for name in ("sh", "basename", "dirname"):
        (folder / "bin" / name).symlink_to(shutil.which(name))
    (folder / "controller").mkdir()
    shutil.copy(ROOT / "controller" / "set_up.sh", folder / "controller")
    (folder / ".venv" / "bin").mkdir(parents=True)
    (folder / ".venv" / "bin" / "pip").write_text(said)
    (folder / ".venv" / "bin" / "pip").chmod(0o755)
    command = ["sh", folder / "controller" / "set_up.sh", *extra]
    return subprocess.run(command, env={"PATH": str(folder / "bin")}, capture_output=True, text=True, check=False)


@each_row(
    ("user", "prefix", "extra", "more"),
    [
        (0, "", "offline", ""),
        (1000, "sudo ", "test", " iverilog liblz4-dev strace zlib1g-dev"),
        (0, "", "test,gateware", " iverilog liblz4-dev strace zlib1g-dev ngspice"),
    ],
)
def test_what_is_missing_is_installed_and_then_the_package_into_venv(tmp_path, user, prefix, extra, more):
    done = set_up(tmp_path, [extra], missing=True, user=user)
    first, *lines = done.stdout.splitlines()
    assert (done.returncode, done.stderr) == (0, "")
    assert "minutes" in first
    assert "MB" in first
    assert lines == [
        f"{prefix}apt-get update -q",
        f"{prefix}apt-get install -y -q --no-install-recommends build-essential python3-dev python3-venv{more}",
        "python3 -m venv .venv",
        f"pip install --disable-pip-version-check -e .[{extra}]",
    ]


def test_nothing_is_asked_of_apt_where_nothing_is_missing(tmp_path):
    assert "apt-get" not in set_up(tmp_path, ["test"]).stdout


@pytest.mark.parametrize("sudo", [None, "#!/bin/sh\nexit 1\n"])
def test_who_may_install_nothing_gets_one_line_with_what_to_ask_the_administrator_for(tmp_path, sudo):
    """There is no sudo, or it refuses; half of the packages are there."""
    (tmp_path / "bin").mkdir()
    if sudo:
        (tmp_path / "bin" / "sudo").write_text(sudo)
        (tmp_path / "bin" / "sudo").chmod(0o755)
    there = "#!/bin/sh\ncase $4 in python3-*) echo installed ;; *) exit 1 ;; esac\n"
    done = set_up(tmp_path, ["test"], missing=there, user=1000, programs=("apt-get",))
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert (
        "ask the administrator for: apt-get install build-essential iverilog liblz4-dev strace zlib1g-dev; then call this again"
        in done.stderr
    )
    assert "pip install" not in done.stdout


def test_a_system_without_apt_is_informed_what_is_needed(tmp_path):
    done = set_up(tmp_path, ["offline"], programs=())
    assert "no apt-get here; needed are a C compiler" in done.stderr
    assert done.stdout.endswith("pip install --disable-pip-version-check -e .[offline]\n")


@each_row("extra", [[], ["tests"], ["docs"]])
def test_set_up_without_a_known_extra_says_which_there_are(tmp_path, extra):
    done = set_up(tmp_path, extra)
    assert done.returncode == 2
    assert "usage: sh controller/set_up.sh offline | test" in done.stderr
    assert done.stdout == ""


def anchors(path):
    """Those that a page's host makes of its headings."""
    headings = re.findall(r"^#+ (.*)$", path.read_text(), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def test_every_link_of_every_page_leads_somewhere():
    broken = []
    for page in (page for page in ROOT.rglob("*.md") if not any(part.startswith(".") for part in page.relative_to(ROOT).parts)):
        for link in re.findall(r"\]\(([^)\s]+)\)", page.read_text()):
            place, _, anchor = link.partition("#")
            target = page.parent / place if place else page
            if not re.match(r"\w+:", link) and not (target.exists() and (not anchor or anchor in anchors(target))):
                broken.append(f"{page}: {link}")
    assert not broken


def test_no_cell_of_a_table_is_longer_than_250_characters():
    long = [
        f"{page}: {cell.strip()[:60]}"
        for page in tracked()
        if page.suffix == ".md"
        for line in (ROOT / page).read_text().splitlines()
        if line.startswith("|")
        for cell in line.split("|")
        if len(cell.strip()) > 250
    ]
    assert not long


def test_no_line_that_is_shown_installs_by_a_name_that_may_be_a_strangers():
    """The registry's `haptic-panel` need not be ours: always a folder, a wheel, or others' well-known packages."""
    shown = [path for room in ("controller", "boards", "systemd", "fpga_rtl") for path in (ROOT / room).rglob("*")]
    for path in [ROOT / "README.md", *shown]:
        if path.suffix in (".py", ".md", ".sh", ".service"):
            assert not re.search(r"pip install[^\n]*['\" ]haptic-panel", path.read_text()), path

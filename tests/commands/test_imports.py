"""What a process imports: time at the start of each command, by counting modules and not by a clock."""

import json
import subprocess
import sys

import pytest
from tables import each_row

HEAVY = {"numpy", "asyncio", "scipy", "matplotlib", "msgspec", "importlib.metadata"}
LOADED = "import atexit, json, sys; atexit.register(lambda: open({!r}, 'w').write(json.dumps(sorted(sys.modules))))"


@pytest.fixture
def imported(tmp_path):
    """Modules that a program has imported at its end; its arguments are those of the command line."""

    def run(program, *arguments, code=0):
        listed = tmp_path / "modules.json"
        whole = f"{LOADED.format(str(listed))}\n{program}"
        done = subprocess.run([sys.executable, "-c", whole, *arguments], capture_output=True, text=True, check=False)
        assert done.returncode == code, done.stderr
        return set(json.loads(listed.read_text()))

    return run


START = {"", "cli", "console", "errors", "log", "commands", "commands.common", "commands.common.arguments"}
CLI = "from controller.cli import main; sys.exit(main(sys.argv[1:]))"


@each_row(("arguments", "code"), [(["--version"], 0), (["--help"], 0), ([], 2), (["dance"], 2), (["completion", "bash"], 0)])
def test_what_needs_no_board_imports_next_to_nothing(imported, arguments, code):
    modules = imported(CLI, *arguments, code=code)
    assert not HEAVY & modules
    ours = {name.removeprefix("controller").removeprefix(".") for name in modules if name.partition(".")[0] == "controller"}
    assert ours - {f"commands.{arguments[0]}" for _ in arguments[:1]} <= START


def test_the_client_needs_neither_numpy_nor_a_board(imported):
    run = "import runpy; runpy.run_module('controller.device.application_socket.client', run_name='__main__')"
    modules = imported(run, "--help")
    assert not (HEAVY - {"msgspec"}) & modules
    rooms = ("controller.device.board", "controller.device.loop", "controller.device.bank")
    assert not {name for name in modules if name.startswith(rooms)}


def test_a_device_starts_without_what_only_other_computers_need(imported):
    modules = imported(
        "import controller.commands.run, controller.device.service.run, controller.device.service.beside_loop, "
        "controller.device.fpga.links.spi_link, controller.device.fpga.links.serial_link, "
        "controller.device.touch.drivers.event_device"
    )
    assert {"numpy", "evdev", "spidev"} <= modules
    needless = HEAVY - {"numpy", "msgspec"} | {"_hashlib", "platformdirs", "controller.device.touch.recordings.replay"}
    assert not needless & (modules - imported("import numpy")), "an old NumPy imports some of them itself"
    assert not {name for name in modules if name.startswith("controller.workshop")}


def test_evdev_is_whole_without_asyncio_and_who_wants_its_asyncio_reader_gets_it(imported):
    reading = "from controller.device.touch.drivers.evdev_library import evdev; evdev.InputDevice, evdev.UInput, evdev.list_devices"
    assert "asyncio" not in imported(reading)
    assert "asyncio" in imported(f"{reading}; import evdev.eventio_async")
    assert "asyncio" in imported(f"import evdev; {reading}")


def test_an_evdev_that_has_no_plain_reader_is_imported_as_it_is(imported, tmp_path):
    package = tmp_path / "evdev"
    package.mkdir()
    (package / "__init__.py").write_text("from .eventio_async import EventIO\n")
    (package / "eventio_async.py").write_text("import asyncio\nEventIO = asyncio.Future\n")
    assert "asyncio" in imported(
        f"sys.path.insert(0, {str(tmp_path)!r}); from controller.device.touch.drivers.evdev_library import evdev; evdev.EventIO"
    )

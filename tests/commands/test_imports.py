"""What a process imports: time at the start of each command, by counting modules and not by a clock."""

import json
import subprocess
import sys

import pytest

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


CLI = "from controller.cli import main; sys.exit(main(sys.argv[1:]))"


@pytest.mark.parametrize(
    ("arguments", "code"), [(["--version"], 0), (["--help"], 0), ([], 2), (["dance"], 2), (["completion", "bash"], 0)]
)
def test_what_needs_no_board_imports_next_to_nothing(imported, arguments, code):
    modules = imported(CLI, *arguments, code=code)
    assert not HEAVY & modules
    assert len([name for name in modules if name.startswith("controller")]) <= 7  # cli, errors, log; a command that was named


def test_the_client_needs_neither_numpy_nor_a_board(imported):
    modules = imported("import runpy; runpy.run_module('controller.application_socket.client', run_name='__main__')", "--help")
    assert not (HEAVY - {"msgspec"}) & modules
    assert not {name for name in modules if name.startswith(("controller.board", "controller.loop", "controller.bank"))}


def test_a_device_starts_without_what_only_other_computers_need(imported):
    modules = imported(
        "import controller.commands.run, controller.service.run, controller.service.beside_loop, controller.fpga.spi_link, "
        "controller.fpga.serial_link, controller.touch.linux_input"
    )
    assert {"numpy", "evdev", "spidev"} <= modules
    assert not (HEAVY - {"numpy", "msgspec"} | {"_hashlib", "platformdirs", "controller.touch.replay"}) & modules
    aside = ("controller.gateware_model", "controller.physics", "controller.simulation", "controller.bank_builder")
    assert not {name for name in modules if name.startswith(aside)}


def test_evdev_is_whole_without_asyncio_and_who_wants_its_asyncio_reader_gets_it(imported):
    reading = "from controller.touch.evdev_library import evdev; evdev.InputDevice, evdev.UInput, evdev.list_devices"
    assert "asyncio" not in imported(reading)
    assert "asyncio" in imported(f"{reading}; import evdev.eventio_async")
    assert "asyncio" in imported(f"import evdev; {reading}")


def test_an_evdev_that_has_no_plain_reader_is_imported_as_it_is(imported, tmp_path):
    package = tmp_path / "evdev"
    package.mkdir()
    (package / "__init__.py").write_text("from .eventio_async import EventIO\n")
    (package / "eventio_async.py").write_text("import asyncio\nEventIO = asyncio.Future\n")
    assert "asyncio" in imported(
        f"sys.path.insert(0, {str(tmp_path)!r}); from controller.touch.evdev_library import evdev; evdev.EventIO"
    )

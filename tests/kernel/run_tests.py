"""Runs the `test_*` functions of files one after another and prints one line for each: what a guest or a container does.

All files are imported once, before any test runs; then each has a process of its own, a copy of this one. What a file has started
ends with it, and what it has plugged in is unplugged, so that files that share a machine do not meet. A file's `setup_module`
and `teardown_module` are called in its own process.

usage: run_tests.py [--slow] FILE...     exit code: 0 if all passed; --slow: tests of slow_form.py too
"""

import contextlib
import faulthandler
import importlib.util
import os
import signal
import sys
import threading
import time
import traceback
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from gpio_lines import unplug_all
from patience import Patience

LONGEST_S = 900.0  # that a test may have to spare without an end; then the stacks of all threads are shown and nothing more is run


def load(path):
    """The module of a file; files beside it can be imported by name."""
    sys.path.insert(0, str(path.parent))
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module
    spec.loader.exec_module(module)
    return module


def end_if_it_hangs(ended):
    """Wait for the end of a test, or end all."""
    patience = Patience(LONGEST_S)
    while not ended.wait(1.0):
        if patience.over:
            faulthandler.dump_traceback(file=sys.stdout)
            os._exit(1)


def run(label, test):
    """Whether a test passed; an exception of any kind is its failure."""
    ended = threading.Event()
    threading.Thread(target=end_if_it_hangs, args=(ended,), daemon=True).start()
    started_s = time.monotonic()
    try:
        with contextlib.redirect_stderr(sys.stdout):
            test()
    except BaseException:
        print(traceback.format_exc(), end="")
        print(f"FAILED {label}", flush=True)
        return False
    finally:
        ended.set()
    print(f"PASSED {label} {time.monotonic() - started_s:.2f} s", flush=True)
    return True


def loaded(path):
    """The module of a file, or None: then what is wrong with it is printed."""
    try:
        return load(path)
    except BaseException:
        print(traceback.format_exc(), end="")
        print(f"FAILED {path.name}", flush=True)
        return None


def run_all(module, slow):
    """Run the tests of a module; whether all passed."""
    name = Path(module.__file__).name
    if prepare := getattr(module, "setup_module", None):
        prepare()
    tests = [(called, test) for called, test in list(vars(module).items()) if called.startswith("test_")]
    results = [run(f"{name}::{called}", test) for called, test in tests if slow or not getattr(test, "slow", False)]
    if put_away := getattr(module, "teardown_module", None):
        put_away()
    print(f"{name}: {sum(results)} passed, {len(results) - sum(results)} failed", flush=True)
    return bool(results) and all(results)


def run_apart(module, slow):
    """Run the tests of a module in a process of its own, and end all that they have started; whether all passed."""
    sys.stdout.flush()
    if (process := os.fork()) == 0:
        code = 1
        try:
            os.setsid()
            code = 0 if run_all(module, slow) else 1
        except BaseException:
            print(traceback.format_exc(), end="")
        finally:
            sys.stdout.flush()
            os._exit(code)  # a thread that a failed test has left behind must not keep it up
    passed = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]) == 0
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process, signal.SIGKILL)
    unplug_all()
    return passed


def main():
    """Run all; the exit code."""
    slow = "--slow" in sys.argv
    modules = [loaded(path) for path in map(Path, sys.argv[1:]) if str(path) != "--slow"]
    results = [module is not None and run_apart(module, slow) for module in modules]
    return 0 if results and all(results) else 1


if __name__ == "__main__":
    sys.exit(main())

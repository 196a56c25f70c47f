"""Runs the `test_*` functions of files one after another and prints one line for each: what a guest or a container does.

usage: run_tests.py FILE...     exit code: 0 if all passed
"""

import contextlib
import faulthandler
import importlib.util
import os
import sys
import threading
import time
import traceback
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from patience import Patience

LONGEST_S = 300.0  # that a test may have to spare without an end; then the stacks of all threads are shown and nothing more is run


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


def main():
    """Run all; the exit code."""
    results = []
    for path in map(Path, sys.argv[1:]):
        try:
            module = load(path)
        except BaseException:
            print(traceback.format_exc(), end="")
            print(f"FAILED {path.name}", flush=True)
            results.append(False)
            continue
        results += [run(f"{path.name}::{name}", test) for name, test in list(vars(module).items()) if name.startswith("test_")]
    print(f"{sum(results)} passed, {len(results) - sum(results)} failed", flush=True)
    return 0 if results and all(results) else 1


if __name__ == "__main__":
    code = main()
    sys.stdout.flush()
    os._exit(code)  # a thread that a failed test has left behind must not keep the guest up

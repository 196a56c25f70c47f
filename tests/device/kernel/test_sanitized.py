"""The compiled kernel reads and writes nothing beyond its buffers, and does nothing that C leaves undefined."""

import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest
from compiled_kernels import COMPILED

SOURCE = Path(__file__).parents[3] / "controller/device/kernel/kernel.c"
RUNNER = """
import importlib.util, sys
import pytest
for name, path in zip(["_kernel", "_kernel_avx2"], sys.argv[1].split(":")):
    spec = importlib.util.spec_from_file_location(f"controller.device.kernel.{name}", path)
    sys.modules[f"controller.device.kernel.{name}"] = importlib.util.module_from_spec(spec)
sys.exit(pytest.main(["-q", "-s", *sys.argv[2:]]))
"""


@pytest.mark.slow
def test_under_the_sanitizers_of_addresses_and_of_undefined_behaviour(tmp_path):
    compiler = next((name for name in ("gcc", "clang") if shutil.which(name)), None)
    if compiler is None:
        pytest.skip("no C compiler")
    wide = ["-mavx2", "-DFOR_AVX2"]
    options = ["-std=gnu11", "-O1", "-g", "-ffp-contract=off", "-fno-math-errno", "-shared", "-fPIC", "-DPy_LIMITED_API=0x030B0000"]
    sanitizers = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    headers = sysconfig.get_path("include")
    libraries = []
    for number, kind in enumerate(([], wide)[: len(COMPILED)]):
        libraries.append(str(tmp_path / f"{number}.so"))
        subprocess.run([compiler, *options, *sanitizers, *kind, f"-I{headers}", SOURCE, "-o", libraries[-1]], check=True)
    runtime = subprocess.run([compiler, "-print-file-name=libasan.so"], capture_output=True, text=True, check=True).stdout.strip()
    environment = os.environ | {"LD_PRELOAD": runtime, "ASAN_OPTIONS": "detect_leaks=0", "PYTHONMALLOC": "malloc"}
    tests = [str(Path(__file__).with_name(name)) for name in ("test_compose.py", "test_null_places.py", "test_compiled_frames.py")]
    command = [sys.executable, "-c", RUNNER, ":".join(libraries), *tests]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, cwd=SOURCE.parents[2])
    assert run.returncode == 0, run.stdout[-4000:] + run.stderr[-4000:]
    assert " passed" in run.stdout
    assert "skipped" not in run.stdout

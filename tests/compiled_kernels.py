"""What kernel.c was compiled to, each as a module: for every processor, and for AVX2 where this one has it."""

import importlib

import pytest


def found():
    """The modules; none where the package was built without a C compiler."""
    try:
        narrow = importlib.import_module("controller.device.kernel._kernel")
    except ImportError:
        return []
    return [narrow, *([importlib.import_module("controller.device.kernel._kernel_avx2")] if narrow.HAS_AVX2 else [])]


COMPILED = found()
needs_compiled = pytest.mark.skipif(not COMPILED, reason="built without a C compiler")

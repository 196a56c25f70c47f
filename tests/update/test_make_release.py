"""Releases: the same bytes for the same inputs, from what is locked, and nothing that does not fit."""

import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from controller.update.lock_file import BUILT, Target, read_lock, wanted

ROOT = Path(__file__).parents[2]
LOCK = ROOT / "systemd" / "requirements.lock"


def locked(file=LOCK):
    return {one.name: one for one in read_lock(file)} | {one.name: one for one in wanted(read_lock(file), Target("x86_64", 11))}


def test_the_lock_file_has_what_pyproject_asks_for():
    """Names and ranges; made anew by systemd/make_lock_files.sh."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"]
    asked = [Requirement(text) for text in [*project["dependencies"], *extras["update"], *extras["watch"], "pip"]]
    packages = locked()
    for one in asked:
        (version,) = packages[canonicalize_name(one.name)].requirement.specifier
        assert one.specifier.contains(version.version), one
    assert {canonicalize_name(one.name) for one in asked} | {"securesystemslib"} == set(packages)  # tuf needs it
    assert set(packages) >= BUILT


def test_no_registry_is_named_in_the_lock_files():
    for name in ("requirements.lock", "build.lock"):
        text = (ROOT / "systemd" / name).read_text()
        assert "://" not in text
        assert "--index" not in text


@pytest.mark.parametrize("architecture", ["x86_64", "aarch64"])
def test_tags_of_a_platform(architecture):
    tags = list(map(str, Target.of(f"{architecture}-cp311").tags()))
    assert tags[0] == f"cp311-cp311-manylinux_2_36_{architecture}"
    assert f"cp311-abi3-linux_{architecture}" in tags
    assert "py3-none-any" in tags
    assert not any("manylinux_2_37" in tag or "musl" in tag for tag in tags)

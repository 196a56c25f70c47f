"""Every generated file is committed as it is made, and a slip in its source leaves all files as they were."""

import pytest
from tables import each_row

from controller import generate
from controller.generate import GENERATORS, ROOT, differing, made, main

BY_VERSION = {"command-line"}  # its line breaks depend on the version of Python: tests/commands/test_shell_files.py


@each_row("name", sorted(set(GENERATORS) - BY_VERSION))
def test_what_is_committed_is_what_is_generated(name):
    """Else: `python -m controller.generate`."""
    texts = made(ROOT, [name])
    assert texts
    assert list(differing(texts)) == []


@pytest.fixture
def two(tmp_path, monkeypatch):
    """Two generators of one file each, in a folder where the second is missing."""
    monkeypatch.setattr(generate, "GENERATORS", {name: lambda root, name=name: {root / name: f"{name} µ\n"} for name in "ab"})
    (tmp_path / "a").write_text("old\n")
    return tmp_path


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_a_check_names_what_differs_and_writes_nothing(two, capsys):
    assert main(["--check"], two) == 1
    assert capsys.readouterr().out == f"{two / 'a'}: differs from its source\n{two / 'b'}: differs from its source\n"
    assert names(two) == ["a"]
    assert (two / "a").read_text() == "old\n"


def test_what_differs_is_written_once(two, capsys):
    assert main([], two) == 0
    assert capsys.readouterr().out == f"{two / 'a'}: written\n{two / 'b'}: written\n"
    assert (two / "a").read_bytes() == "a µ\n".encode()
    assert names(two) == ["a", "b"]
    assert main(["--check"], two) == 0
    assert main([], two) == 0
    assert capsys.readouterr().out == ""


def test_one_can_be_asked_for(two):
    assert main(["b"], two) == 0
    assert (two / "a").read_text() == "old\n"
    assert names(two) == ["a", "b"]


@pytest.mark.parametrize("slip", [ValueError("the docstring of Board does not describe name"), OSError("gone")])
def test_a_slip_leaves_every_file_as_it_was(two, monkeypatch, capsys, slip):
    def slipped(_root):
        raise slip

    monkeypatch.setitem(generate.GENERATORS, "b", slipped)
    assert main([], two) == 2
    assert capsys.readouterr().err == f"haptic-panel: b: {slip}\n"
    assert names(two) == ["a"]
    assert (two / "a").read_text() == "old\n"


def test_what_is_not_generated_is_refused(two, capsys):
    assert main(["c"], two) == 2
    assert "'c' is not generated; there are a, b" in capsys.readouterr().err

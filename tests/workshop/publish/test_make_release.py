"""Releases: the same bytes for the same inputs, from what is locked, and nothing that does not fit."""

import base64
import hashlib
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import msgspec
import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from tables import each_row
from tiny_release import wheel

from controller.cli import main
from controller.commands.update import make_release as update_make_release
from controller.device.bank import lookup as bank_lookup
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.fpga.bitstreams.bitstream import Identity, sealed
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.build_parameters import top_parameters
from controller.device.update.download.bank_index import read_index
from controller.workshop.bank_builder.own_bank import Order as BankOrder
from controller.workshop.publish.lock_file import BUILT, Target, read_lock, wanted
from controller.workshop.publish.release_folder import read_release

ROOT = Path(__file__).parents[3]
LOCK = ROOT / "systemd" / "requirements.lock"


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A folder with wheels, lock files of them, and a board; releases are made in it."""
    (tmp_path / "wheels").mkdir()
    (tmp_path / "systemd").mkdir()
    file, data = wheel("tiny", about="License: Apache 2.0\nClassifier: License :: OSI Approved :: Apache Software License\n")
    (tmp_path / "wheels" / file).write_bytes(data)
    line = f"tiny==1.0 \\\n    --hash=sha256:{hashlib.sha256(data).hexdigest()}\n    # via elsewhere\n"
    (tmp_path / "systemd/requirements.lock").write_text(f"# made\n{line}")
    own_wheel(tmp_path, workshop=True)
    (tmp_path / "systemd/build.lock").touch()
    (tmp_path / "fpga_rtl").symlink_to(ROOT / "fpga_rtl")
    monkeypatch.setattr(update_make_release, "data_folder", tmp_path.joinpath)
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    return tmp_path


def own_wheel(place, *, workshop):
    """This project's wheel, as --wheels has it: the workshop is for simulated boards alone."""
    file, data = wheel(
        "haptic_panel", code='__version__ = "1.0"\n', module="controller/__init__.py", about="License-Expression: MIT\n"
    )
    (place / "wheels" / file).write_bytes(data)
    if workshop:
        with zipfile.ZipFile(place / "wheels" / file, "a") as files:
            files.writestr(zipfile.ZipInfo("controller/workshop/__init__.py"), b"")


def make(place, out, *more):
    words = [place / out, "--version", "1.0.0", "--counter", 1, "--wheels", place / "wheels", *more]
    return main(["update", "make-release", *map(str, words)])


def contents(folder):
    return {
        str(path.relative_to(folder)): (path.stat().st_mode, path.stat().st_mtime, path.read_bytes() if path.is_file() else None)
        for path in [folder, *folder.rglob("*")]
    }


def test_the_same_inputs_make_the_same_bytes_whoever_makes_them(place, bank_file, monkeypatch):
    assert make(place, "a", "--board", "simulated", "--bank", bank_file) == 0
    monkeypatch.setenv("TZ", "Pacific/Auckland")
    (place / "deep").mkdir()
    before = os.umask(0o077)
    try:
        assert make(place, "deep/b", "--board", "simulated", "--bank", bank_file) == 0
    finally:
        os.umask(before)
    assert contents(place / "a") == contents(place / "deep/b")
    manifest = read_release(place / "a")
    board = load_board(find_board("simulated"))
    assert manifest.boards == {"simulated": board.digest().hex()}
    assert manifest.built_s == 1_700_000_000
    paths = {file.path for file in manifest.files}
    assert {"wheels/tiny-1.0-py3-none-any.whl", "wheels/haptic_panel-1.0.0-py3-none-any.whl", "sbom.cdx.json"} <= paths
    assert {f"boards/simulated/{path.name}" for path in board.folder.iterdir()} <= paths
    bank = next(file for file in manifest.files if file.path == "banks/simulated.bank")
    index = read_index((place / "a" / bank.index_target).read_bytes(), "index")
    assert index.size_bytes == bank_file.stat().st_size
    assert sum(1 for _ in index) > 100


def test_banks_of_several_fpgas_go_together_and_are_played_together(place, capsys, monkeypatch):
    board = load_board(find_board("simulated_64"))
    board = msgspec.structs.replace(board, bank=msgspec.structs.replace(board.bank, pitch_mm=12.0, coarse=True))
    first = place / "own.bank"
    BankOrder(board, 12e-3).build(first, progress=False)
    assert make(place, "a", "--board", "simulated_64", "--bank", first) == 0
    paths = {file.path for file in read_release(place / "a").files}
    assert {"banks/simulated_64.bank", "banks/simulated_64.fpga1.bank"} <= paths
    monkeypatch.setattr(bank_lookup, "running_release", lambda: place / "a")
    found = bank_lookup.find_bank(board)
    assert found.of_release
    with Bank.open(found.path, board) as bank:
        assert len(bank.others) == 1
    (place / "own.fpga1.bank").unlink()
    capsys.readouterr()
    assert make(place, "b", "--board", "simulated_64", "--bank", first) == 78
    assert re.fullmatch(r"haptic-panel: .*own\.fpga1\.bank: cannot be read .*\n", capsys.readouterr().err)


def test_one_version_is_informed_wherever_one_is_reported(place, bank_file):
    assert make(place, "a", "--board", "simulated", "--bank", bank_file) == 0
    (own,) = (place / "a/wheels").glob("haptic_panel-*.whl")
    with zipfile.ZipFile(own) as files:
        assert files.read("controller/__init__.py") == b'__version__ = "1.0.0"\n'
        assert b"\nVersion: 1.0.0\n" in files.read("haptic_panel-1.0.0.dist-info/METADATA")
        rows = dict(line.split(",", 1) for line in files.read("haptic_panel-1.0.0.dist-info/RECORD").decode().splitlines())
        assert set(rows) == set(files.namelist())
        digest = base64.urlsafe_b64encode(hashlib.sha256(files.read("controller/__init__.py")).digest()).rstrip(b"=").decode()
        assert rows["controller/__init__.py"] == f"sha256={digest},22"
    bill = json.loads((place / "a/sbom.cdx.json").read_bytes())
    assert (bill["metadata"]["component"]["name"], bill["metadata"]["component"]["version"]) == ("haptic-panel", "1.0.0")
    subprocess.run(
        [sys.executable, "-m", "pip", "install", "-q", "--no-deps", "--no-index", "--target", place / "to", own], check=True
    )
    assert "haptic_panel-1.0.0.dist-info" in {path.name for path in (place / "to").iterdir()}, "pip takes it"


def test_the_bill_has_licences_and_every_file(place, bank_file):
    assert make(place, "a", "--board", "simulated", "--bank", bank_file) == 0
    bill = json.loads((place / "a/sbom.cdx.json").read_bytes())
    main, parts = bill["metadata"]["component"], {part["name"]: part for part in bill["components"]}
    assert [one["expression"] for one in main["licenses"]] == ["MIT"]
    assert parts["tiny"]["licenses"] == [{"license": {"name": "Apache Software License"}}]
    for file in read_release(place / "a").files:
        named = {"wheels/tiny-1.0-py3-none-any.whl": parts["tiny"], "wheels/haptic_panel-1.0.0-py3-none-any.whl": main}
        if file.path != "sbom.cdx.json":
            part = named.get(file.path) or parts[file.path]
            assert part["hashes"] == [{"alg": "SHA-256", "content": file.sha256}], file.path
    reported = {one["name"]: one["value"] for one in parts["banks/simulated.bank"]["properties"]}
    assert reported["haptic-panel:creator"].startswith("haptic-panel ")
    assert "model" in reported["haptic-panel:responses"]


@each_row("version", ["spring", "1.0-beta", "01.0", "1.0\n", "v1"], afresh=[place])
def test_a_version_that_no_wheel_can_have_is_refused(place, version, capsys):
    assert make(place, "a", "--version", version) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert not (place / "a").exists()


def test_what_does_not_fit_is_refused_in_one_line_and_leaves_nothing(place, bank_file, tmp_path, capsys, monkeypatch):
    def refuses(code, said, *more):
        assert make(place, "out", *more) == code
        error = capsys.readouterr().err
        assert said in error
        assert error.count("\n") == 1
        assert not list(place.glob("*out"))

    thicker = shutil.copytree(ROOT / "boards/simulated", tmp_path / "thicker")
    text = (thicker / "board.toml").read_text()
    (thicker / "board.toml").write_text(re.sub(r"(?m)^thickness_mm = .*", "thickness_mm = 3.3", text))
    refuses(78, "was built for another board than thicker", "--board", thicker, "--bank", bank_file)
    refuses(2, "is a second bank for banks/simulated.bank", "--board", "simulated", "--bank", bank_file, bank_file)
    lacks = "board ulx3s loads ulx3s.bit: give it with --gateware, or put it beside its board.toml: haptic-panel gateware build"
    refuses(1, lacks, "--board", "ulx3s")
    refuses(78, "as no --board is given", "--bank", bank_file)
    refuses(78, "cannot be read", "--board", "simulated", "--bank", tmp_path / "none.bank")
    refuses(1, "must be like aarch64-cp311", "--platform", "arm")
    refuses(78, "board 'none' not found", "--board", "none")
    tiny = place / "wheels/tiny-1.0-py3-none-any.whl"
    other = tiny.rename(tiny.with_name("tiny-1.0-cp311-cp311-manylinux_2_17_aarch64.whl"))
    refuses(1, "has no wheel of tiny==1.0 for x86_64-cp311", "--platform", "x86_64-cp311")
    other.rename(tiny)
    data = tiny.read_bytes()
    tiny.write_bytes(data + b"more")
    refuses(1, "is not the file of tiny==1.0 whose hash is locked")
    tiny.write_bytes(data)
    own = place / "wheels/haptic_panel-1.0-py3-none-any.whl"
    own.rename(own.with_name("haptic_panel-1.0-cp311-abi3-linux_sparc.whl"))
    refuses(1, "must have one wheel of haptic-panel")
    (place / "wheels/haptic_panel-1.0-cp311-abi3-linux_sparc.whl").unlink()
    refuses(1, "make releases in a checkout")
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "yesterday")
    refuses(1, "set SOURCE_DATE_EPOCH")
    (place / "systemd/requirements.lock").write_text("tiny>=1.0\n")
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    refuses(1, "tiny has no exact version, or no hash")


def test_the_lock_file_has_what_pyproject_asks_for():
    """Names and ranges; made again by systemd/make_lock_files.sh."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"]
    asked = [Requirement(text) for text in [*project["dependencies"], *extras["update"], *extras["watch"], *extras["page"], "pip"]]
    for architecture in ("x86_64", "aarch64"):
        packages = {one.name: one for one in wanted(read_lock(LOCK), Target(architecture, 11))}
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


def test_a_bitstream_that_the_bring_up_would_refuse_is_not_released(place, capsys):
    """A device would load it, find another panel's limits or other Verilog, and not start."""
    board = load_board(find_board("ulx3s"))
    own_wheel(place, workshop=False)
    file = place / "ulx3s.bit"

    def released(out, **changes):
        parameters = top_parameters(board, build_hash(ROOT / "fpga_rtl")) | changes
        identity = Identity(board="b", top="t", device="d", seed=1, parameters=parameters, sources="0", tools={})
        file.write_bytes(sealed(b"\xff\x00" + identity.comment().encode() + b"\0\xff" + bytes(100)))
        return make(place, out, "--board", "ulx3s", "--gateware", file)

    def refused(code, said):
        error = capsys.readouterr().err
        assert code == 1
        assert error.count("\n") == 1
        assert str(file) in error
        assert said in error
        assert not (place / "out").exists()

    refused(released("out", BUILD_HASH=1), "bring-up of board ulx3s would refuse it: its BUILD_HASH is 0x00000001")
    most = top_parameters(board, 0)["TOTAL_EDGES_MAX"]
    refused(released("out", TOTAL_EDGES_MAX=most + 1), f"its TOTAL_EDGES_MAX is {most + 1}, not {most} (limits.")
    file.write_bytes(b"gateware")
    refused(make(place, "out", "--board", "ulx3s", "--gateware", file), "is no bitstream of an ECP5 or Gowin")
    file.unlink()
    refused(make(place, "out", "--board", "ulx3s", "--gateware", file), "No such file")
    assert released("good") == 0
    assert (place / "good/gateware/ulx3s.bit").read_bytes() == file.read_bytes()


def bitstream_of(board, file):
    """A file that says that it is a board's bitstream."""
    parameters = top_parameters(board, build_hash(ROOT / "fpga_rtl"))
    identity = Identity(board=board.name, top="ulx3s", device="d", seed=1, parameters=parameters, sources="0", tools={})
    file.parent.mkdir(exist_ok=True)
    file.write_bytes(sealed(b"\xff\x00" + identity.comment().encode() + b"\0\xff" + bytes(100)))
    return file


def test_a_board_copied_from_ulx3s_is_released_by_the_lines_of_the_page(place, monkeypatch):
    """Those of systemd/README.md and those of publishing.md; Yosys and nextpnr alone are left out, which take minutes."""
    panel = place / "panel"
    own_wheel(place, workshop=False)
    shutil.copytree(ROOT / "boards/ulx3s", panel)
    text = (panel / "board.toml").read_text()
    for key, value in (("length_mm", "215.0"), ("thickness_mm", "0.7"), ("pitch_mm", "15.0\ncoarse = true"), ("snap_mm", "7.0")):
        text, count = re.subn(rf"(?m)^{key} = .*", f"{key} = {value}", text)
        assert count == 1
    (panel / "board.toml").write_text(text)
    monkeypatch.chdir(place)
    monkeypatch.setenv("STATE_DIRECTORY", str(place / "state"))
    (block,) = re.findall(
        r"^```console\n([^`]*make-release.*?)^```", (ROOT / "systemd/README.md").read_text(), re.MULTILINE | re.DOTALL
    )
    bank, gateware, release, _package = block.splitlines()
    assert main(shlex.split(bank.replace("PANEL", "panel"))[1:]) == 0
    assert shlex.split(gateware)[1:] == ["gateware", "build", "--board", "PANEL"]
    bitstream_of(load_board(panel), place / "build/panel.bit")
    assert main([*shlex.split(release.replace("PANEL", "panel"))[1:], "--wheels", "wheels"]) == 0
    files = {file.path for file in read_release(place / "release-1.0").files}
    assert {"boards/panel/board.toml", "banks/panel.bank", "gateware/panel.bit"} <= files
    (shown,) = re.findall(r"`(--board \S+ --bank.*?)`", (ROOT / "controller/workshop/publish/publishing.md").read_text())
    assert make(place, "published", *shlex.split(shown.replace("../", ""))) == 0


def test_a_bitstream_beside_the_board_goes_with_it(place, capsys):
    panel = place / "panel"
    own_wheel(place, workshop=False)
    shutil.copytree(ROOT / "boards/ulx3s", panel)
    file = bitstream_of(load_board(panel), panel / "panel.bit")
    assert make(place, "out", "--board", panel) == 0
    assert (place / "out/boards/panel/panel.bit").read_bytes() == file.read_bytes()
    file.write_bytes(b"gateware")
    assert make(place, "other", "--board", panel) == 1
    assert f"{file}: is no bitstream" in capsys.readouterr().err


def test_only_a_simulated_board_brings_the_workshop(place, bank_file, capsys):
    """Code that signs and simulates is for no device; the simulated FPGA is there alone."""
    panel = place / "panel"
    shutil.copytree(ROOT / "boards/ulx3s", panel)
    bitstream_of(load_board(panel), panel / "panel.bit")
    assert make(place, "out", "--board", panel) == 1
    assert "haptic_panel-1.0-py3-none-any.whl: has the workshop, which no device gets" in capsys.readouterr().err
    own_wheel(place, workshop=False)
    assert make(place, "out", "--board", panel) == 0
    assert make(place, "other", "--board", "simulated", "--bank", bank_file) == 1
    assert "lacks the workshop, which simulates the FPGA of a board" in capsys.readouterr().err
    assert not (place / "other").exists()

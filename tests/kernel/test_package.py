"""systemd/package/build.sh: what a package is for, the same bytes for the same inputs, and what is refused."""

import os
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest

from controller.device.update.manifest import Manifest

HERE = Path(__file__).parent
BUILD = HERE.parents[1] / "systemd/package/build.sh"

pytestmark = pytest.mark.kernel


@pytest.fixture(scope="module", autouse=True)
def tools():
    subprocess.run([HERE / "install_packages.sh", "debhelper", "fakeroot", "unzip"], check=True, stdout=subprocess.DEVNULL)


def release(folder, version="1.0rc2", architecture="aarch64"):
    """A release with one wheel, whose library asks for a glibc of its own."""
    (folder / "wheels").mkdir(parents=True)
    with zipfile.ZipFile(folder / "wheels/a-1-py3-none-any.whl", "w") as wheel:
        wheel.writestr("a.so", b"\0GLIBC_2.9\0GLIBC_2.31\0GLIBC_2.4\0")
    manifest = Manifest(
        version=version, counter=1, python="3.11", architecture=architecture, protocol=2, gateware_hash="00000000",
        bank_format=1, settings_format=1, files=[],
    )  # fmt: skip
    (folder / "release.json").write_bytes(manifest.to_json())
    (folder.parent / "root.json").write_text("{}\n")
    return folder


def build(folder, out, **environment):
    """The end of build.sh."""
    out.mkdir(exist_ok=True)
    return subprocess.run(
        ["sh", BUILD, folder, folder.parent / "root.json"],
        env=os.environ | {"OUT": str(out), "SOURCE_DATE_EPOCH": "1700000000"} | environment,
        capture_output=True,
        text=True,
        check=False,
    )


def test_a_package_is_for_the_processor_and_the_python_of_its_wheels(tmp_path):
    done = build(release(tmp_path / "release"), tmp_path / "out", REVISION="3", DEBEMAIL="anna@example.org", DEBFULLNAME="Anna")
    assert done.returncode == 0, done.stderr
    path = Path(done.stdout.strip())
    assert path.name == "haptic-panel_1.0~rc2-3_arm64.deb", "and 1.0 comes after it"
    said = subprocess.run(["dpkg-deb", "-f", path], capture_output=True, text=True, check=True).stdout
    assert "Architecture: arm64\n" in said
    assert "Maintainer: Anna <anna@example.org>\n" in said
    assert " python3.11, libc6 (>= 2.31), " in said


def test_the_same_inputs_give_the_same_bytes_elsewhere_and_under_another_umask(tmp_path):
    first = build(release(tmp_path / "release"), tmp_path / "out")
    elsewhere = tmp_path / "elsewhere"
    shutil.copytree(tmp_path / "release", elsewhere / "copy")
    for path in elsewhere.rglob("*"):
        path.chmod(0o700 if path.is_dir() else 0o600)
        os.utime(path, (1, 1))
    shutil.copy(tmp_path / "root.json", elsewhere)
    before = os.umask(0o077)
    try:
        second = build(elsewhere / "copy", tmp_path / "again")
    finally:
        os.umask(before)
    assert Path(first.stdout.strip()).read_bytes() == Path(second.stdout.strip()).read_bytes()


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda folder: (folder / "release.json").unlink(), "is not the folder of a release: it has no release.json"),
        (lambda folder: (folder.parent / "root.json").unlink(), "is no file: give the root.json of the repository"),
        (lambda folder: release(shutil.rmtree(folder) or folder, architecture="armv7l"), "is for armv7l; packages are made for"),
        (lambda folder: release(shutil.rmtree(folder) or folder, version="v1"), "version v1 is none of a Debian package"),
    ],
)
def test_what_cannot_be_packed_is_refused_in_one_line(tmp_path, spoil, said):
    folder = release(tmp_path / "release")
    spoil(folder)
    done = build(folder, tmp_path / "out")
    assert done.returncode == 1
    assert said in done.stderr
    assert done.stderr.count("\n") == 1
    assert list((tmp_path / "out").iterdir()) == []

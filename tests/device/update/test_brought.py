"""What becomes of the release that the Debian package brings."""

import hashlib

import pytest

from controller.device.update import brought
from controller.device.update.layout import COMPLETE, MANIFEST, Layout
from controller.device.update.manifest import Manifest, ReleaseFile
from controller.errors import UpdateError

WHEEL = b"a wheel"


def manifest(version, counter):
    file = ReleaseFile(path="wheels/a-1-py3-none-any.whl", sha256=hashlib.sha256(WHEEL).hexdigest(), size_bytes=len(WHEEL))
    return Manifest(
        version=version, counter=counter, python="3.11", architecture="x86_64", protocol=2, gateware_hash="00000000",
        bank_format=1, settings_format=1, files=[file],
    )  # fmt: skip


@pytest.fixture
def package(tmp_path):
    """Folder of release 2, as the package has it."""
    folder = tmp_path / "first-release"
    (folder / "wheels").mkdir(parents=True)
    (folder / "wheels/a-1-py3-none-any.whl").write_bytes(WHEEL)
    (folder / MANIFEST).write_bytes(manifest("2", 2).to_json())
    return folder


@pytest.fixture
def device(tmp_path, monkeypatch):
    """A device without a release; what is built by pip is only marked complete."""
    layout = Layout(tmp_path / "device")
    for name in ("releases", "store", "state", "requests", "download"):
        (layout.root / name).mkdir(parents=True)
    monkeypatch.setattr(brought, "install", lambda layout, manifest: put(layout, manifest.version, manifest.counter))
    return layout


def put(layout, version, counter):
    folder = layout.release(version)
    folder.mkdir()
    (folder / MANIFEST).write_bytes(manifest(version, counter).to_json())
    (folder / COMPLETE).touch()


def use(layout, version, counter):
    put(layout, version, counter)
    layout.current.symlink_to(f"releases/{version}")
    (layout.state / "current").write_text(f"{version}\n")


def test_a_device_without_a_release_adopts_it(device, package):
    assert brought.install_brought(device, package) == ("adopt", "release 2 is installed")
    assert device.is_complete("2")
    (stored,) = device.store.iterdir()
    assert stored.name == hashlib.sha256(WHEEL).hexdigest()
    assert stored.read_bytes() == WHEEL
    assert stored.stat().st_mode & 0o777 == 0o444


def test_a_device_with_an_older_release_tries_it(device, package):
    use(device, "1", 1)
    outcome, why = brought.install_brought(device, package)
    assert outcome == "trial"
    assert "else 1 is used again" in why
    assert (device.requests / "trial").read_text() == "2\n"
    assert device.current.readlink().name == "1", "the fall-back script switches"


@pytest.mark.parametrize(("version", "counter"), [("3", 3), ("other", 2)])
def test_a_release_that_is_not_older_stays(device, package, version, counter):
    use(device, version, counter)
    outcome, why = brought.install_brought(device, package)
    assert (outcome, why) == ("stays", f"release {version} stays in use: it is not older than 2, which the package brings")
    assert not device.release("2").exists()


def test_one_that_failed_here_is_not_tried_again(device, package):
    use(device, "1", 1)
    (device.state / "failed").write_text("2\n")
    outcome, why = brought.install_brought(device, package)
    assert outcome == "stays"
    assert why.endswith("2, which the package brings, has failed on this device")
    assert not (device.requests / "trial").exists()


@pytest.mark.parametrize("where", ["state", "requests"])
def test_a_trial_that_is_not_decided_goes_on(device, package, where):
    use(device, "1", 1)
    put(device, "1.5", 1)
    (device.root / where / "trial").write_text("1.5\n")
    outcome, why = brought.install_brought(device, package)
    assert outcome == "stays"
    assert "on trial" in why
    assert (device.root / where / "trial").read_text() == "1.5\n"


def test_a_release_in_use_that_is_not_complete_is_replaced(device, package):
    use(device, "1", 1)
    (device.release("1") / COMPLETE).unlink()
    assert brought.install_brought(device, package)[0] == "adopt"


def test_a_damaged_package_is_refused_and_nothing_of_it_stays(device, package):
    use(device, "1", 1)
    (package / "wheels/a-1-py3-none-any.whl").write_bytes(b"a wheeI")
    with pytest.raises(UpdateError, match=r"a-1-py3-none-any\.whl: is not what release\.json lists: install the package again$"):
        brought.install_brought(device, package)
    assert list(device.store.iterdir()) == []
    assert not device.release("2").exists()
    assert not (device.requests / "trial").exists()
    assert device.current.readlink().name == "1"


def test_a_damaged_file_in_the_store_is_replaced(device, package):
    stored = device.store / hashlib.sha256(WHEEL).hexdigest()
    stored.write_bytes(b"not a wheel")
    brought.install_brought(device, package)
    assert stored.read_bytes() == WHEEL

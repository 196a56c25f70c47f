"""What the publisher's tools make, the device's client takes: over http, from a stick, and after keys were changed."""

from datetime import timedelta

from repository_fixture import Device
from tiny_release import NOW, TinyRepository, release_folder

from controller.device.update.download.fetch import TransferStatistics, fetch
from controller.device.update.settings import UpdateSettings
from controller.workshop.publish.publications import draft_keys
from controller.workshop.publish.publisher import Repository
from controller.workshop.publish.stick import export

ENTRY = 256
BANK = b"".join(number.to_bytes(2, "big") * (ENTRY // 2) for number in range(400))  # 102,400 bytes, no two entries alike
CUT = {"banks/tiny.bank": [(at, ENTRY) for at in range(0, len(BANK), ENTRY)]}


def test_releases_reach_a_device(tmp_path, serve):
    repository = TinyRepository(tmp_path / "repository", tmp_path / "keys")

    def publish(version, counter, bank):
        folder = tmp_path / version
        release_folder(folder, version, counter, {"banks/tiny.bank": bank}, CUT)
        return repository.publish(folder)

    one = publish("1.0.0", 1, BANK)
    device = Device(tmp_path, repository.root_json.read_bytes())
    server = serve(repository.folder)

    def take(source, now=NOW):
        figures = TransferStatistics()
        manifest = fetch(device.layout, UpdateSettings(), str(source), lambda *_: None, now, figures)
        assert all((device.layout.store / file.sha256).stat().st_size == file.size_bytes for file in manifest.files)
        return manifest, figures

    assert take(server.address)[0] == one
    device.install(one)
    bank = BANK[: 300 * ENTRY] + b"new" * 100 + BANK[300 * ENTRY + 300 :]
    two = publish("1.1.0", 2, bank)
    with Repository.opened(repository.folder) as opened:
        export(opened, tmp_path / "stick", repository.signers["publisher"], NOW)
    for file in (device.layout.download / "indexes").iterdir():
        file.unlink()  # a stick has none of old banks
    manifest, figures = take(tmp_path / "stick", NOW + timedelta(days=300))  # longer than a server's timestamp lives
    assert manifest == two
    assert figures.reused_bytes == len(bank) - 2 * ENTRY
    device.install(two)
    with Repository.opened(repository.folder) as opened:
        people = [repository.public["bob"]]
        draft_keys(opened, {}, {"root": people, "targets": people}, 1, NOW)
    assert repository.sign()
    del repository.signers["bob"]
    three = publish("1.2.0", 3, BANK)
    manifest, figures = take(server.address)
    assert manifest == three
    assert figures.kept_bytes == three.total_bytes  # the first release's bank is still in the store

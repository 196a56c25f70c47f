"""The ceremony of publishing.md, command by command; the computers of its people are folders here."""

import re
import shlex
import subprocess
from pathlib import Path

import pytest
from test_publisher import client
from tiny_release import PASSPHRASE, release_folder

from controller.cli import main
from controller.workshop.publish.keys import owner
from controller.workshop.publish.publisher import Repository

PAGE = Path(__file__).parents[3] / "controller" / "workshop" / "publish" / "publishing.md"
BLOCK = re.compile(r"^```sh (\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("make", ["tiny", pytest.param("real", marks=pytest.mark.slow)])
def test_the_page_is_run_by_its_people(tmp_path, monkeypatch, capsys, make):
    monkeypatch.setenv("HAPTIC_PANEL_PASSPHRASE", PASSPHRASE)
    places = {"/srv/": f"{tmp_path}/srv/", "/media/stick": f"{tmp_path}/stick"}
    for folder in ("srv", "stick", "alice", "bob", "carol", "office"):
        (tmp_path / folder).mkdir()
    repository, versions, ran = tmp_path / "srv/releases", [], 0
    for who, lines in BLOCK.findall(PAGE.read_text()):
        monkeypatch.chdir(tmp_path / who)
        for line in lines.splitlines():
            for name, place in places.items():
                line = line.replace(name, place)  # noqa: PLW2901
            words = shlex.split(line.removeprefix("$ "))
            ran += 1
            if make == "tiny" and "make-release" in words:
                release_folder(Path(words[3]), words[words.index("--version") + 1], int(words[words.index("--counter") + 1]))
            elif words[0] == "haptic-panel":
                assert main(words[1:]) == 0, f"{who}: {line}: {capsys.readouterr().err}"
            else:
                assert words[0] in {"cp", "mkdir"}
                subprocess.run(words, check=True)
            if (repository / "metadata/timestamp.json").exists():
                versions.append(Repository(repository).published("timestamp").signed.version)
    assert ran > 30
    assert versions == sorted(versions)
    assert not (repository / "draft").exists()
    assert not list(repository.rglob("*.pem"))
    root = (tmp_path / "office/root.json").read_bytes()
    for source in (repository, tmp_path / "stick/panel"):
        updater = client(source, tmp_path / source.name, root)
        assert updater.get_targetinfo("channels/stable.json")
    assert sorted(owner(key) for key in Repository(repository).root.keys.values()) == ["alice", "carol", "office"]

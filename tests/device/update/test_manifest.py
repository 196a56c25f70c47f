"""Any bytes are a manifest, or refused in one line."""

import json

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from tables import each_row

from controller.device.update.manifest import Manifest, ReleaseFile, read_manifest
from controller.errors import UpdateError

FILES = (ReleaseFile(path="wheels/a-1-py3-none-any.whl", sha256="0" * 64, size_bytes=9),)
WHOLE = Manifest(
    version="1.0", counter=1, python="3.11", architecture="x86_64", protocol=2, gateware_hash="00000000",
    bank_format=1, settings_format=1, files=list(FILES),
).to_json()  # fmt: skip


def read_or_refused(content):
    try:
        read_manifest(content, "here")
    except UpdateError as error:
        refused = str(error)
    else:
        return
    assert refused.startswith("here: ")
    assert "\n" not in refused


@given(st.binary(max_size=100))
@example(b'{"version": "\xe2"}')
@example(b"[" * 100_000)
def test_any_bytes(content):
    read_or_refused(content)


@given(st.integers(0, len(WHOLE) - 1), st.integers(0, 7), st.binary(max_size=4))
def test_a_wrong_bit_anywhere_a_cut_and_bytes_that_came_between(place, bit, more):
    damaged = bytearray(WHOLE)
    damaged[place] ^= 1 << bit
    for content in (bytes(damaged), WHOLE[:place], WHOLE[:place] + more + WHOLE[place:]):
        read_or_refused(content)


def test_the_whole_one_is_read():
    assert tuple(read_manifest(WHOLE, "here").files) == FILES
    with pytest.raises(UpdateError, match="is not JSON"):
        read_manifest(WHOLE[:-3], "here")


def changed(**fields):
    """The manifest with other fields, as bytes."""
    return json.dumps(json.loads(WHOLE) | fields).encode()


@each_row("field", ["version", "python", "architecture", "gateware_hash"])
def test_a_line_break_at_the_end_is_no_part_of_a_field(field):
    """Which `$` of a regular expression takes."""
    value = json.loads(WHOLE)[field]
    read_manifest(changed(**{field: value}), "here")
    with pytest.raises(UpdateError, match=f"here: {field} = .*must be a text that matches .*[$]"):
        read_manifest(changed(**{field: f"{value}\n"}), "here")


@each_row("digest", ["0" * 64 + "\n", "0" * 63, "0" * 65, "G" * 64])
def test_a_digest_is_64_hexadecimal_digits_and_nothing_more(digest):
    for more in ({"boards": {"panel": digest}}, {"files": [{"path": "wheels/a.whl", "sha256": digest, "size_bytes": 1}]}):
        with pytest.raises(UpdateError, match="must be "):
            read_manifest(changed(**more), "here")


@each_row(
    ("before", "after", "said"),
    [
        (b'"counter": 1,', b'"counter": 1, "counter": 2,', "key 'counter' comes twice"),
        (b'"path":', b'"path": "venv/x", "path":', "key 'path' comes twice"),
        (b'"counter": 1,', b'"counter": NaN,', "NaN is no number"),
        (b'"counter": 1,', b'"counter": 1e400,', "counter = inf: must be a finite number"),
    ],
)
def test_what_another_reader_would_read_otherwise_is_refused(before, after, said):
    assert WHOLE.count(before) == 1
    with pytest.raises(UpdateError, match=f"^here: .*{said}"):
        read_manifest(WHOLE.replace(before, after), "here")


@each_row(
    "path",
    ["venv/bin/python", "venv/lib/python3.11/site-packages/x.pth", "release.json", "indexes/a", "store/a", "bin", "Wheels/a",
     "wheels\n/a", "wheels/a\n", ".complete", "wheels/../venv/x", "/wheels/a", "wheels//a"],
)  # fmt: skip
def test_a_file_that_is_none_of_a_release_is_refused(path):
    with pytest.raises(UpdateError, match=r"^here: files: "):
        read_manifest(changed(files=[{"path": path, "sha256": "0" * 64, "size_bytes": 1}]), "here")
    good = [{"path": f"{room}/a", "sha256": "0" * 64, "size_bytes": 1} for room in ("wheels", "boards/b", "banks", "gateware")]
    read_manifest(changed(files=[*good, {"path": "sbom.cdx.json", "sha256": "0" * 64, "size_bytes": 1}]), "here")

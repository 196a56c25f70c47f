"""Any bytes are a manifest, or refused in one line."""

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from controller.errors import UpdateError
from controller.update.manifest import Manifest, ReleaseFile, read_manifest

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

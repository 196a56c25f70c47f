"""A file is the old one or the new one, whole."""

import os

import pytest

from controller import durable


def test_a_write_that_fails_leaves_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "counter"
    durable.write_durably(path, b"1\n", 0o600)
    assert path.stat().st_mode & 0o777 == 0o600

    def full(fd):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space"):
        durable.write_durably(path, b"2\n")
    assert path.read_bytes() == b"1\n"
    assert list(tmp_path.iterdir()) == [path]

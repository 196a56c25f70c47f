"""Where a repository is read from: each way to fail is one line that says what, where and what to do."""

import os
import re
import socket
import ssl
import threading
from datetime import UTC, datetime
from ipaddress import ip_address

import pytest
from cryptography import x509
from cryptography.hazmat.primitives import hashes
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.hazmat.primitives.serialization import Encoding, NoEncryption, PrivateFormat
from hypothesis import given, settings
from hypothesis import strategies as st
from tuf.api.exceptions import DownloadError, DownloadHTTPError, DownloadLengthMismatchError, SlowRetrievalError

from controller.device.update.download.fetch import source_of
from controller.device.update.download.http_source import HttpSource, answers_range
from controller.device.update.download.source import FolderSource, NoRanges
from controller.errors import UpdateError


@pytest.fixture
def folder(tmp_path):
    for name in ("metadata", "targets"):
        (tmp_path / "repository" / name).mkdir(parents=True)
    (tmp_path / "repository" / "targets" / "file").write_bytes(bytes(range(256)) * 1000)
    return tmp_path / "repository"


@pytest.fixture(params=["http", "folder"])
def source(request, folder, serve):
    if request.param == "folder":
        return FolderSource(str(folder))
    return HttpSource(serve(folder).address, 60, retries=0)


DATA = bytes(range(256)) * 1000


def read(source, name="targets/file", **what):
    return b"".join(source.open(f"{source.address}/{name}", **what))


def test_files_and_ranges_come_whole_and_are_counted(source):
    assert read(source) == DATA
    assert read(source, start=100_000) == DATA[100_000:]
    assert read(source, start=7, length=70_000) == DATA[7:70_007]
    assert read(source, length=len(DATA)) == DATA
    assert source.fetched_bytes == 2 * len(DATA) + len(DATA) - 100_000 + 70_000


def test_what_is_not_there_is_reported(source):
    with pytest.raises(DownloadHTTPError) as reported:
        read(source, "targets/other")
    assert reported.value.status_code == 404
    with pytest.raises(DownloadError):
        read(source, start=255_990, length=100)


def test_a_folder_that_cannot_be_looked_at_is_reported(tmp_path):
    with pytest.raises(UpdateError, match=r"cannot be read \(File name too long\): the user haptic-update must be able to$"):
        FolderSource(str(tmp_path / ("x" * 300))).look()


def test_connections_are_kept(folder, serve):
    server = serve(folder)
    connections = set()
    server.instead = lambda handler: connections.add(handler.client_address) or False
    source = HttpSource(server.address, 60, retries=0)
    for start in range(0, 200_000, 50_000):
        read(source, start=start, length=1000)
    assert len(connections) == 1


def refused(server, instead, error=DownloadError, gap_s=20, **what):
    server.instead = instead
    source = HttpSource(server.address, 60, gap_s=gap_s, retries=0)
    with pytest.raises(error) as reported:
        read(source, **what)
    assert "\n" not in str(reported.value)
    assert server.address in str(reported.value)
    return str(reported.value)


def test_a_login_page_is_named(folder, serve):
    said = refused(serve(folder), lambda h: h.answer(200, b"<html>", Content_Type="text/html; charset=utf-8") or True)
    assert "does this network ask for a login" in said


def test_redirects_are_refused(folder, serve):
    server = serve(folder)
    said = refused(server, lambda h: h.answer(302, Location="http://127.0.0.1:1/x") or True)
    assert "redirects are not followed" in said
    assert len(server.requests) == 1


@pytest.mark.parametrize("status", [500, 503, 403])
def test_the_servers_errors_are_reported(folder, serve, status):
    assert f"answers {status}" in refused(serve(folder), lambda h: h.answer(status) or True, DownloadHTTPError)


def test_silence_is_reported(folder, serve):
    server = serve(folder)
    said = refused(server, lambda _: server.ended.wait(20) and True, SlowRetrievalError, gap_s=0.2)
    assert "said nothing for 0.2 s" in said


def test_a_connection_that_breaks_in_the_middle_is_reported(folder, serve):
    def broken(handler):
        handler.answer(200, DATA[:1000], Content_Length=len(DATA))
        handler.close_connection = True
        return True

    assert "connection broke" in refused(serve(folder), broken)


def test_refused_is_not_called_slow():
    with socket.create_server(("127.0.0.1", 0)) as listens:
        port = listens.getsockname()[1]
    with pytest.raises(DownloadError, match="connection was refused") as reported:
        read(HttpSource(f"http://127.0.0.1:{port}", 60, retries=0))
    assert not isinstance(reported.value, SlowRetrievalError)


@pytest.mark.parametrize(
    "headers",
    [
        {},
        {"Content_Range": "bytes 0-9/256000"},
        {"Content_Range": "bytes 10-20/256000"},
        {"Content_Range": "bytes 10-19/15"},
        {"Content_Range": "bytes */256000"},
    ],
)
def test_another_range_than_asked_for_is_refused(folder, serve, headers):
    refused(serve(folder), lambda h: h.answer(206, DATA[10:20], **headers) or True, NoRanges, start=10, length=10)


def test_a_server_without_ranges_is_noticed(folder, serve):
    server = serve(folder)
    server.ranges = False
    refused(server, lambda _: False, NoRanges, start=10)
    assert read(HttpSource(server.address, 60, retries=0), length=len(DATA)) == DATA


def test_a_file_of_another_length_than_signed_is_refused_at_once(folder, serve):
    server = serve(folder)
    server.ranges = False
    refused(server, lambda _: False, DownloadLengthMismatchError, length=10)


def test_an_answer_that_ends_early_is_reported(folder, serve):
    cut = {"Content_Range": "bytes 0-9/10", "Content_Length": None, "Connection": "close"}
    assert "ended after 5 of 10 bytes" in refused(serve(folder), lambda h: h.answer(206, b"01234", **cut) or True, length=10)


def certificate(folder, begins, ends):
    """A key and a certificate that it has signed itself, for 127.0.0.1."""
    private = ec.generate_private_key(ec.SECP256R1())
    name = x509.Name([x509.NameAttribute(x509.NameOID.COMMON_NAME, "test")])
    made = (
        x509.CertificateBuilder(name, name, private.public_key(), 1, begins, ends)
        .add_extension(x509.SubjectAlternativeName([x509.IPAddress(ip_address("127.0.0.1"))]), critical=False)
        .add_extension(x509.BasicConstraints(ca=True, path_length=None), critical=True)
        .sign(private, hashes.SHA256())
    )
    plain = private.private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption())
    (folder / "pem").write_bytes(plain + made.public_bytes(Encoding.PEM))
    return folder / "pem"


def test_a_certificate_is_checked(folder, serve, tmp_path, monkeypatch):
    """By the system's authorities, and its dates by the clock, of which the line reminds."""
    for begins, ends, known, good in ((2020, 2120, True, True), (2020, 2120, False, False), (2119, 2120, True, False)):
        pem = certificate(tmp_path, datetime(begins, 1, 1, tzinfo=UTC), datetime(ends, 1, 1, tzinfo=UTC))
        context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
        context.load_cert_chain(pem)
        monkeypatch.setenv("SSL_CERT_FILE", str(pem) if known else os.devnull)
        source = HttpSource(serve(folder, context).address, 60, retries=0)
        if good:
            assert read(source, length=len(DATA)) == DATA
        else:
            with pytest.raises(DownloadError, match=r"its certificate is not accepted .*: is the clock right"):
                read(source)


RAW = [
    b"",
    b"garbage",
    b"\0" * 1000,
    b"HTTP/1.1 200",
    b"HTTP/1.1 99999999999 X\r\n\r\n",
    b"HTTP/9.9 200 OK\r\n\r\n",
    b"HTTP/1.1 -1 OK\r\n\r\n",
    b"HTTP/1.1 200 OK\r\nContent-Length: -5\r\n\r\nx",
    b"HTTP/1.1 200 OK\r\nContent-Length: 5, 7\r\n\r\nx",
    b"HTTP/1.1 200 OK\r\nContent-Length: " + b"9" * 5000 + b"\r\n\r\nx",
    b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n",
    b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n-5\r\nabc\r\n",
    b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nabc",
    b"HTTP/1.1 200 OK\r\nContent-Encoding: gzip\r\nContent-Length: 3\r\n\r\nabc",
    b"HTTP/1.1 206 OK\r\nContent-Range: bytes 0-9/10\r\nContent-Length: 3\r\n\r\nabc",
    b"HTTP/1.1 200 OK\r\n" + b"X: y\r\n" * 1000 + b"\r\n",
    b"HTTP/1.1 200 OK\r\nX: " + b"y" * 100_000,
    b"HTTP/1.1 100 Continue\r\n\r\n" * 50,
    b"HTTP/1.1 101 Switching\r\n\r\n",
    b"HTTP/1.1 204 None\r\n\r\n",
    b"HTTP/1.1 304 Same\r\n\r\n",
    b"HTTP/1.1 302 Away\r\nLocation: \xff\xfe\r\n\r\n",
    b"HTTP/1.1 200 OK\r\nbroken header\r\n: x\r\n\r\n",
]


@pytest.mark.filterwarnings(
    "ignore::pytest.PytestUnraisableExceptionWarning"
)  # http.client drops a socket at a number of 5,000 digits
def test_whatever_a_server_says_ends_as_one_line_or_as_bytes(folder, serve):
    """Raw answers, then the connection ends."""
    server = serve(folder)
    for raw in RAW:

        def answer(handler, raw=raw):
            handler.wfile.write(raw)
            handler.close_connection = True
            return True

        server.instead = answer
        for what in ({}, {"length": 10}, {"start": 5, "length": 10}, {"start": 5}):
            source = HttpSource(server.address, 60, retries=0)
            try:
                given_bytes = read(source, **what)
            except DownloadError as error:
                assert "\n" not in str(error), raw  # noqa: PT017 - both ends are right
            else:
                assert len(given_bytes) <= 10
                assert not what, (raw, what)


class Time:
    """A clock that only waiting moves."""

    now_s = 0.0

    def now(self):
        return self.now_s

    def wait(self, seconds):
        self.now_s += seconds


def test_bandwidth_is_limited(folder, serve):
    time = Time()
    source = HttpSource(serve(folder).address, 1e6, 1000.0, retries=0, now_s=time.now, wait_s=time.wait)
    read(source)
    read(source, length=44_000)
    assert time.now_s == pytest.approx(300.0)


def test_all_files_together_have_a_time_limit(folder, serve):
    """A byte now and then is never silent for long; and the limit is not that of one file."""
    time = Time()
    source = HttpSource(serve(folder).address, 100.0, retries=0, now_s=time.now, wait_s=time.wait)
    for _ in range(3):
        time.wait(30)
        read(source)
    time.wait(11)
    with pytest.raises(SlowRetrievalError, match=re.escape("not done within 100 s (total_s)")):
        read(source)
    source = HttpSource(serve(folder).address, 100.0, 1000.0, retries=0, now_s=time.now, wait_s=time.wait)
    with pytest.raises(SlowRetrievalError):
        read(source)


def test_a_trickle_ends_at_the_limit(folder, serve):
    """Byte by byte: each is handed on as it comes, so that the limit is seen."""
    server, time, more = serve(folder), Time(), threading.Event()

    def trickle(handler):
        handler.answer(200, b"x", Content_Length=1000)
        more.wait(20)
        handler.wfile.write(b"x")
        server.ended.wait(20)
        return True

    server.instead = trickle
    chunks = HttpSource(server.address, 60, retries=0, now_s=time.now).open(f"{server.address}/targets/file")
    assert next(chunks) == b"x"
    time.wait(61)
    more.set()
    with pytest.raises(SlowRetrievalError):
        next(chunks)


NUMBERS = st.integers(0, 20) | st.integers(0, 10**16)


@given(NUMBERS, NUMBERS, st.none() | NUMBERS, st.integers(0, 9), st.none() | st.integers(1, 9))
def test_only_the_very_range_is_taken(first, last, total, start, length):
    header = f"bytes {first}-{last}/{'*' if total is None else total}"
    if answers_range(header, start, length):
        assert first == start
        assert last >= start
        assert length is None or last - first + 1 == length
        assert total is None or last < total
        assert length is not None or total in (None, last + 1)


@settings(max_examples=40)
@given(st.integers(0, 10**14), st.integers(1, 10**14), st.integers(0, 10**14))
def test_the_range_asked_for_is_taken(start, length, more):
    assert answers_range(f"bytes {start}-{start + length - 1}/{start + length + more}", start, length)
    assert answers_range(f"bytes {start}-{start + length - 1}/{start + length}", start, None)


@settings(max_examples=40)
@given(st.text(max_size=40), st.integers(0, 9), st.none() | st.integers(1, 9))
def test_no_other_header_is_a_range(text, start, length):
    assert not answers_range(text, start, length) or text.startswith("bytes ")


def test_nothing_outside_of_the_folder_is_read(folder, tmp_path):
    (tmp_path / "secret").write_bytes(b"secret")
    (folder / "targets" / "link").symlink_to(tmp_path / "secret")
    (folder / "targets" / "loop").symlink_to("loop")
    (folder / "targets" / "inside").symlink_to("file")
    os.mkfifo(folder / "targets" / "pipe")
    source = FolderSource(str(folder))
    for name in (
        "../secret",
        "targets/%2e%2e/%2e%2e/secret",
        "targets/link",
        "targets/loop",
        "targets/pipe",
        "targets",
        "targets/a%00b",
    ):
        with pytest.raises(DownloadHTTPError):
            read(source, name)
    assert read(source, "targets/inside") == DATA


def test_a_stick_that_is_pulled_is_reported_as_that(folder):
    source = FolderSource(str(folder))
    chunks = source.open(f"{source.address}/targets/file")
    next(chunks)
    folder.rename(folder.with_name("elsewhere"))
    with pytest.raises(DownloadError, match="was the stick pulled") as reported:
        read(source)
    assert not isinstance(reported.value, DownloadHTTPError)


def test_a_stick_that_gives_read_errors_is_reported(folder, monkeypatch):
    source = FolderSource(str(folder))

    class Bad:
        def __getattr__(self, name):
            raise AssertionError(name)

        def __enter__(self):
            return self

        def __exit__(self, *_):
            pass

        def seek(self, _):
            raise OSError(5, "Input/output error")

    monkeypatch.setattr(source, "_opened", lambda _: Bad())
    with pytest.raises(DownloadError, match="cannot be read"):
        read(source)


def test_what_is_no_repository_is_reported_before_anything_is_read(tmp_path):
    for text, said in (
        ("", "no repository is set"),
        ("ftp://a/b", "address: set"),
        ("http://", "address: set"),
        ("http://[::1/x", "address: set"),
        ("http://host:port/", "address: set"),
        ("http://host:99999/", "address: set"),
        (str(tmp_path / "absent"), "is the stick plugged in"),
        (str(tmp_path), "is no repository"),
    ):
        with pytest.raises(UpdateError, match=said):
            source_of(text, 1.0, 0.0)

"""Hosts, origins and rights by table."""

from http import HTTPStatus
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from tables import each_row

from controller.device.page.addresses import Origin, authority, origin_of
from controller.device.page.permissions import RIGHT_OF, Permissions, Refusal, refused
from controller.device.page.settings import PageSettings, load_settings
from controller.errors import ConfigError

FILE = Path("/etc/haptic-panel/page.toml")


def permissions(**settings):
    return Permissions(PageSettings(**settings), FILE)


@each_row("host", ["localhost", "LOCALHOST:8750", "127.0.0.1:1", "[::1]:8750", "[0:0::1]", "localhost.", "Kiosk.local:80"])
def test_names_of_the_bridge_are_accepted_in_any_case_and_with_any_port(host):
    assert permissions(hosts=("kiosk.local",)).host_refusal([host]) is None


@each_row(
    "host",
    [
        "evil.com",
        "localhost.evil.com",
        "127.0.0.2",
        "127.1",
        "0x7f.0.0.1",
        "[::ffff:127.0.0.1]",
        "localhost@evil.com",
        "",
        "[::1",
        "localhost:99999",
        "local host",
        "[:::]",
        "[1.2.3.4]",
    ],
)
def test_other_names_are_refused(host):
    assert permissions().host_refusal([host]) is not None


def test_a_host_must_be_named_once():
    assert permissions().host_refusal([]).status == HTTPStatus.BAD_REQUEST
    assert permissions().host_refusal(["localhost", "localhost"]).status == HTTPStatus.BAD_REQUEST


def test_a_refusal_names_the_line_of_the_file_that_allows_it():
    said = permissions().host_refusal(["Evil.com:80"])
    assert said == (
        HTTPStatus.MISDIRECTED_REQUEST,
        f"'Evil.com:80' is no name of this bridge: hosts = [\"evil.com\"] in {FILE} allows it",
    )
    said = permissions().rights(["HTTP://Evil.com:80"], "localhost:8750")
    assert said.reason.endswith(f'the line "http://evil.com" = ["play"] below [origins] in {FILE} allows it')
    assert "'HTTP://Evil.com:80'" in said.reason


@each_row(
    ("origin", "host", "rights"),
    [
        ("http://localhost:8750", "localhost:8750", {"look", "play", "regions"}),
        ("HTTP://LocalHost:8750", "localhost:8750", {"look", "play", "regions"}),
        ("http://[::1]:8750", "[0::1]:8750", {"look", "play", "regions"}),
        ("http://localhost:9000", "localhost:9000", {"look", "play", "regions"}),  # a port that ssh forwards
        ("http://localhost", "localhost:80", {"look", "play", "regions"}),
        ("http://localhost:8751", "localhost:8750", None),
        ("https://localhost:8750", "localhost:8750", None),
        ("http://127.0.0.1:8750", "localhost:8750", None),
        ("null", "localhost:8750", None),
        ("https://app.example", "localhost:8750", {"look", "play"}),
        ("https://app.example:443", "localhost:8750", {"look", "play"}),
        ("https://app.example:444", "localhost:8750", None),
        ("http://app.example", "localhost:8750", None),
        ("https://app.example.evil.com", "localhost:8750", None),
        ("https://staff.example", "localhost:8750", {"look", "play", "regions", "screen", "operate"}),
        ("https://looks.example", "localhost:8750", {"look"}),
        ("", "localhost:8750", None),
        ("http://localhost:8750/path", "localhost:8750", None),
    ],
)
def test_rights_are_those_of_the_origin(origin, host, rights):
    table = {
        "self": ("play", "regions"),
        "https://app.example": ("play",),
        "https://STAFF.example:443": ("operate",),
        "https://looks.example": (),
    }
    found = permissions(origins=table).rights([origin], host)
    assert isinstance(found, Refusal) if rights is None else found == rights


def test_files_are_an_origin_only_on_purpose():
    assert permissions(origins={"null": ("play",)}).rights(["null"], "localhost") == {"look", "play"}
    assert isinstance(permissions(origins={"null": ("play",)}).rights(["http://localhost"], "localhost"), Refusal)


def test_who_sends_no_origin_is_no_browser():
    assert isinstance(permissions().rights([], "localhost"), Refusal)
    assert isinstance(permissions().rights(["http://localhost"] * 2, "localhost"), Refusal)


def test_every_page_may_stop_and_none_may_operate_by_default():
    look = frozenset({"look"})
    assert refused({"kind": "stop"}, look) == ""
    assert "the right 'play'" in refused({"kind": "play"}, look)
    assert "the right 'regions'" in refused({"kind": "transform"}, look | {"play"})
    for kind in ("arm", "disarm", "load_scene", "save_scene"):
        assert "the right 'operate'" in refused({"kind": kind}, frozenset({"look", "play", "regions"}))
    assert "may not subscribe to touches" in refused({"kind": "subscribe"}, look)
    assert refused({"kind": "subscribe", "to": ["state"]}, look) == ""


def test_every_message_of_the_socket_has_its_right():
    from controller.device.application_socket.protocol import client_messages

    assert {kind.__struct_config__.tag for kind in client_messages.AnyRequest.__args__} <= RIGHT_OF.keys()


@given(st.text())
@example("0..")
@example("..")
def test_any_text_is_an_origin_or_none_and_one_stays_the_same(text):
    found = origin_of(text)
    assert found is None or isinstance(found, Origin)
    try:
        name, port = authority(text)
    except ValueError:
        return
    assert authority(name if port is None else f"{name}:{port}") == (name, port)


@each_row(
    ("text", "said"),
    [
        ('listen = ["0.0.0.0"]', "beyond this machine"),
        ('listen = ["here"]', "here"),
        ('tls_key = "k"', "give both"),
        ('hosts = ["a:80"]', "port"),
        ('[origins]\n"http://a/b" = ["play"]', "http://a/b"),
        ('[origins]\nself = ["paly"]', "paly"),
        ("max_pages = 0", "max_pages"),
        ("ports = 1", "ports"),
        ("x_mm_from_pixels = [1.0, 0.0, 0.0]", "y_mm_from_pixels"),
        ("messages_per_s = nan", "messages_per_s"),
        ("port = ", "TOML"),
    ],
)
def test_settings_that_cannot_be_are_refused_with_their_name(tmp_path, text, said):
    file = tmp_path / "page.toml"
    file.write_text(text)
    with pytest.raises(ConfigError, match=said) as caught:
        load_settings(file)
    assert str(file) in str(caught.value)


def test_other_interfaces_need_certificate_and_token(tmp_path):
    file = tmp_path / "page.toml"
    file.write_text('listen = ["192.168.1.2"]\ntls_certificate = "c"\ntls_key = "k"\ntoken_file = "t"')
    assert load_settings(file).scheme == "https"

"""The doctor says what is wrong, one thing in one line, with what to do; and that all is well where it is."""

import json
import os
import pwd
import re
import resource
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace

import msgspec
import pytest
from tables import each_row

from controller.cli import main
from controller.clocks import VirtualClock
from controller.device.bank.provenance import Provenance, SourceFile
from controller.device.board import gpio_chip, lookup
from controller.device.board.board import load_board
from controller.device.board.devices import LinkSettings, Realtime, Temperature
from controller.device.board.lookup import find_board
from controller.device.board.paths import bank_path
from controller.device.doctor import doctor, process_limits
from controller.device.doctor.bring_up import Chirps
from controller.device.doctor.doctor import look
from controller.device.doctor.link_examination import arriving_sck_hz, evaluated_sck, examine_link
from controller.device.fpga.bitstreams.bitstream import Identity, sealed
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.links import spi_device
from controller.device.fpga.session import Session
from controller.device.service.drivers import bitstream_path
from controller.device.touch.drivers import screen
from controller.device.touch.panels.ft5x06 import Ft5x06Touch
from controller.device.touch.panels.linux_input import LinuxInputTouch
from controller.device.touch.panels.serial_panel import EloTouch
from controller.errors import LinkError
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.simulated_link import SimulatedLink
from controller.workshop.physics.responses.impulse_response import ResponseModel

AXES = {"x_mm_from_axes": (210.0, 0.0, 0.0), "y_mm_from_axes": (0.0, 148.0, 0.0)}
SPI = LinkSettings(
    kind="spi",
    clock_hz=80_000_000,
    sck_hz=25_000_000,
    slots=4,
    device="/dev/spidev9.9",
    gpio_chip="no-such-chip",
    trigger_line="GPIO25",
)


def said(findings, about):
    """What was found out about one thing, and whether it is good."""
    (finding,) = [finding for finding in findings if finding.about == about]
    return finding.good, finding.said


def with_tables(board, **tables):
    return msgspec.structs.replace(board, **tables)


def test_each_absent_device_of_a_board_is_reported(board, monkeypatch, tmp_path):
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path))
    touch = Ft5x06Touch(bus="/dev/i2c-none", interrupt_chip="none", interrupt_line="INT", width=800, height=480, **AXES)
    temperature = Temperature(kind="lm75", device="/dev/i2c-none", coefficient_per_k=-1e-4)
    monkeypatch.setattr(doctor, "_responses", lambda _: "read")
    findings = look(with_tables(board, link=SPI, touch=touch, temperature=temperature), VirtualClock().now_s)
    assert [finding.about for finding in findings] == [
        "user",
        "SPI device",
        "spidev buffer",
        "GPIO lines",
        "touch panel",
        "scene",
        "bank",
        "temperature",
        "responses",
        "priority",
        "locked memory",
    ]
    assert said(findings, "SPI device")[1].startswith("there is no /dev/spidev9.9")
    assert "no GPIO chip has the label 'no-such-chip'" in said(findings, "GPIO lines")[1]
    assert not said(findings, "touch panel")[0]
    assert "no temperature sensor answers at /dev/i2c-none, address 0x48" in said(findings, "temperature")[1]
    assert said(findings, "scene")[0]
    assert all("\n" not in finding.said for finding in findings)
    monkeypatch.setattr(gpio_chip, "find_chip", lambda *_: "/dev/gpiochip0")
    monkeypatch.setattr(gpio_chip, "find_lines", lambda *_: {"GPIO25": 25})
    for consumer, by in (("", "the kernel"), ("oscilloscope", "oscilloscope")):
        info = SimpleNamespace(used=True, consumer=consumer)
        chip = nullcontext(SimpleNamespace(get_line_info=lambda _, info=info: info))
        monkeypatch.setattr("gpiod.Chip", lambda _, chip=chip: chip)
        with pytest.raises(LinkError, match=f"line 'GPIO25' is in use by {by}: end it"):
            doctor._lines(SPI)


@pytest.mark.parametrize(
    "touch",
    [LinuxInputTouch(device="/dev/input/none", grab=True, **AXES), EloTouch(device="/dev/ttyNONE", **AXES)],
)
def test_a_panel_that_is_not_there_is_one_line(board, touch):
    good, text = said(look(with_tables(board, touch=touch), VirtualClock().now_s), "touch panel")
    assert not good
    assert touch.device in text


@each_row(
    ("share", "node", "expected"),
    [
        (False, "", "no other program on this machine gets its touches; [touch] share = true hands them on"),
        (True, "/dev/null", "its contacts are handed on"),
        (True, "/dev/none", "not handed on to other programs: there is no /dev/none: load the kernel module uinput"),
    ],
)
def test_whether_other_programs_get_the_touches_of_a_panel_is_said(board, monkeypatch, share, node, expected):
    monkeypatch.setattr(screen, "NODE", Path(node))
    host, panel = os.openpty()
    touch = EloTouch(device=os.ttyname(panel), share=share, **AXES)
    (found,) = [
        finding for finding in look(with_tables(board, touch=touch), VirtualClock().now_s) if finding.about == "touch panel"
    ]
    os.close(host)
    os.close(panel)
    assert (found.good, found.warns) == (True, node == "/dev/none")
    assert expected in found.said


def test_a_serial_port_that_is_not_there_is_one_line(board):
    link = msgspec.structs.replace(SPI, kind="serial", device="/dev/ttyNONE")
    good, text = said(look(with_tables(board, link=link), VirtualClock().now_s), "serial port")
    assert not good
    assert "there is no serial port /dev/ttyNONE" in text


@each_row(("bufsiz", "good", "text"), [(8192, True, "one message"), (4096, True, "two messages"), (4095, False, "8192")])
def test_the_buffer_of_spidev_is_evaluated(board, monkeypatch, bufsiz, good, text):
    monkeypatch.setattr(spi_device, "read_bufsiz", lambda: bufsiz)
    found = said(look(with_tables(board, link=SPI), VirtualClock().now_s), "spidev buffer")
    assert found[0] is good
    assert text in found[1]


@each_row("limit", [0, 49, 50, resource.RLIM_INFINITY])
def test_what_a_user_may_ask_of_the_scheduler_is_evaluated(board, monkeypatch, limit):
    monkeypatch.setattr(process_limits.os, "geteuid", lambda: 1000)
    monkeypatch.setattr(process_limits.resource, "getrlimit", lambda _: (limit, limit))
    findings = look(with_tables(board, link=SPI), VirtualClock().now_s)
    assert said(findings, "priority")[0] is (limit in (50, resource.RLIM_INFINITY))
    assert said(findings, "locked memory")[0] is (limit == resource.RLIM_INFINITY)
    without = Realtime(priority=0, lock_memory=False)
    findings = look(with_tables(board, link=SPI, realtime=without), VirtualClock().now_s)
    assert said(findings, "priority") == (True, "none is asked for")
    assert said(findings, "locked memory") == (True, "not asked for")
    nowhere = Realtime(priority=0, cpu=1023)
    assert "no core 1023" in said(look(with_tables(board, link=SPI, realtime=nowhere), VirtualClock().now_s), "priority")[1]


def test_a_damaged_scene_and_a_missing_bank_are_named(board, tmp_path):
    (tmp_path / "scene.toml").write_text("nonsense = 1\n")
    findings = look(with_tables(board, scene=str(tmp_path / "scene.toml")), VirtualClock().now_s)
    assert "nonsense" in said(findings, "scene")[1]
    findings = look(
        with_tables(board, folder=tmp_path / "never-built", scene=str(find_board("simulated") / "scene.toml")), VirtualClock().now_s
    )
    assert "haptic-panel bank build --board" in said(findings, "bank")[1]


@pytest.fixture
def panel(board, tmp_path, monkeypatch):
    """A board of /etc on SPI with a bank that only root may read, where `nobody` is the service's user."""
    folder = tmp_path / "etc" / "panel"
    folder.mkdir(parents=True)
    text = (find_board("ulx3s") / "board.toml").read_text()
    scene = folder / "scene.toml"
    scene.write_text('[[regions]]\nname = "spot"\nshape = "circle"\nx_mm = 100\ny_mm = 70\nradius_mm = 5\neffects = ["click"]\n')
    (folder / "board.toml").write_text(
        text.replace("../simulated/scene.toml", "scene.toml").replace("pitch_mm = 2.5", "pitch_mm = 40\ncoarse = true")
    )
    monkeypatch.setattr(lookup, "SYSTEM_BOARDS", folder.parent)
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path / "state"))
    monkeypatch.setattr(doctor, "service_user", lambda: pwd.getpwnam("nobody"))
    for place in (tmp_path, *tmp_path.parents):
        if place.owner() == "root" and place != Path("/tmp"):
            place.chmod(place.stat().st_mode | 0o11)
    found = load_board(folder)
    build_bank(BankRequest(found, bank_path(found)))
    bank_path(found).chmod(0o600)
    return found


@pytest.fixture
def systemctl(tmp_path, monkeypatch):
    """A program of that name: the file in which it notes its arguments, and what sets its answer."""
    program = tmp_path / "programs" / "systemctl"
    program.parent.mkdir()
    asked = program.with_name("systemctl.asked")
    monkeypatch.setenv("PATH", f"{program.parent}:{os.environ['PATH']}")

    def tell(answer, first=""):
        asked.unlink(missing_ok=True)
        program.write_text(f'#!/bin/sh\necho "$*" >>"$0.asked"\n{first}\ncat <<E\n{answer}E\n')
        program.chmod(0o755)

    monkeypatch.setattr(doctor, "service_user", lambda: pwd.getpwuid(os.geteuid()))
    return asked, tell


def test_the_services_user_is_evaluated_by_the_limits_of_its_unit(panel, systemctl):
    asked, tell = systemctl
    tell("LoadState=loaded\nLimitRTPRIO=50\nLimitMEMLOCK=infinity\n")
    findings = look(panel, VirtualClock().now_s)
    assert said(findings, "user") == (True, f"looked at as {pwd.getpwuid(os.geteuid()).pw_name}, as which the service runs")
    assert said(findings, "priority") == (True, "SCHED_FIFO 50 is permitted")
    assert said(findings, "locked memory") == (True, "permitted")
    tell("LoadState=loaded\nLimitRTPRIO=0\nLimitMEMLOCK=8388608\n")
    findings = look(panel, VirtualClock().now_s)
    assert "the unit may ask for 0, the board for 50" in said(findings, "priority")[1]
    assert "the unit may lock 8 MiB" in said(findings, "locked memory")[1]
    tell("LoadState=not-found\n")
    assert "is not installed" in said(look(panel, VirtualClock().now_s), "priority")[1]
    assert asked.read_text().startswith("show --property=LoadState")


def test_systemd_that_fails_once_is_asked_again_and_one_that_keeps_failing_is_quoted(panel, systemctl):
    _, tell = systemctl
    tell("LoadState=loaded\nLimitRTPRIO=50\nLimitMEMLOCK=infinity\n", "[ $(wc -l <$0.asked) = 1 ] && exit 1")
    assert said(look(panel, VirtualClock().now_s), "priority") == (True, "SCHED_FIFO 50 is permitted")
    tell("", "echo 'Failed to connect to bus: Connection timed out' >&2; exit 1")
    good, text = said(look(panel, VirtualClock().now_s), "priority")
    assert not good
    assert "systemctl ended with exit code 1: Failed to connect to bus: Connection timed out (2 attempts)" in text


def test_another_user_is_informed_that_the_service_may_do_other_things(panel, monkeypatch):
    monkeypatch.setattr(process_limits.os, "geteuid", lambda: 12345)
    (finding,) = [finding for finding in look(panel, VirtualClock().now_s) if finding.about == "user"]
    assert (finding.good, finding.warns) == (True, True)
    assert finding.said == "looked at as 12345; the service runs as haptic-panel, and may do other things"


def test_without_the_services_user_one_is_advised_to_install_it(panel, monkeypatch):
    monkeypatch.setattr(doctor, "service_user", lambda: None)
    assert "there is no user haptic-panel, as which the service runs" in said(look(panel, VirtualClock().now_s), "user")[1]


def test_a_modelled_bank_on_a_real_panel_is_warned_of(panel, board, capsys, monkeypatch):
    monkeypatch.setattr(doctor, "service_user", lambda: None)
    (finding,) = [finding for finding in look(panel, VirtualClock().now_s) if finding.about == "responses"]
    assert (finding.good, finding.warns) == (True, True)
    assert "a real one is not focused by it" in finding.said
    main(["doctor", "--board", str(panel.folder)])
    assert re.search(r"^WARNING responses +the bank was computed from a model", capsys.readouterr().out, re.MULTILINE)
    assert "responses" not in {finding.about for finding in look(board, VirtualClock().now_s)}, "simulated, it is the right one"


def test_an_fpga_that_cannot_watch_its_clock_is_warned_of_with_what_its_supply_must_do(panel, monkeypatch):
    monkeypatch.setattr(doctor, "service_user", lambda: None)
    assert "lost clock" not in {finding.about for finding in look(panel, VirtualClock().now_s)}, "nothing is known of it"
    for device, warns, about in (("ecp5 25k CABGA381-6", False, "own oscillator"), ("ice40 hx8k ct256", True, "pump of hv_alive")):
        identity = Identity(board="own", top="own", device=device, seed=1, parameters={}, sources="", tools={})
        bitstream_path(panel).write_bytes(sealed(b"\xff\x00" + identity.comment().encode() + b"\0\xff\xff\xff\xbd\xb3"))
        (finding,) = [finding for finding in look(panel, VirtualClock().now_s) if finding.about == "lost clock"]
        assert (finding.good, finding.warns) == (True, warns)
        assert about in finding.said


def test_a_measured_bank_is_reported_with_its_files_date_temperature_and_expected_share(panel, monkeypatch):
    monkeypatch.setattr(doctor, "service_user", lambda: None)
    files, kept, identity = (SourceFile("plate.npz", "ab" * 32),), (0.997, 0.99), "0" * 16
    reported = Provenance("measured", "cosines", files, "2026-11-20", 23.5, 2072, kept, (0.0, 0.02), identity)
    model = ResponseModel(panel)
    model.provenance = reported
    build_bank(BankRequest(panel, bank_path(panel), source=model))
    for here, warns in (("1" * 16, True), (identity, False)):
        monkeypatch.setattr(doctor, "panel_identity", lambda here=here: here)
        (finding,) = [finding for finding in look(panel, VirtualClock().now_s) if finding.about == "responses"]
        assert (finding.good, finding.warns) == (True, warns)
        assert ("measured on another panel" in finding.said) is warns
    assert finding.said == (
        "the bank's responses are measured: 2072 points; plate.npz; 2026-11-20; 23.5 °C; cosines; keeps 0.997 of the amplitude,"
        " 0.99 at least"
    )


def examined(board, model, channels=range(32)):
    clock = VirtualClock()
    link = SimulatedLink(board.link, clock.now_s, model)
    return link, examine_link(board, link, lambda: Session(link, board, 5, clock.now_s), clock, 3e4, Chirps(channels))


def model_of(board, build=5):
    return GatewareModel(BuildParameters.of(board, build))


def test_a_good_link_has_a_proposal_a_bound_and_no_complaint(board):
    link, found = examined(board, model_of(board))
    assert all(finding.good for finding in found.findings)
    assert found.figures["proposed_sck_hz"] == board.link.sck_hz == link.sck_hz
    assert found.figures["bit_errors"]["error_rate_at_most"] < 1.2e-4
    assert [speed["errors"] for speed in found.figures["sweep"]] == [0] * 9


def test_foreign_gateware_and_a_missing_permit_are_found(board):
    _, found = examined(board, model_of(board, build=6))
    assert "BUILD_HASH" in said(found.findings, "link")[1]
    clock = VirtualClock()
    model = model_of(board)
    link = SimulatedLink(board.link, clock.now_s, model)
    model.permit(1, level=False, which=Permit.RUN)

    def session():
        return Session(link, board, 5, clock.now_s)

    found = examine_link(board, link, session, clock, 1e4, Chirps([3]))
    assert "run permit" in said(found.findings, "link")[1]
    found = examine_link(board, link, session, clock, 1e4, Chirps([]))
    link.close()
    assert all(finding.good for finding in found.findings)
    assert not link.take_capture().hv.any(), "without chirps nothing is armed"
    assert "no channel was asked for" in said(found.findings, "board")[1]


def test_the_command_ends_with_1_if_anything_is_wrong_and_shows_it_as_json(capsys):
    code = main(["doctor", "--link", "--bits", "1e4", "--no-chirps", "--json"])
    figures = json.loads(capsys.readouterr().out)
    assert code == (0 if figures["good"] else 1)
    assert {finding["about"] for finding in figures["findings"]} >= {"touch panel", "identity and settings", "SCK", "bits"}
    assert len(figures["sweep"]) == 9
    assert main(["doctor", "--board", "ulx3s"]) in (0, 1)
    table = capsys.readouterr().out
    assert table.splitlines()[0].startswith(("ok", "NOT OK"))


@each_row(
    ("measured_hz", "good", "arriving"),
    [
        (25.2e6, True, True),
        (19.6e6, True, True),
        (17.6e6, True, True),
        (17.4e6, False, True),
        (12.5e6, False, False),
        (10e6, False, False),
    ],
)
def test_the_sck_that_frames_show_is_evaluated_by_the_one_that_times_are_based_on(board, measured_hz, good, arriving):
    """With a Pi 4's core clock at 200 MHz, 25 MHz asked for is 10; nothing is played while it arrives then."""
    finding = evaluated_sck(board, measured_hz, 25e6)
    assert finding.good is good
    assert f"{measured_hz / 1e6:.3g} MHz" in finding.said
    assert ("plays nothing while it arrives below 16.4 MHz" in finding.said) is not arriving
    assert good or "hold the core clock" in finding.said


def test_a_link_set_to_less_is_evaluated_by_that(board):
    assert evaluated_sck(board, 9.8e6, 10e6).good


def test_playing_while_it_arrives_needs_what_the_gateware_asks_for(board):
    assert arriving_sck_hz(board) == pytest.approx(16.4e6, rel=2e-3)

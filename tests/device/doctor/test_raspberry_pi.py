"""What `doctor` finds in the files of a Raspberry Pi: a tree of them stands for the machine."""

import re
import subprocess

import msgspec
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.devices import Realtime
from controller.device.board.lookup import data_folder, find_board
from controller.device.doctor import doctor
from controller.device.doctor.raspberry_pi import _numbers, look_at_pi
from controller.device.fpga.frames import UPLOAD_BYTES
from controller.device.touch.panels.gt911 import Gt911Touch

PI_4, PI_5 = load_board(find_board("ulx3s")), load_board(find_board("ulx3s_pi5"))
OWN_CORE = Realtime(cpu=3)
AS_THE_PAGE_SAYS = {
    "proc/device-tree/model": "Raspberry Pi 4 Model B Rev 1.5\0",
    "proc/sys/kernel/osrelease": "6.12.34+rpt-rpi-v8\n",
    "proc/sys/kernel/sched_rt_runtime_us": "-1\n",
    "proc/sys/kernel/sched_rt_period_us": "1000000\n",
    "proc/irq/default_smp_affinity": "7\n",
    "boot/firmware/config.txt": "dtparam=spi=on\n[pi4]\ncore_freq_min=500\n[all]\n",
    "sys/module/spi_bcm2835/parameters/polling_limit_us": "250\n",
    "sys/devices/system/cpu/cpu0/cpufreq/scaling_governor": "performance\n",
    "sys/devices/system/cpu/cpu3/cpufreq/scaling_governor": "performance\n",
    "sys/devices/system/cpu/isolated": "3\n",
    "sys/devices/system/cpu/present": "0-3\n",
    "usr/bin/vcgencmd": '#!/bin/sh\n[ "$1" = get_throttled ] && echo throttled=0x0\n',
}


@pytest.fixture
def found(tmp_path):
    """What is found on a Pi set up as the page says, but for these files (None: not there): {about: finding}."""

    def look(board=PI_4, realtime=OWN_CORE, **changes):
        changed = {path.replace("__", "/"): text for path, text in changes.items()}
        for path, text in (AS_THE_PAGE_SAYS | changed).items():
            if text is not None:
                (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
                (tmp_path / path).write_text(text)
                (tmp_path / path).chmod(0o755)
        findings = look_at_pi(msgspec.structs.replace(board, realtime=realtime), tmp_path)
        assert len({finding.about for finding in findings}) == len(findings)
        assert all("\n" not in finding.said and "\0" not in finding.said for finding in findings)
        return {finding.about: finding for finding in findings}

    return look


def verdict(finding):
    return "NOT OK" if not finding.good else "WARNING" if finding.warns else "ok"


def test_a_pi_set_up_as_the_page_says_has_nothing_to_mend(found):
    findings = found()
    assert {about: verdict(finding) for about, finding in findings.items()} == dict.fromkeys(
        ["kernel", "core clock", "SPI polling", "governor", "isolated core", "real-time limit", "supply and heat"], "ok"
    )
    assert findings["kernel"].said == "Linux 6.12.34+rpt-rpi-v8 on a Raspberry Pi 4 Model B Rev 1.5"


@each_row(
    ("path", "text", "about", "wanted", "advice"),
    [
        ("boot/firmware/config.txt", "dtparam=spi=on\n", "core clock", "NOT OK", "core_freq_min=500"),
        ("boot/firmware/config.txt", "#force_turbo=1\n", "core clock", "NOT OK", "core_freq_min=500"),
        ("boot/firmware/config.txt", "force_turbo = 1  # and hot\n", "core clock", "ok", "force_turbo"),
        ("boot/firmware/config.txt", "[pi3]\nforce_turbo=1\n", "core clock", "NOT OK", "core_freq_min=500"),
        ("boot/firmware/config.txt", "[pi3]\n[all]\ncore_freq_min=500\n", "core clock", "ok", "500 MHz"),
        ("boot/firmware/config.txt", "core_freq_min=500\ncore_freq_min=250\n", "core clock", "NOT OK", "core_freq_min=500"),
        ("sys/module/spi_bcm2835/parameters/polling_limit_us", "30", "SPI polling", "WARNING", "spi_bcm2835.polling_limit_us=250"),
        ("sys/module/spi_bcm2835/parameters/polling_limit_us", "165", "SPI polling", "WARNING", "spi_bcm2835.polling_limit_us=250"),
        ("sys/module/spi_bcm2835/parameters/polling_limit_us", "200", "SPI polling", "ok", "no interrupt"),
        ("sys/devices/system/cpu/cpu3/cpufreq/scaling_governor", "ondemand", "governor", "WARNING", "default_governor=performance"),
        ("sys/devices/system/cpu/isolated", "\n", "isolated core", "WARNING", "isolcpus=3 irqaffinity=0-2"),
        ("sys/devices/system/cpu/isolated", "(null)\n", "isolated core", "WARNING", "isolcpus=3 irqaffinity=0-2"),
        ("sys/devices/system/cpu/isolated", "1-2\n", "isolated core", "WARNING", "isolcpus=3"),
        ("sys/devices/system/cpu/isolated", "1,2-3\n", "isolated core", "ok", "core 3"),
        ("proc/irq/default_smp_affinity", "f\n", "isolated core", "WARNING", "irqaffinity=0-2"),
        ("proc/sys/kernel/sched_rt_runtime_us", "950000\n", "real-time limit", "WARNING", "kernel.sched_rt_runtime_us=-1"),
        ("usr/bin/vcgencmd", "#!/bin/sh\necho throttled=0x50005\n", "supply and heat", "NOT OK", "under-voltage, throttled now"),
        ("usr/bin/vcgencmd", "#!/bin/sh\necho throttled=0xe0000\n", "supply and heat", "WARNING", "too hot since the start"),
    ],
)
def test_what_is_set_otherwise_is_one_line_with_what_to_do(found, path, text, about, wanted, advice):
    findings = found(**{path.replace("/", "__"): text})
    assert verdict(findings.pop(about)) == wanted
    assert {verdict(finding) for finding in findings.values()} == {"ok"}
    assert advice in found(**{path.replace("/", "__"): text})[about].said


@each_row(("core", "others"), [(0, "1-3"), (1, "0"), (2, "0-1"), (3, "0-2")])
def test_interrupts_go_to_the_cores_below_that_of_the_loop(found, core, others):
    said = found(realtime=Realtime(cpu=core), sys__devices__system__cpu__isolated="")["isolated core"].said
    assert f"isolcpus={core} irqaffinity={others} to " in said


def test_a_loop_without_a_core_of_its_own_is_informed_which_to_take(found):
    assert "set realtime.cpu = 3 in board.toml" in found(realtime=Realtime())["isolated core"].said
    said = found(realtime=Realtime(), sys__devices__system__cpu__isolated="")["isolated core"].said
    assert "isolcpus=3 irqaffinity=0-2" in said
    assert "set realtime.cpu = 3 in board.toml" in said
    assert "real-time limit" not in found(realtime=Realtime(priority=0, cpu=3), proc__sys__kernel__sched_rt_runtime_us="950000")


def test_the_spi_of_another_model_is_reported(found):
    on_pi_5 = {"proc__device-tree__model": "Raspberry Pi 5 Model B Rev 1.0\0"}
    assert found(**on_pi_5)["SPI clock"].said == (
        "board.toml says 500 MHz, this model has 200: set link.spi_source_hz = 200_000_000"
    )
    findings = found(PI_5, **on_pi_5)
    assert not {"SPI clock", "core clock"} & findings.keys(), "of a Pi 5 neither follows the core clock"
    assert findings["kernel"].good


@each_row(("release", "good"), [("6.1.0-rpi8-rpi-2712", False), ("6.6.20+rpt-rpi-2712", False), ("6.6.31+rpt", True)])
def test_a_kernel_of_a_pi_5_whose_spi_times_out_is_refused(found, release, good):
    changes = {"proc__device-tree__model": "Raspberry Pi 5 Model B Rev 1.0\0", "proc__sys__kernel__osrelease": release}
    assert found(PI_5, **changes)["kernel"].good is good
    assert found(proc__sys__kernel__osrelease=release)["kernel"].good, "a Pi 4's does not"


@each_row(
    ("model", "mhz"),
    [("3 Model B Plus Rev 1.3", 400), ("Zero 2 W Rev 1.0", 400), ("400 Rev 1.0", 500), ("Compute Module 4 Rev 1.1", 500)],
)
def test_the_core_clock_that_is_held_is_that_of_the_model(found, model, mhz):
    board = msgspec.structs.replace(PI_4, link=msgspec.structs.replace(PI_4.link, spi_source_hz=mhz * 1_000_000))
    changes = {"proc__device-tree__model": f"Raspberry Pi {model}", "boot__firmware__config.txt": "#\n"}
    findings = found(board, **changes)
    assert f"core_freq_min={mhz} " in findings["core clock"].said
    assert "SPI clock" not in findings


def test_a_touch_panel_on_the_pis_own_i2c_is_warned_of(found):
    touch = Gt911Touch(
        bus="/dev/i2c-1",
        interrupt_chip="pinctrl-bcm2711",
        interrupt_line="GPIO4",
        x_mm_from_axes=(1, 0, 0),
        y_mm_from_axes=(0, 1, 0),
    )
    board = msgspec.structs.replace(PI_4, touch=touch)
    assert "i2c-gpio" in found(board, **{"sys__class__i2c-dev__i2c-1__name": "bcm2835 (i2c@7e804000)"})["I2C clock"].said
    assert "I2C clock" not in found(board, **{"sys__class__i2c-dev__i2c-1__name": "i2c-gpio"})


def test_what_cannot_be_read_is_left_out(tmp_path):
    (tmp_path / "proc/device-tree").mkdir(parents=True)
    (tmp_path / "proc/device-tree/model").write_text("Raspberry Pi 4 Model B Rev 1.5\0")
    assert [finding.about for finding in look_at_pi(PI_4, tmp_path)] == ["kernel"]


@each_row("model", [None, "Radxa ROCK 5B\0", "\xff\xfe"])
def test_nothing_is_said_on_another_machine(tmp_path, model):
    if model is not None:
        (tmp_path / "proc/device-tree").mkdir(parents=True)
        (tmp_path / "proc/device-tree/model").write_bytes(model.encode("latin-1"))
    assert look_at_pi(PI_4, tmp_path) == []


def test_nothing_is_said_of_a_board_without_spi(found):
    assert found(load_board(find_board("simulated"))) == {}


def test_doctor_looks_at_the_pi(monkeypatch):
    monkeypatch.setattr(doctor, "look_at_pi", lambda _: [doctor.Finding("governor", True, "performance")])
    assert doctor.look(PI_4, lambda: 0.0)[-1].about == "governor"


CONFIG = "# For more options see the documentation\ndtparam=audio=on\n[cm4]\notg_mode=1\n[pi4]\ncore_freq_min=250\n"
CMDLINE = "console=serial0,115200 console=tty1 root=PARTUUID=4e639091-02 rootfstype=ext4 rootwait isolcpus=2 quiet\n"


@pytest.fixture
def image(tmp_path):
    """The files of an image of Raspberry Pi OS that the script changes."""
    (tmp_path / "boot/firmware").mkdir(parents=True)
    (tmp_path / "boot/firmware/config.txt").write_text(CONFIG)
    (tmp_path / "boot/firmware/cmdline.txt").write_text(CMDLINE)
    return tmp_path


def set_up(root):
    command = ["sh", data_folder("boards") / "raspberry_pi.sh", root]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def contents(root):
    return {path.relative_to(root): path.read_text() for path in root.rglob("*") if path.is_file()}


def test_the_script_sets_what_doctor_asks_for_and_keeps_what_was_there(image):
    done = set_up(image)
    assert (done.returncode, done.stderr) == (0, "")
    after = {str(path): text for path, text in contents(image).items()}
    assert sorted(after) == ["boot/firmware/cmdline.txt", "boot/firmware/config.txt", "etc/sysctl.d/60-haptic-panel.conf"]
    assert after["boot/firmware/config.txt"].startswith(CONFIG)
    (line,) = after["boot/firmware/cmdline.txt"].splitlines()
    kept = [word for word in CMDLINE.split() if word != "isolcpus=2"]
    assert line.split()[: len(kept)] == kept
    words = dict(word.split("=", 1) for word in line.split()[len(kept) :])
    machine = AS_THE_PAGE_SAYS | {  # what firmware and kernel make of it
        "boot/firmware/config.txt": after["boot/firmware/config.txt"],
        "sys/module/spi_bcm2835/parameters/polling_limit_us": words["spi_bcm2835.polling_limit_us"],
        "sys/devices/system/cpu/cpu3/cpufreq/scaling_governor": words["cpufreq.default_governor"],
        "sys/devices/system/cpu/isolated": words["isolcpus"],
        "proc/irq/default_smp_affinity": f"{sum(1 << core for core in _numbers(words['irqaffinity'])):x}",
        "proc/sys/kernel/sched_rt_runtime_us": re.search(
            r"sched_rt_runtime_us = (\S+)", after["etc/sysctl.d/60-haptic-panel.conf"]
        )[1],
    }
    for path, text in machine.items():
        (image / path).parent.mkdir(parents=True, exist_ok=True)
        (image / path).write_text(text)
    findings = look_at_pi(msgspec.structs.replace(PI_4, realtime=OWN_CORE), image)
    assert {verdict(finding) for finding in findings} == {"ok"}
    assert int(words["spidev.bufsiz"]) >= 2 * UPLOAD_BYTES


def test_a_second_call_changes_nothing(image):
    set_up(image)
    before = contents(image)
    assert set_up(image).returncode == 0
    assert contents(image) == before


def test_a_tree_that_is_no_raspberry_pi_os_stays_as_it_was(image):
    (image / "boot/firmware/cmdline.txt").unlink()
    before = contents(image)
    done = set_up(image)
    assert done.returncode == 1
    assert done.stderr.startswith(f"raspberry_pi.sh: there is no {image}/boot/firmware/cmdline.txt: ")
    assert done.stderr.count("\n") == 1
    assert contents(image) == before


def test_the_page_names_every_setting_of_the_script():
    page = (data_folder("boards") / "raspberry_pi.md").read_text()
    script = (data_folder("boards") / "raspberry_pi.sh").read_text()
    (words,) = re.findall(r"^settings='(.*)'$", script, re.MULTILINE)
    for setting in [*words.split(), "dtparam=spi=on", "core_freq_min=500", "kernel.sched_rt_runtime_us = -1"]:
        assert setting in script
        assert setting in page


FILES = sorted(path for path in AS_THE_PAGE_SAYS if path != "usr/bin/vcgencmd")


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow], max_examples=60)
@given(st.sampled_from(FILES), st.one_of(st.text(), st.from_regex(r"[-0-9a-f,]{1,9}\n?", fullmatch=True)))
@example("sys/module/spi_bcm2835/parameters/polling_limit_us", "²")
@example("proc/sys/kernel/osrelease", "\x00")
@example("proc/sys/kernel/sched_rt_runtime_us", "none")
@example("proc/sys/kernel/sched_rt_period_us", "0")
@example("proc/irq/default_smp_affinity", "x")
def test_no_content_of_a_file_ends_doctor(found, path, text):
    found(**{path.replace("/", "__"): text.encode(errors="replace").decode()})

"""What container and guest files ask systemd about the service, and how they wait for it."""

import re
import subprocess
from functools import partial
from pathlib import Path

import panel_board
import patience

from controller.device.bank.reader import Bank
from controller.device.board.board import load_board

CHECKOUT = Path(__file__).parents[2]
UNIT = "haptic-panel"
BANK = Path("/var/lib/haptic-panel/banks/panel.v9.bank")


def run(*command, cwd=CHECKOUT):
    """Output of a command that must succeed."""
    done = subprocess.run(command, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    assert done.returncode == 0, f"{command}: exit code {done.returncode}\n{done.stdout}\n{journal()}"
    return done.stdout


def install(*skipped):
    """The steps of systemd/README.md that follow the package, but for those that name what is not here, or is there already."""
    blocks = re.findall(r"^```sh\n(.*?)^```", (CHECKOUT / "systemd/README.md").read_text(), re.MULTILINE | re.DOTALL)
    (steps,) = [block for block in blocks if "systemd-sysusers" in block]
    for step in steps.splitlines():
        if not any(name in step for name in (" /usr/", *skipped)):
            run("sh", "-c", step)


def shown(name):
    """A property of the unit."""
    return run("systemctl", "show", "--value", "-p", name, UNIT).strip()


def main_pid():
    """Its process; 0: none."""
    return int(shown("MainPID"))


def status_of(pid, name):
    """A field of /proc/PID/status."""
    return re.search(rf"^{name}:\s*(.*)$", Path(f"/proc/{pid}/status").read_text(), re.MULTILINE)[1]


def journal(*options):
    """All that the unit and systemd about it have said so far; options of journalctl choose among it."""
    subprocess.run(["journalctl", "--sync"], check=False)
    command = ["journalctl", "--no-pager", "-o", "cat", "-u", UNIT, *options]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


def said():
    """What the process that runs now has said."""
    subprocess.run(["journalctl", "--sync"], check=False)
    return run("journalctl", "--no-pager", "-o", "cat", f"_SYSTEMD_INVOCATION_ID={shown('InvocationID')}")


# each look is a process or more, which a virtual machine has less time for than for what is waited for
wait_for = partial(
    patience.wait_for, seconds=120.0, said=lambda: journal("-o", "short-precise", "-u", f"{UNIT}-*")[-4000:], every_s=0.2
)


def restarted(old_pid):
    """Whether another process of the unit is ready."""
    return main_pid() not in (0, old_pid) and shown("SubState") == "running" and shown("ActiveState") == "active"


def fresh_start():
    """The service started from rest, with its count of failed starts forgotten; its process."""
    run("systemctl", "stop", UNIT)
    subprocess.run(["systemctl", "reset-failed", UNIT], check=False, capture_output=True)
    run("systemctl", "start", UNIT)
    return main_pid()


def cell(number):
    """A cell's place in m, and its drive words."""
    with Bank.open(BANK, load_board(panel_board.BOARD)) as bank:
        return bank.grid.place(number), bytes(bank.drive.words(number))


def wait_for_emission(far_end, words, tap):
    """Tap until just these drive words were on the channel pins of the FPGA."""
    far_end.emissions()

    def played():
        tap()
        return words in far_end.emissions()

    wait_for("the bank's entry on the pins", played)

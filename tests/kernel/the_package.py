"""What files in a Debian container (make_debian_tree.sh) do with dpkg and the packages of make_packages.sh."""

import subprocess
from pathlib import Path

from the_service import journal

PACKAGES = Path("/packages")
ENVIRONMENT = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "DEBIAN_FRONTEND": "noninteractive", "LC_ALL": "C.UTF-8", "HOME": "/root"}


def done(*command, code=0):
    """What a command says; it ends with this exit code."""
    ended = subprocess.run(
        command, env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, cwd="/"
    )
    assert ended.returncode == code, f"{command}: exit code {ended.returncode}\n{ended.stdout}{journal()}"
    return ended.stdout


def package(version):
    """Path of the package of a release."""
    (path,) = PACKAGES.glob(f"haptic-panel_{version}-1_*.deb")
    return str(path)


def install(version):
    """What apt says when it installs the package of a release, or changes to it."""
    return done("apt-get", "install", "-y", "-q", "--no-install-recommends", "--allow-downgrades", package(version))

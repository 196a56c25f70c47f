"""What files in a Debian container (make_debian_tree.sh) do with dpkg."""

import subprocess

ENVIRONMENT = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "DEBIAN_FRONTEND": "noninteractive", "LC_ALL": "C.UTF-8", "HOME": "/root"}


def done(*command, code=0):
    """What a command says; it ends with this exit code."""
    ended = subprocess.run(
        command, env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, cwd="/"
    )
    assert ended.returncode == code, f"{command}: exit code {ended.returncode}\n{ended.stdout}"
    return ended.stdout

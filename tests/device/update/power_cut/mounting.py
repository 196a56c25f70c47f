"""Loop devices and file systems, mounted and taken away again (as root)."""

import contextlib
import ctypes
import mmap
import os
import subprocess
import sys
from pathlib import Path

LIBC = ctypes.CDLL(None, use_errno=True)
ERROR_COUNT_OFFSET = 1024 + 0x194  # of an ext4: errors that its kernel has found
NEW_NAMESPACE = 0x00020000  # CLONE_NEWNS
PRIVATE = 0x4000 | 0x40000  # MS_REC, MS_PRIVATE


def own_mounts():
    """Mount nothing that others see: a container that starts meanwhile would keep it mounted. Raises OSError without root."""
    if LIBC.unshare(NEW_NAMESPACE) or LIBC.mount(None, b"/", None, PRIVATE, None):
        raise OSError(ctypes.get_errno(), f"{os.strerror(ctypes.get_errno())}: mounting needs root")


def require_unused(device):
    """Raises OSError where a device is mounted still: the next mount would show the old file system."""
    os.close(os.open(device, os.O_RDONLY | os.O_EXCL))


def mount(device, folder, options=""):
    """Mount an ext4. Raises OSError where the kernel refuses."""
    if LIBC.mount(str(device).encode(), str(folder).encode(), b"ext4", 0, options.encode()):
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()), str(folder))


def unmount(folder):
    """Take a file system away. Raises OSError where something still uses it."""
    if LIBC.umount2(str(folder).encode(), 0):
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()), str(folder))


@contextlib.contextmanager
def loop_device(file):
    """A block device on a file."""
    made = subprocess.run(["losetup", "-f", "--show", file], capture_output=True, text=True, check=False)
    if made.returncode:
        raise OSError(f"no loop device: {made.stderr.strip()}; root and /dev/loop-control are needed")
    device = made.stdout.strip()
    try:
        yield device
    finally:
        subprocess.run(["losetup", "-d", device], check=True)


@contextlib.contextmanager
def recording_disk(folder, size_bytes, log):
    """The disk of recording_disk.py at a new folder; yields a block device on it and the file that takes marks."""
    folder.mkdir()
    program = Path(__file__).with_name("recording_disk.py")
    with subprocess.Popen([sys.executable, program, folder, str(size_bytes), log], stdout=subprocess.PIPE, text=True) as server:
        if server.stdout.readline() != "mounted\n":
            raise OSError("no disk served by FUSE; root, /dev/fuse and libfuse3 are needed")
        try:
            with loop_device(folder / "disk") as device:
                yield device, folder / "mark"
        finally:
            subprocess.run(["umount", "--lazy", folder], check=True)  # the kernel lets go of the loop device when it likes to
    if server.returncode:
        raise OSError(f"recording_disk.py ended with {server.returncode}")


@contextlib.contextmanager
def memory_of(file, size_bytes):
    """A file of a size, mapped."""
    with Path(file).open("w+b") as opened:
        opened.truncate(size_bytes)
        with mmap.mmap(opened.fileno(), size_bytes) as memory:
            yield memory


def errors_found(image):
    """How many errors the kernel has found in an ext4, from its superblock."""
    return int.from_bytes(image[ERROR_COUNT_OFFSET : ERROR_COUNT_OFFSET + 4], "little")

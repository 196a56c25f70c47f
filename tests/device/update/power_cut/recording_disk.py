"""A disk in memory, for a loop device, that notes all writes, flushes and marks in the order in which they came: a folder of FUSE.

usage: recording_disk.py FOLDER SIZE_BYTES LOG     prints a line when it is there, ends when FOLDER is unmounted

FOLDER gets two files: `disk`, and `mark`, which takes names of what follows. One thread serves them, so that a write that had been
answered before a flush was asked for precedes it in the log too: what the kernel takes for safe is before the flush, always.
The loop device knows no forced unit access; the kernel makes a flush of it.
"""

import errno
import stat
import struct
import sys
from pathlib import Path

HEADER = struct.Struct("<cQQ")
WRITE, FLUSH, MARK = b"W", b"F", b"M"


def read_log(path):
    """Entries (kind, offset, data) of a log, in order."""
    data, at, entries = Path(path).read_bytes(), 0, []
    while at < len(data):
        kind, offset, length = HEADER.unpack_from(data, at)
        at += HEADER.size
        entries.append((kind, offset, data[at : at + length]))
        at += length
    return entries


def serve(folder, size_bytes, log):
    """Serve the disk until it is unmounted."""
    import mfusepy

    class Disk(mfusepy.Operations):
        use_ns = True

        def __init__(self):
            self.content = bytearray(size_bytes)

        def init(self, *_):
            print("mounted", flush=True)

        def note(self, kind, offset=0, data=b""):
            log.write(HEADER.pack(kind, offset, len(data)) + data)

        def getattr(self, path, _=None):
            if path == "/":
                return {"st_mode": stat.S_IFDIR | 0o700, "st_nlink": 2}
            if path not in {"/disk", "/mark"}:
                raise mfusepy.FuseOSError(errno.ENOENT)
            return {"st_mode": stat.S_IFREG | 0o600, "st_nlink": 1, "st_size": size_bytes if path == "/disk" else 0}

        def readdir(self, *_):
            return [".", "..", "disk", "mark"]

        def truncate(self, *_):
            return 0

        def read(self, _, size, offset, __):
            return bytes(self.content[offset : offset + size])

        def write(self, path, data, offset, _):
            if path == "/mark":
                self.note(MARK, data=data)
                log.flush()
            elif offset + len(data) > size_bytes:
                raise mfusepy.FuseOSError(errno.ENOSPC)
            else:
                self.content[offset : offset + len(data)] = data
                self.note(WRITE, offset, data)
            return len(data)

        def fsync(self, path, *_):
            if path == "/disk":
                self.note(FLUSH)
            return 0

    mfusepy.FUSE(Disk(), folder, foreground=True, nothreads=True, direct_io=True, fsname="recording_disk")


if __name__ == "__main__":
    with Path(sys.argv[3]).open("wb") as file:
        serve(sys.argv[1], int(sys.argv[2]), file)

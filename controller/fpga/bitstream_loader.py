"""Loading of an FPGA that answers with another gateware than this software's, by a program beside the loop; nothing here blocks."""

from __future__ import annotations

import contextlib
import os
import shlex
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path

from controller.board.devices import GatewareLoading
from controller.errors import LinkError
from controller.fpga.configuration import IncompatibleFpga, OtherGateware

SAID_BYTES = 4096  # of what the program says last
SAID_CHARACTERS = 160  # of its last line
ENDS_S = 1.0  # that a killed program may need; the service's watchdog bites after 3


class BitstreamLoader:
    """Loads a bitstream once for each time that the FPGA is found with another gateware.

    Parameters
    ----------
    settings : GatewareLoading
    bitstream : Path
        Looked for when it is needed.
    now_s : callable
        The loop's clock.
    """

    def __init__(self, settings: GatewareLoading, bitstream: Path, now_s: Callable[[], float]) -> None:
        self._command = [word.replace("{bitstream}", str(bitstream)) for word in settings.load]
        self._bitstream = bitstream
        self._limit_s = settings.limit_s
        self._now_s = now_s
        self._process: subprocess.Popen[bytes] | None = None
        self._said = -1  # file with what the process says
        self._until_s = 0.0
        self._found = ""  # what was wrong with the FPGA
        self._loaded = False  # and the FPGA was not found good since

    def require_done(self) -> None:
        """Call before the FPGA is sent anything.

        Raises
        ------
        LinkError
            While it is being loaded.
        IncompatibleFpga
            If that failed, or takes too long.
        """
        process = self._process
        if process is None:
            return
        code = process.poll()
        if code is None:
            if self._now_s() < self._until_s:
                raise LinkError(f"{self._found}: its gateware is being loaded: {shlex.join(self._command)}")
            self.close()
            raise IncompatibleFpga(f"{self._found}; {self._command[0]} did not end within {self._limit_s:g} s")
        said = self._last_line()
        self.close()
        if code:
            ended = f"was ended by {signal.Signals(-code).name}" if code < 0 else f"ended with exit code {code}"
            raise IncompatibleFpga(f"{self._found}; {self._command[0]} {ended}{': ' * bool(said)}{said}")
        self._loaded = True

    def begin(self, error: OtherGateware) -> None:
        """Load the FPGA, for this error.

        Raises
        ------
        LinkError
            Always, while this can still become good: try again later.
        IncompatibleFpga
            If there is nothing to load, or it was loaded already.
        """
        if self._loaded:
            raise IncompatibleFpga(f"{error}; it is so after {self._bitstream} was loaded") from error
        if not self._bitstream.is_file():
            raise IncompatibleFpga(
                f"{error}; {self._bitstream}: there is no such bitstream to load (gateware.bitstream)"
            ) from error
        self._said = os.memfd_create("loader")
        try:
            self._process = subprocess.Popen(
                self._command, stdin=subprocess.DEVNULL, stdout=self._said, stderr=self._said, start_new_session=True
            )
        except OSError as failure:
            self.close()
            raise IncompatibleFpga(
                f"{error}; {self._command[0]} cannot be started ({failure.strerror}): gateware.load"
            ) from failure
        self._found = str(error).partition(":")[0]
        self._until_s = self._now_s() + self._limit_s
        self.require_done()

    def good(self) -> None:
        """Note that the FPGA has the right gateware: it may be loaded again after it has lost it."""
        self._loaded = False

    def close(self) -> None:
        """End the program, if it runs."""
        if self._process is not None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGKILL)
            with contextlib.suppress(subprocess.TimeoutExpired):  # a driver that hangs keeps it
                self._process.wait(ENDS_S)
            self._process = None
        if self._said >= 0:
            os.close(self._said)
            self._said = -1

    def _last_line(self) -> str:
        size = os.fstat(self._said).st_size
        text = os.pread(self._said, SAID_BYTES, max(size - SAID_BYTES, 0)).decode(errors="replace")
        lines = [line.strip() for line in text.splitlines() if line.strip()]
        return "".join(filter(str.isprintable, lines[-1]))[-SAID_CHARACTERS:] if lines else ""

"""Loading of an FPGA that answers with another gateware than this software's, by a program beside the loop; nothing here blocks.

A loader that fails has not condemned the FPGA: it may have loaded it before, or do so at the next attempt. The FPGA is asked who it
is after each attempt, and its answer alone counts.
"""

from __future__ import annotations

import os
import shlex
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Final

from controller.device.board.devices import GatewareLoading
from controller.device.fpga.configuration import IncompatibleFpga
from controller.errors import LinkError
from controller.programs import SAID_BYTES, CannotStart, ProgramError, end, how_it_ended, last_line, start

ATTEMPTS: Final = 3  # a cable, a USB bus or a supply may fail for a moment


class BitstreamLoader:
    """Loads a bitstream, in up to `ATTEMPTS` attempts for each time that the FPGA is found with another gateware.

    The file is looked for when it is needed.
    """

    def __init__(self, settings: GatewareLoading, bitstream: Path, now_s: Callable[[], float]) -> None:
        self._command = [word.replace("{bitstream}", str(bitstream)) for word in settings.load]
        self._bitstream = bitstream
        self._limit_s = settings.limit_s
        self._now_s = now_s
        self._process: subprocess.Popen[bytes] | None = None
        self._said = -1  # file with what the process says
        self._until_s = 0.0
        self._found = ""  # what was wrong with the FPGA before the newest attempt
        self._attempts = 0  # since the FPGA was last found good
        self._failure = ""  # of the newest attempt; empty: it succeeded

    def require_done(self) -> None:
        """Call before the FPGA is sent anything; what it answers then says whether the attempt was successful.

        Raises LinkError while it is being loaded.
        """
        process = self._process
        if process is None:
            return
        code = process.poll()
        if code is None and self._now_s() < self._until_s:
            found = self._found.partition(":")[0]
            raise LinkError(f"{found}: its gateware is being loaded: {shlex.join(self._command)}")
        if code is None:
            end(process)
        said = self._last_line()
        self.close()
        if code is None:
            self._failure = f"{self._command[0]} did not end within {self._limit_s:g} s{': ' * bool(said)}{said}"
        else:
            self._failure = how_it_ended(self._command[0], code, said) if code else ""

    def begin(self, error: LinkError) -> None:
        """Load the FPGA, for what it answers, or does not.

        Always raises LinkError while this can still become good: try again later; it is `error` itself for an FPGA that does not
        answer and that no attempt has failed to load. Raises IncompatibleFpga if there is nothing to load, or it answers with
        another gateware after the last attempt.
        """
        if not isinstance(error, IncompatibleFpga):
            self._load_silent(error)
        elif self._attempts and not self._failure and str(error) != self._found:
            raise IncompatibleFpga(f"{error}; it is so after {self._bitstream} was loaded") from error
        elif self._attempts == ATTEMPTS:
            why = self._failure or f"{self._bitstream} was loaded"
            raise IncompatibleFpga(f"{error}; it is so after {ATTEMPTS} attempts to load it; {why}") from error
        if not self._bitstream.is_file():
            raise IncompatibleFpga(
                f"{error}; {self._bitstream}: there is no such bitstream to load (gateware.bitstream)"
            ) from error
        self._attempts += 1
        self._found = str(error)
        self._said = os.memfd_create("loader")
        try:
            self._process = start(self._command, self._said, self._said)
        except CannotStart as failure:
            self.close()
            raise IncompatibleFpga(f"{error}; {failure}: gateware.load") from failure
        except ProgramError as failure:  # no memory, no process: another time
            self.close()
            self._failure = str(failure)
            raise LinkError(f"{error}; {failure}") from failure
        self._until_s = self._now_s() + self._limit_s
        self.require_done()
        raise LinkError(f"{error}; {self._failure or 'it has just been loaded'}")  # ended at once: the FPGA is asked next time

    def good(self) -> None:
        """Note that the FPGA has the right gateware: it may be loaded again after it has lost it."""
        self._attempts = 0
        self._failure = ""

    def close(self) -> None:
        """End the program, if it runs."""
        if self._process is not None:
            end(self._process)
            self._process = None
        if self._said >= 0:
            os.close(self._said)
            self._said = -1

    def _load_silent(self, error: LinkError) -> None:
        """Raise unless an FPGA that does not answer is to be loaded: an attempt that failed half-way leaves it empty."""
        if not self._failure:
            raise error
        if self._attempts == ATTEMPTS:
            why, self._attempts, self._failure = self._failure, 0, ""  # it may be loaded again once it answers
            raise LinkError(f"{error}; it is so after {ATTEMPTS} attempts to load it; {why}") from error

    def _last_line(self) -> str:
        size = os.fstat(self._said).st_size
        return last_line(os.pread(self._said, SAID_BYTES, max(size - SAID_BYTES, 0)).decode(errors="replace"))

"""The FPGA at the far end of a serial port: the gateware's model, in a process that stays up whatever becomes of the service.

The time of each focus is noted, so that how long nothing could be felt is measured where it counts. An FPGA may begin empty, as
it is delivered: it answers nothing until a bitstream is loaded, and is then what the bitstream's parameters make of it.
"""

import contextlib
import multiprocessing
import os
import selectors
import socket
import time
import tty
from dataclasses import replace
from pathlib import Path

from controller.device.fpga.bitstreams.bitstream import read_identity
from controller.device.fpga.build_parameters import BuildParameters
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.serial_peer import UartPanel


class _Fpga:
    """The model behind its UART, and what its pins did."""

    def __init__(self, board, gateware_hash):
        self._board = board
        self._hv = 0
        self._focus_s = []
        self._between_frames = True
        self._flash = self._panel = None
        if gateware_hash is not None:
            self.configure(gateware_hash)

    def configure(self, gateware_hash):
        """Be a bitstream of this hash from now on, just out of reset."""
        self._begin(BuildParameters.of(self._board, gateware_hash))

    def program(self, option, file):
        """What openFPGALoader does by JTAG: configure the FPGA from a file, by way of the flash if asked to."""
        built = {name.lower(): value for name, value in read_identity(Path(file)).parameters.items()}
        parameters = replace(BuildParameters.of(self._board, 0), **built)
        if {"--write-sram": False, "--write-flash": True}[option]:
            self._flash = parameters
        self._begin(parameters)

    def lose_supply(self):
        """Be without supply for a moment, then what the flash has, or empty."""
        self._panel, self._hv = None, 0
        if self._flash is not None:
            self._begin(self._flash)

    def _begin(self, parameters):
        self._clock_hz = parameters.clock_hz
        self._panel = UartPanel(GatewareModel(parameters), self._clock_hz, self._board.link.baud, time.monotonic)
        self._start_s = self._panel.start_s  # one clock: by a later one a frame could begin in the past
        self._hv = 0

    def receive(self, data):
        """Bytes from the host; those of the answers."""
        if self._panel is None:
            return b""
        answers = self._panel.receive(data)
        self._between_frames = data.endswith(b"\0")
        self._note()
        return answers

    def permit(self, level):
        """Turn the switch of the run permit."""
        self._panel.gateware.permit(self._advance(), level=level, which=Permit.RUN)

    def hv(self):
        """Whether the outputs are on."""
        if self._panel is not None:
            self._advance()
        return bool(self._hv)

    def focus_times_s(self):
        """When each emission had its focus, on CLOCK_MONOTONIC; each is reported once."""
        times_s, self._focus_s = self._focus_s, []
        return times_s

    def _advance(self):
        """To the present, which a frame that has begun is too old for."""
        gateware = self._panel.gateware
        if self._between_frames:
            gateware.advance(max(round((time.monotonic() - self._start_s) * self._clock_hz), gateware.now))
            self._note()
        return gateware.now

    def _note(self):
        capture = self._panel.gateware.take_capture()
        if capture.hv.size:
            self._hv = int(capture.hv[-1])
        self._focus_s += (self._start_s + capture.focus_ticks / self._clock_hz).tolist()


class FarEnd:
    """An FPGA at a serial port.

    Parameters
    ----------
    board : Board
        Clock, baud rate and limits that the gateware is built for.
    gateware_hash : int or None
        None: it is empty.
    link : Path
        Becomes a symbolic link to the port.
    group : str
        Who may open it.
    jtag : Path, optional
        Unix socket through which a loader programs it: its option, a line break, the file.
    """

    def __init__(self, board, gateware_hash, link, group, jtag=None):
        context = multiprocessing.get_context("fork")
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(target=self._serve, args=(theirs, board, gateware_hash, jtag), daemon=True)
        self._process.start()
        theirs.close()
        device = Path(self._pipe.recv())
        os.chown(device, -1, group)
        device.chmod(0o660)
        link.unlink(missing_ok=True)
        link.symlink_to(device)

    def __getattr__(self, what):
        return lambda *arguments: self._ask(what, *arguments)

    def _ask(self, what, *arguments):
        self._pipe.send((what, arguments))
        return self._pipe.recv()

    @staticmethod
    def _serve(pipe, board, gateware_hash, jtag):
        fpga = _Fpga(board, gateware_hash)
        wire, terminal = os.openpty()  # the terminal stays open here, so that the service may come and go
        tty.setraw(terminal)
        os.set_blocking(wire, False)  # like a UART: bytes that nobody reads are lost
        loader = socket.socket(socket.AF_UNIX)
        if jtag is not None:
            loader.bind(str(jtag))
            jtag.chmod(0o666)  # a loader need not be root's
            loader.listen()
        pipe.send(os.ttyname(terminal))
        with selectors.DefaultSelector() as selector:
            selector.register(wire, selectors.EVENT_READ)
            selector.register(pipe, selectors.EVENT_READ)
            if jtag is not None:
                selector.register(loader, selectors.EVENT_READ)
            while True:
                ready = {key.fileobj for key, _ in selector.select()}
                if wire in ready:
                    answer = fpga.receive(os.read(wire, 4096))
                    with contextlib.suppress(BlockingIOError):
                        os.write(wire, answer)
                if pipe in ready:
                    what, arguments = pipe.recv()
                    pipe.send(getattr(fpga, what)(*arguments))
                if loader in ready:
                    with loader.accept()[0] as asked:
                        fpga.program(*asked.recv(4096).decode().split("\n"))
                        asked.sendall(b"done")

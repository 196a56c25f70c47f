"""Responses of a bank are read and checked beside the start of the service, so that outputs need not wait for 170 MB.

The loop maps responses and takes a page of them into its memory when it first uses it; by then they lie in the page cache, and one
that was found good is not checked again. One that was not reached yet, or is damaged, the loop checks itself when it is needed.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterable

from controller.device.bank.reader import Bank
from controller.errors import BankError
from controller.log import Event, log

NICE = 10


def check_responses_beside(bank: Bank, cells: Iterable[int]) -> None:
    """Check the responses of cells in a process of its own, which nobody waits for; damage is logged once.

    Call it before threads are started, memory is locked, and devices are open.
    """
    with contextlib.suppress(OSError):  # no process left: the loop checks what it uses
        child = os.fork()
        if child:
            os.waitpid(child, 0)  # it has ended: its own child has no parent that would have to wait for it
            return
        try:
            if os.fork() == 0:
                _check(bank, cells)
        finally:
            os._exit(0)


def _check(bank: Bank, cells: Iterable[int]) -> None:
    with contextlib.suppress(PermissionError):  # a sandbox may forbid it
        os.nice(NICE)
    first: BankError | None = None
    for cell in cells if bank.composes else ():
        try:
            bank.responses.verify(cell)
        except BankError as error:
            first = first or error
    if first is not None:
        log(f"{first}; what needs a damaged response is not played", Event.BANK_DAMAGED)

"""Asking several FPGAs as one: all are asked, whichever of them fails, and of their errors the one is raised that is a cause."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

from controller.device.fpga.configuration import IncompatibleFpga
from controller.device.fpga.registers import Fault
from controller.errors import ControllerError, FaultError, LinkError

Answer = TypeVar("Answer")


class NamedFpga:
    """Says of which FPGA an error is that comes from within."""

    def __init__(self, number: int) -> None:
        self._of = f"FPGA {number}"

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        if isinstance(error, ControllerError) and not str(error).startswith("FPGA "):
            error.args = (f"{self._of}: {error}", *error.args[1:])


def ask_all(fpgas: Sequence[NamedFpga], asks: Sequence[Callable[[], Answer]]) -> tuple[list[Answer], list[LinkError | FaultError]]:
    """What each FPGA answers, and the errors of those that do not; all are asked."""
    answers: list[Answer] = []
    failed: list[LinkError | FaultError] = []
    for named, ask in zip(fpgas, asks, strict=True):
        try:
            with named:
                answers.append(ask())
        except (LinkError, FaultError) as error:
            failed.append(error)
    return answers, failed


def answers_of_all(fpgas: Sequence[NamedFpga], asks: Sequence[Callable[[], Answer]]) -> list[Answer]:
    """As `ask_all`; raises the first error by its `rank`, once all have been asked."""
    answers, failed = ask_all(fpgas, asks)
    if failed:
        raise min(failed, key=rank)
    return answers


def rank(error: ControllerError) -> int:
    """Place of an error among those of all FPGAs: what stays and a fault of its own first, then an error of the link; what others
    cause last.

    An FPGA that hears nothing while the host waits for another is HOST_SILENT; NO_PERMIT is what the wire makes of either.
    """
    if not isinstance(error, FaultError):
        return 0 if isinstance(error, IncompatibleFpga) else 1
    others = Fault(error.faults) & ~Fault.NO_PERMIT
    return 3 if error.faults == Fault.NO_PERMIT else 2 if others == Fault.HOST_SILENT else 0

"""The package's exceptions, each with the exit code of the command line.

The command line prints the message as one line and exits with `exit_code`
(sysexits.h: 78 EX_CONFIG, 69 EX_UNAVAILABLE). A message says what is wrong, where, and what to do.
"""


class ControllerError(Exception):
    """Base of all errors that this package raises on purpose; shown to users without a traceback."""

    exit_code = 1


class UsageError(ControllerError):
    """Command-line options that cannot be combined."""

    exit_code = 2


class ConfigError(ControllerError):
    """An invalid board, scene or setting."""

    exit_code = 78


class BankError(ControllerError):
    """A bank file that is missing, damaged, or built for another board."""

    exit_code = 78


class TouchError(ControllerError):
    """A touch panel or recording that cannot be read."""

    exit_code = 69


class LinkError(ControllerError):
    """The FPGA is unreachable, does not answer, or answers incorrectly."""

    exit_code = 69


class FaultError(ControllerError):
    """The FPGA has switched its outputs off because of a fault."""

    def __init__(self, message: str, faults: int = 0) -> None:
        super().__init__(message)
        self.faults = faults  # its fault bits (`fpga.registers.Fault`); 0 if unknown


class GatewareError(ControllerError):
    """A bitstream that cannot be built, or is not what was asked for."""


class CalibrationError(ControllerError):
    """Measurements that do not determine a calibration."""

    exit_code = 78


class WorkersError(ControllerError):
    """Workers that are not there, are lost, or have another version."""

    exit_code = 78


class UpdateError(ControllerError):
    """A release, repository or update that is refused, or that cannot be fetched or installed; the running release stays."""

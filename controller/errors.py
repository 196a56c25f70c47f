"""The one tree of errors: what a user's mistake, a bad file or a lost device is called.

The command line prints the message as one line and exits with `exit_code`
(sysexits.h: 78 EX_CONFIG, 69 EX_UNAVAILABLE). A message says what, where and what to do.
"""


class ControllerError(Exception):
    """Anything this package refuses; never shown with a traceback."""

    exit_code = 1


class UsageError(ControllerError):
    """Options of a command that do not go together."""

    exit_code = 2


class ConfigError(ControllerError):
    """A board, scene or setting that cannot be meant."""

    exit_code = 78


class BankError(ControllerError):
    """A bank file that is damaged, foreign, or of another board."""

    exit_code = 78


class TouchError(ControllerError):
    """A touch panel or recording that cannot be read."""

    exit_code = 69


class LinkError(ControllerError):
    """The FPGA does not answer, or answers what it should not."""

    exit_code = 69


class FaultError(ControllerError):
    """The FPGA has shut its outputs off and says why; `faults` are its fault bits (registers.Fault), 0 if they are not known."""

    def __init__(self, message: str, faults: int = 0) -> None:
        super().__init__(message)
        self.faults = faults


class CalibrationError(ControllerError):
    """Measurements from which no calibration follows."""


class UpdateError(ControllerError):
    """An update that was refused."""

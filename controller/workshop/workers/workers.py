"""Who computes what many processes or machines can share."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Workers:
    """Who computes: this process, with 1 of `processes`; that many; or the workers of a scheduler, in place of both."""

    processes: int = 1
    address: str | None = None  # of a dask scheduler, whose workers have this package in the same version
    scheduler_file: Path | None = None  # of `dask scheduler --scheduler-file`, which holds its address
    memory_mb: float | None = None  # that each of `processes` may take; dask ends one that takes more, and starts it again

    @property
    def strangers(self) -> bool:
        """Whether they are those of a scheduler: who knows how many there are."""
        return self.address is not None or self.scheduler_file is not None

    @property
    def is_this_process(self) -> bool:
        """Whether they are the calling process itself, without dask."""
        return not self.strangers and self.processes == 1

    @property
    def option(self) -> str:
        """What asked for them on the command line."""
        if self.scheduler_file is not None:
            return f"--scheduler-file {self.scheduler_file}"
        return f"--workers {self.processes}" if self.address is None else f"--dask {self.address}"


ALONE = Workers()

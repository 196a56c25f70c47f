"""All methods that the benchmark compares: each module is one line."""

from collections.abc import Callable, Iterator

from controller.workshop.benchmark.methods import baseband, designs, device, modal_bank, responses
from controller.workshop.benchmark.methods.candidate import Candidate
from controller.workshop.benchmark.methods.laboratory import Laboratory

METHODS: tuple[Callable[[Laboratory], Iterator[Candidate]], ...] = (
    device.candidates,
    responses.candidates,
    baseband.candidates,
    modal_bank.candidates,
    designs.candidates,
)


def all_candidates(laboratory: Laboratory) -> list[Candidate]:
    """Every method at each of its settings."""
    return [candidate for method in METHODS for candidate in method(laboratory)]

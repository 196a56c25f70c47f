"""What the host believes of the FPGA's counters, compared with what a status says of them: all of them wrap."""

from dataclasses import asdict

from tables import each_row

from controller.device.fpga.belief import Belief
from controller.device.fpga.frames import Play
from controller.device.fpga.registers import Fault, Result, Start, State
from controller.device.fpga.status import Status
from controller.metrics import LinkCounters


def status(triggers, ignored, emissions):
    """Of an FPGA whose counters have gone on to these, of a plate that is free."""
    counters = {"trigger_count": triggers % 2**32, "ignored": ignored % 2**16, "emissions": emissions % 2**32}
    return Status(Result.OK, 1, State(0), Fault(0), data=0, timestamp_ticks=1, **counters)


@each_row(
    ("played", "triggers", "ignored", "emissions", "counted"),
    [
        (0, 0, 0, 0, {}),
        (1, 1, 0, 1, {}),
        (3, 0, 0, 0, {"triggers_lost": 3}),
        (2, 1, 0, 1, {"triggers_lost": 1}),
        (0, 1, 1, 0, {"triggers_stray": 1}),
        (0, 2, 2, 0, {"triggers_stray": 2}),
        (1, 1, 1, 0, {"triggers_ignored": 1}),
        (1, 1, 0, 0, {"plays_missed": 1}),
        (0, 0, 0, 1, {"emissions_unexpected": 1}),
        (1, 1, 0, 3, {"emissions_unexpected": 2}),
    ],
)
def test_what_differs_is_counted_by_its_cause_also_where_counters_wrap(played, triggers, ignored, emissions, counted):
    for before in (0, 5, 2**16 - 1, 2**31 - 1, 2**32 - 1):
        belief, counters = Belief(), LinkCounters()
        assert belief.compare(status(before, before, before), counters) == 0, "what it had counted before is of no interest"
        for _ in range(played):
            belief.accepted(Play(0, start=Start.TRIGGER))
            belief.triggered()
        lost = belief.compare(status(before + triggers, before + ignored, before + emissions), counters)
        assert {name: count for name, count in asdict(counters).items() if count} == counted, before
        assert lost == sum(counted.get(name, 0) for name in ("triggers_lost", "triggers_ignored", "plays_missed"))
        assert belief.compare(status(before + triggers, before + ignored, before + emissions), counters) == 0, "once"

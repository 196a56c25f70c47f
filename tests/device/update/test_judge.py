"""The judge of a trial: what it calls good, bad and not evaluated yet, whatever a service goes through."""

from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from controller.device.board.panel_state import PanelState
from controller.device.board.panel_status import LatencyStatus, PanelStatus
from controller.device.loop.playing import host_timing
from controller.device.update.judge import GRACE_S, LATENCY_MAX_US, Evaluation, Rules, Verdict, judge

HEALTHY_S = 20.0
STARTED = PanelStatus(
    release="2",
    board="glass",
    pid=7,
    boot="b",
    started_s=0.0,
    written_s=0.0,
    state=PanelState.ARMED,
    cause="",
    outputs_on=True,
    panel_present=True,
    temperature_c=None,
    upload=LatencyStatus(),
    resident=LatencyStatus(),
    **dict.fromkeys(("heartbeats", "due", "foci", "emissions", "uploads", "late", "idled", "host_silent", "outages", "skipped"), 0),
    **dict.fromkeys(("waiting", "log_lines_lost", "statuses_lost"), 0),
)
SERVES = ("armed", "playing", "idle", "disarmed", "permit lost and back")
WAITS = ("no permit", "waiting for panel")
TROUBLE = (
    "faulted",
    "waiting for FPGA",
    "outage",
    "stall",
    "no status",
    "stale",
    "another release",
    "ended",
    "slow",
    "no heartbeat",
)
RULES = Rules("2", HEALTHY_S, "b")


class Service:
    """A service of release 2 under the judge, second by second."""

    def __init__(self, rules=RULES):
        self.rules = rules
        self.now_s = 1000.0
        self.status = replace(STARTED, started_s=self.now_s, written_s=self.now_s)
        self.evaluation = Evaluation()
        self.became = []

    def live(self, kind, seconds=1):
        """Go through something for this many seconds; the evaluation."""
        for _ in range(seconds):
            self.now_s += 1.0
            self.evaluation = judge(self.evaluation, self.now_s, self.seen(kind), self.rules)
            self.became.append((kind, self.evaluation.verdict))
        return self.evaluation

    def seen(self, kind):
        """The status in a second of which something is so."""
        status = replace(self.status, written_s=self.now_s, heartbeats=self.status.heartbeats + 100, cause="")
        if kind in {state.value for state in PanelState}:
            state = PanelState(kind)
            on = state in {PanelState.ARMED, PanelState.PLAYING, PanelState.WAITING_FOR_PANEL}
            status = replace(status, state=state, outputs_on=on, cause="" if on else "for a reason")
        elif kind == "permit lost and back":
            lost = status.outage_causes.get("NO_PERMIT", 0) + 1
            status = replace(status, outages=status.outages + 1, outage_causes={"NO_PERMIT": lost})
        elif kind == "outage":
            status = replace(status, outages=status.outages + 1, state=PanelState.ARMED, outputs_on=True)
        elif kind == "stall":
            status = replace(status, host_silent=status.host_silent + 1, state=PanelState.ARMED, outputs_on=True)
        elif kind == "no heartbeat":
            status = replace(status, heartbeats=self.status.heartbeats, state=PanelState.ARMED, outputs_on=True)
        elif kind == "restart":
            status = replace(STARTED, pid=status.pid + 1, started_s=self.now_s, written_s=self.now_s)
        elif kind == "slow":
            self.status = status = replace(status, state=PanelState.ARMED, outputs_on=True)
            return replace(status, upload=LatencyStatus(5000, 2e3, LATENCY_MAX_US * 2, 3e4))
        elif kind == "another release":
            return replace(status, release="1")
        elif kind == "ended":
            return replace(status, ended=True)
        elif kind == "stale":
            return replace(status, written_s=self.now_s - 5.5)
        else:
            assert kind == "no status"
            return None
        self.status = status
        return status


def lives(*kinds):
    """Sequences of what a service may go through, each for some seconds."""
    return st.lists(st.tuples(st.sampled_from(kinds), st.integers(1, 40)), max_size=12)


@given(lives(*SERVES, *WAITS, *TROUBLE, "restart"))
def test_good_is_only_what_served_for_all_of_the_time_before(life):
    service = Service()
    for kind, seconds in life:
        service.live(kind, seconds)
    verdicts = [verdict for _, verdict in service.became]
    if Verdict.GOOD in verdicts:
        at = verdicts.index(Verdict.GOOD)
        assert set(verdicts[at:]) == {Verdict.GOOD}, "it stays"
        window = [kind for kind, _ in service.became[at - int(HEALTHY_S) + 1 : at + 1]]
        assert len(window) == HEALTHY_S
        assert set(window) <= {*SERVES, "no heartbeat"}
        assert "no heartbeat, no heartbeat" not in ", ".join(window), "two statuses are less than two seconds apart"


@given(lives(*WAITS))
def test_what_waits_for_permit_or_panel_is_never_evaluated(life):
    service = Service()
    for kind, seconds in life:
        assert service.live(kind, seconds).verdict is Verdict.NOT_YET


@given(lives(*WAITS, *SERVES), st.sampled_from(WAITS))
def test_what_does_nothing_wrong_is_never_bad_and_good_in_the_end(life, at_last):
    service = Service()
    for kind, seconds in life:
        assert service.live(kind, seconds).verdict is not Verdict.BAD
    if service.evaluation.verdict is Verdict.NOT_YET:
        assert service.live(at_last, int(HEALTHY_S) + 2).stands
        assert service.live("armed", int(HEALTHY_S) + 1).verdict is Verdict.GOOD


@given(lives(*SERVES, *TROUBLE))
def test_what_does_not_wait_is_evaluated_in_time(life):
    service = Service()
    for kind, seconds in [*life, ("armed", 0)]:
        service.live(kind, seconds)
    evaluated_by = int(GRACE_S + HEALTHY_S) + 3
    assert all(verdict is not Verdict.NOT_YET for _, verdict in service.became[evaluated_by:])


@given(lives(*WAITS, *TROUBLE, "armed"), st.sampled_from([kind for kind in TROUBLE if kind != "another release"]))
def test_what_fails_and_goes_on_failing_is_bad_within_a_minute(life, fails):
    service = Service()
    for kind, seconds in life:
        service.live(kind, seconds)
    if service.evaluation.verdict is not Verdict.GOOD:
        assert service.live(fails, 45).verdict is Verdict.BAD
        assert service.evaluation.why


@given(st.integers(1, 60), st.sampled_from(TROUBLE))
def test_another_process_begins_anew(seconds, fails):
    service = Service()
    service.live("armed", 5)
    service.live(fails, min(seconds, int(GRACE_S) - 6))
    assert service.live("restart").verdict is Verdict.NOT_YET
    assert service.live(fails, int(GRACE_S) - 2).verdict is Verdict.NOT_YET
    assert service.live("armed", int(HEALTHY_S) + 1).verdict is Verdict.GOOD


def test_a_panel_without_permit_for_weeks_stands_and_is_evaluated_once_it_may():
    service = Service()
    service.live("waiting for FPGA", 25)
    assert not service.live("no permit", 19).stands
    assert service.live("no permit", 3600).stands
    assert service.evaluation.why == "no permit: for a reason"
    for _ in range(40):  # each night the stage's supply resets the FPGA
        assert not service.live("waiting for FPGA", 2).stands
        assert service.live("no permit", 100).stands
    assert service.live("armed", 20).verdict is Verdict.NOT_YET
    assert service.live("armed", 1).verdict is Verdict.GOOD


def old(**fields):
    """How the release before fared when the update was asked for."""
    return replace(STARTED, release="1", **{"written_s": 3600.0} | fields)


def test_what_kept_the_old_release_from_serving_is_waited_for_and_nothing_else():
    rules = Rules("2", HEALTHY_S, "b", old(state=PanelState.WAITING_FOR_FPGA))
    service = Service(rules)
    assert service.live("waiting for FPGA", 3600).stands
    assert service.live("faulted", 40).verdict is Verdict.BAD
    assert Service(rules).live("armed", 30).verdict is Verdict.GOOD


def test_outages_and_stalls_that_the_old_release_had_as_often_are_not_held_against_it():
    for kind, count in (("outage", "outages"), ("stall", "host_silent")):
        for suffered, verdict in ((0, Verdict.BAD), (1, Verdict.BAD), (3600 // 5, Verdict.GOOD)):
            service = Service(Rules("2", HEALTHY_S, "b", old(**{count: suffered})))
            for _ in range(4):
                service.live("armed", 9)
                service.live(kind)
            assert service.evaluation.verdict is verdict, (kind, suffered)


def test_latency_is_held_against_the_schedules_bound_or_what_the_old_release_had():
    assert host_timing.MAX_S * 1e6 == LATENCY_MAX_US
    slow = LatencyStatus(5000, 5e3, LATENCY_MAX_US, 3e4)
    for before, verdict in ((None, Verdict.BAD), (old(), Verdict.BAD), (old(upload=slow), Verdict.GOOD)):
        assert Service(Rules("2", HEALTHY_S, "b", before)).live("slow", 40).verdict is verdict


def test_one_long_moment_at_the_start_is_not_its_latency():
    service = Service()
    service.status = replace(service.status, upload=LatencyStatus(15, 9e3, 5e4, 5e4), resident=LatencyStatus(500, 1e2, 9e3, 9e3))
    assert service.live("armed", 21).verdict is Verdict.GOOD


def test_a_judge_that_was_stopped_itself_does_not_hold_that_against_the_trial():
    service = Service()
    service.live("armed", 5)
    service.now_s += 300
    assert service.live("stale").verdict is Verdict.NOT_YET
    assert service.live("armed", 21).verdict is Verdict.GOOD

"""Figures of a running panel for Prometheus: a process of its own, a client of the application socket like any other.

Names follow prometheus.io/docs/practices/naming: base units, `_total` for counters.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, Final

from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, HistogramMetricFamily, InfoMetricFamily, Metric
from prometheus_client.registry import Collector, CollectorRegistry

from controller.device.application_socket.client import PanelClient
from controller.device.application_socket.protocol.panel_messages import Greeting
from controller.device.board.panel_state import PanelState
from controller.device.fpga.registers import Fault
from controller.errors import ControllerError

if TYPE_CHECKING:
    from controller.device.update.installed import UpdateState

COUNTERS: Final = {  # of `figures`: name here, help
    "due": ("emissions_due", "Emissions of fingers, fixed emitters and commands that became due."),
    "foci": ("foci_played", "Of these, those that were played."),
    "emissions": ("emissions", "Starts of an accepted play command."),
    "uploads": ("uploads", "Waveforms sent to the FPGA."),
    "resident": ("resident_plays", "Emissions whose waveform was resident in the FPGA."),
    "prefetched": ("prefetched", "Waveforms uploaded for a predicted emission."),
    "prefetch_wasted": ("prefetch_wasted", "Of these, those that were not played so far."),
    "heartbeats": ("heartbeats", "Heartbeats that the FPGA answered."),
    "late": ("late_emissions", "Pulses that reached the FPGA too late for their time."),
    "host_silent": ("host_stalls", "Times the FPGA switched off because this host was silent."),
    "stall_pauses": ("host_stall_pauses", "Of these, those after which it armed again only after a pause."),
    "outages": ("outages", "Times the FPGA was lost, reset, or switched off for another cause."),
    "idled": ("idle_times", "Times the outputs were ramped down because nothing was touched."),
    "outputs_off_s": ("outputs_off_seconds", "Time without outputs, until they were on again."),
    "scenes_loaded": ("scenes_loaded", "Scenes that came into force."),
    "scenes_refused": ("scenes_refused", "Scenes that were refused."),
}
HISTOGRAMS: Final = {
    "report": ("touch_report_latency_seconds", "From the kernel's timestamp of a touch report to its read.", {}),
    "uploads_host": ("host_latency_seconds", "The host's own work for an emission.", {"play": "upload"}),
    "resident_host": ("host_latency_seconds", "The host's own work for an emission.", {"play": "resident"}),
    "uploads_total": ("emission_latency_seconds", "From the read of the touch to the trigger.", {"play": "upload"}),
    "resident_total": ("emission_latency_seconds", "From the read of the touch to the trigger.", {"play": "resident"}),
}
Ask = Callable[[], tuple[str, str, dict[str, Any]]]


class PanelFigures:
    """Figures of the panel whose application socket has this path, by one connection that is kept."""

    def __init__(self, path: str) -> None:
        self._path = path
        self._panel: PanelClient | None = None
        self._greeting: Greeting | None = None

    def __call__(self) -> tuple[str, str, dict[str, Any]]:
        """Version, board and figures; raises ControllerError if no panel answers."""
        if self._panel is not None:
            with contextlib.suppress(ControllerError):  # it was restarted, or another client needed the place
                return self._ask()
            self.close()
        try:
            return self._ask()
        except ControllerError:
            self.close()
            raise

    def close(self) -> None:
        """End the connection."""
        if self._panel is not None:
            self._panel.close()
        self._panel = self._greeting = None

    def _ask(self) -> tuple[str, str, dict[str, Any]]:
        if self._panel is None:
            self._panel = PanelClient(self._path)
        if self._greeting is None:
            self._greeting = self._panel.hello()
        return self._greeting.version, self._greeting.board, self._panel.figures()


class PanelCollector(Collector):
    """Metrics of one panel, collected when Prometheus asks.

    `ask` gives version, board and figures of the panel, or raises ControllerError if it does not answer; `more` gives metrics that
    do not need the panel, such as those of its releases.
    """

    def __init__(self, ask: Ask, more: Callable[[], Iterator[Metric]] = lambda: iter(())) -> None:
        self._ask = ask
        self._more = more

    def collect(self) -> Iterator[Metric]:
        """All metrics; without an answer only `haptic_panel_up` and those that need none."""
        answer = None
        with contextlib.suppress(ControllerError):
            answer = self._ask()
        yield GaugeMetricFamily("haptic_panel_up", "Whether the panel's service answers.", float(answer is not None))
        if answer is not None:
            yield from _metrics(*answer)
        yield from self._more()


def update_metrics(state: UpdateState) -> Iterator[Metric]:
    """Releases of this device."""
    reported = {"in_use": state.in_use, "stays": state.stays, "previous": state.previous, "trial": state.trial}
    yield InfoMetricFamily("haptic_panel_update", "Releases: in use, used without a trial, before it, on trial.", reported)
    yield GaugeMetricFamily("haptic_panel_update_trial", "Whether a release is on trial.", float(bool(state.trial)))
    yield GaugeMetricFamily("haptic_panel_update_tries", "Starts of the trial so far.", state.tries)
    yield GaugeMetricFamily("haptic_panel_update_failed_releases", "Releases that were tried and did not serve.", len(state.failed))
    failed = GaugeMetricFamily(
        "haptic_panel_update_failed", "1 for each release that was tried and did not serve.", labels=["version"]
    )
    for version in state.failed:
        failed.add_metric([version], 1.0)
    yield failed
    yield GaugeMetricFamily("haptic_panel_update_requests", "Requests not done yet.", len(state.requested))
    yield GaugeMetricFamily("haptic_panel_update_problems", "What is damaged of releases and state.", len(state.problems))


def registry(collector: Collector) -> CollectorRegistry:
    """A registry of this collector alone: nothing about the exporting process itself."""
    alone = CollectorRegistry()
    alone.register(collector)
    return alone


def _metrics(version: str, board: str, figures: dict[str, Any]) -> Iterator[Metric]:
    """The figures of a panel as metrics; what another version does not tell is left out."""
    yield InfoMetricFamily("haptic_panel_release", "Release that runs, and its board.", {"version": version, "board": board})
    states = GaugeMetricFamily("haptic_panel_state", "1 for the state of the panel, 0 for the others.", labels=["state"])
    for state in PanelState:
        states.add_metric([state.value], float(figures.get("state") == state.value))
    yield states
    on = figures.get("outputs_on", figures.get("outputs") == "on")
    yield GaugeMetricFamily("haptic_panel_outputs_on", "Whether there may be voltage at the actuators.", float(on))
    if "waiting" in figures:
        yield GaugeMetricFamily("haptic_panel_waiting_emissions", "Emissions that wait for the plate.", figures["waiting"])
    if figures.get("temperature_c") is not None:
        yield GaugeMetricFamily("haptic_panel_plate_temperature_celsius", "Temperature of the plate.", figures["temperature_c"])
    for name, (metric, text) in COUNTERS.items():
        if name in figures:
            yield CounterMetricFamily(f"haptic_panel_{metric}", text, figures[name])
    causes = dict.fromkeys([*(fault.name or "" for fault in Fault), "LINK"], 0) | figures.get("outage_causes", {})
    yield _by_cause("haptic_panel_faults", "Outages by the fault that the FPGA named; LINK: it named none.", causes)
    yield _by_cause("haptic_panel_skipped", "Work and emissions that were left out.", figures.get("skipped", {}))
    yield _by_cause(
        "haptic_panel_link",
        "What the FPGA said that was other than believed, and what was sent again.",
        figures.get("link_counts", {}),
    )
    reported = dict(figures.get("application_socket", {}))
    if "clients_connected" in reported:
        text = "Clients of the application socket that are connected."
        yield GaugeMetricFamily("haptic_panel_clients_connected", text, reported.pop("clients_connected"))
    yield _by_cause("haptic_panel_socket", "Clients and commands of the application socket.", reported)
    yield from _histograms(figures.get("latency_histograms"))


def _by_cause(name: str, text: str, counts: dict[str, float]) -> Metric:
    counter = CounterMetricFamily(name, text, labels=["cause"])
    for cause, count in counts.items():
        counter.add_metric([cause], count)
    return counter


def _histograms(latencies: dict[str, Any] | None) -> Iterator[Metric]:
    if latencies is None:
        return
    families: dict[str, HistogramMetricFamily] = {}
    for name, (metric, text, labels) in HISTOGRAMS.items():
        family = families.setdefault(metric, HistogramMetricFamily(f"haptic_panel_{metric}", text, labels=list(labels)))
        counts = latencies[name]["counts"]
        bounds = [f"{bound_us * 1e-6:g}" for bound_us in latencies["bounds_us"]]
        buckets = [*zip(bounds, counts, strict=True), ("+Inf", latencies[name]["count"])]
        family.add_metric(list(labels.values()), buckets, latencies[name]["sum_us"] * 1e-6)
    yield from families.values()

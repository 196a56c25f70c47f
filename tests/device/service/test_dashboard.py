"""Grafana's dashboard and Prometheus' alerts beside the units: all expressions are of what a panel exports."""

import json
import re
from pathlib import Path

import promql_parser
import pytest
from prometheus_client import generate_latest
from prometheus_client.parser import text_string_to_metric_families
from tables import each_row

from controller.device.board.panel_state import PanelState
from controller.device.fpga.registers import Fault
from controller.device.service.prometheus import PanelCollector, registry, update_metrics
from controller.device.update.installed import UpdateState
from controller.metrics import Counters

FOLDER = Path(__file__).parents[3] / "systemd" / "grafana"
OF_PROMETHEUS = {"instance", "job"}  # labels that it adds
VALUES = {"state": {state.value for state in PanelState}, "cause": {*(fault.name for fault in Fault), "LINK"}}


@pytest.fixture(scope="module")
def exported():
    """Labels of each metric, of a panel that reports all there is."""
    counters = Counters()
    figures = counters.export(histograms=False) | {"latency_histograms": counters.coarse_latency(), "state": "armed"}
    figures |= {
        "temperature_c": 20.0,
        "waiting": 0,
        "outputs_on": True,
        "application_socket": {"clients_connected": 1, "played": 2},
    }
    update = UpdateState(in_use="1.1.0", failed=("1.2.0",))
    text = generate_latest(registry(PanelCollector(lambda: ("1.1.0", "panel", figures), lambda: update_metrics(update)))).decode()
    samples = [sample for family in text_string_to_metric_families(text) for sample in family.samples]
    return {sample.name: {*sample.labels, *OF_PROMETHEUS} for sample in samples}


def wrong(expression, legend, exported):
    """What a panel does not export of what an expression and its legend name; raises ValueError if it is no PromQL."""
    known, found = set(OF_PROMETHEUS), []

    def visit(node):
        if isinstance(node, promql_parser.VectorSelector):
            labels = exported.get(node.name)
            if labels is None:
                found.append(node.name)
                return True
            known.update(labels)
            for matcher in node.matchers.matchers:
                if matcher.name not in labels:
                    found.append(f"{node.name}{{{matcher.name}}}")
                elif matcher.name in VALUES and not set(matcher.value.split("|")) <= VALUES[matcher.name]:
                    found.append(matcher.value)
        if isinstance(node, promql_parser.AggregateExpr) and node.modifier:
            grouped.extend(node.modifier.labels)
        return True

    grouped = re.findall(r"{{ *(?:\$labels\.)?(\w+) *}}", legend)
    promql_parser.walk(promql_parser.parse(expression), visit)
    return found + [label for label in grouped if label not in known]


def test_the_dashboard_shows_what_panels_export(exported):
    dashboard = json.loads((FOLDER / "dashboard.json").read_text())
    panels = dashboard["panels"]
    assert len({panel["id"] for panel in panels}) == len({panel["title"] for panel in panels}) == len(panels) == 8
    places = {(panel["gridPos"]["x"], panel["gridPos"]["y"]) for panel in panels}
    assert places == {(x, y) for x in (0, 12) for y in (0, 8, 16, 24)}
    variables = {variable["name"] for variable in dashboard["templating"]["list"]}
    assert set(re.findall(r"\$\{?(\w+)", json.dumps([panels, dashboard["templating"]]))) - {"__all"} == variables
    for panel in panels:
        for target in panel["targets"]:
            assert wrong(target["expr"], target["legendFormat"], exported) == [], panel["title"]
    (instances,) = [variable["query"] for variable in dashboard["templating"]["list"] if variable["name"] == "instance"]
    name, label = re.fullmatch(r"label_values\((\w+), (\w+)\)", instances).groups()
    assert label in exported[name]


def test_alerts_are_of_what_panels_export(exported):
    (group,) = json.loads((FOLDER / "alerts.json").read_text())["groups"]
    assert len({rule["alert"] for rule in group["rules"]}) == 4
    for rule in group["rules"]:
        assert wrong(rule["expr"], rule["annotations"]["summary"], exported) == [], rule["alert"]


@each_row(
    ("expression", "legend", "named"),
    [
        ("haptic_panel_up == 0", "{{instance}}", []),
        ("haptic_panel_upp == 0", "", ["haptic_panel_upp"]),
        ("rate(haptic_panel_emissions_due[5m])", "", ["haptic_panel_emissions_due"]),
        ('haptic_panel_state{stat="armed"}', "", ["haptic_panel_state{stat}"]),
        ('haptic_panel_state{state=~"faulted|broken"}', "", ["faulted|broken"]),
        ("sum by (reason) (haptic_panel_faults_total)", "", ["reason"]),
        ("haptic_panel_up", "{{ $labels.cause }}", ["cause"]),
    ],
)
def test_a_wrong_name_is_noticed(exported, expression, legend, named):
    assert wrong(expression, legend, exported) == named


def test_an_expression_that_is_none_is_noticed(exported):
    with pytest.raises(ValueError, match="unclosed left parenthesis"):
        wrong("sum by (cause (haptic_panel_faults_total)", "", exported)

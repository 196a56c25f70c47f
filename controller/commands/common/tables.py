"""Figures of commands as tables of text; `--json` prints the same figures for programs."""

from typing import Any

LABELS = {
    "relative_amplitude": "relative amplitude",
    "exact_share": "of exact composition",
    "amplitude_um": "amplitude (µm)",
    "contrast": "contrast (outside 0.95 λ)",
    "contrast_all": "contrast (all points)",
    "spot_mm": "spot (mm)",
    "spot_wavelengths": "spot (λ)",
    "distance_mm": "crest to finger (mm)",
}
REFUSED = ("far_outside", "no_finger", "too_fast", "more_than_played")


def run_table(figures: dict[str, Any]) -> str:
    """Table of one run."""
    recording = figures["recording"]
    lines = [
        f"board {figures['board']}, recording {recording['file']}: {recording['reports']} reports with a contact, "
        f"{recording['contacts']} contacts, at most {recording['max_fingers']} at once",
        f"{figures['emissions']} emissions from {figures['triggers']} triggers ({figures['uploads']} uploads, "
        f"{figures['resident']} resident), {figures['bytes_sent']:,} bytes sent, {figures['heartbeats']} heartbeats",
        f"bank: {figures['bank']}",
        figures["memory"],
        f"gateware: {figures['link']}, {_number(figures['gateware_speed'])} × real time",
        "ended with outputs " + ("off" if figures["outputs_off"] else "ON"),
        *_became(figures),
        *_drift_line(figures["drift"]),
        "",
        f"{'latency (µs)':<26}{'count':>8}{'p50':>11}{'p99':>11}{'p99.9':>11}{'worst':>11}",
    ]
    for stage, kinds in figures["latency_us"].items():
        lines += [_latency_line(f"{stage}, {kind}", summary) for kind, summary in kinds.items()]
    reference = figures["reference_us"]["copy_and_crc32_of_one_waveform"]
    lines.append(_latency_line("copy + crc32 alone", reference))

    def worst(figure: dict[str, Any]) -> str:
        """The worst value, unless this machine was late: then it would be a figure of the machine, not of the panel."""
        return _number(None if figures["spoiled"] else figure["worst"])

    for title, key in (("focus at the finger", "focus"), ("fixed emitters", "fixed_emitters")):
        values = figures[key]
        if values["count"]:
            heading = f"{title} ({values['count']})"
            lines += ["", f"{heading:<30}{'median':>10}{'worst':>10}"]
            lines += [f"{LABELS[name]:<30}{_number(v['median']):>10}{worst(v):>10}" for name, v in _measured(values)]
    if figures["together"]:
        lines += ["", f"{'fingers at once':<18}{'emissions':>10}{'worst finger of exact':>24}{'crest to finger (mm)':>24}"]
    for row in figures["together"]:
        share, distance = row["worst_finger_exact_share"], row["distance_mm"]
        values = [f"{_number(figure['median'])} / {worst(figure)}" for figure in (share, distance)]
        lines.append(f"{row['fingers']:<18}{row['emissions']:>10}{values[0]:>24}{values[1]:>24}")
    if figures["spoiled"]:
        lines += ["", f"what was felt at worst is left out: {figures['spoiled']}"]
    return "\n".join(lines)


def _drift_line(drift: dict[str, Any] | None) -> list[str]:
    if drift is None:
        return []
    low, high = drift["least_percent"], drift["most_percent"]
    by = f"{low:+g} %" if low == high else f"{low:+g} to {high:+g} %"
    clock = f"bit clock at the end {drift['bit_clock_scale']:.6f} of the board's, in steps of {drift['bit_clock_step_ppm']:.2g} ppm"
    return [f"frequencies of the plate drifted by {by}; " + (clock if drift["corrected"] else "nothing corrects that")]


def _became(figures: dict[str, Any]) -> list[str]:
    """Emissions that were due, and waveforms sent ahead, by outcome; where the FPGA was found in another state than believed."""
    lines = [
        f"due for fingers, fixed emitters and commands: {figures['due']}, of which {figures['foci']} played; "
        f"waveforms sent ahead: {figures['prefetched']}, of which {figures['prefetch_wasted']} not played",
        f"skipped: {_counts(figures['skipped'])}",
        *_implausible(figures["touch"]["plausibility"]),
    ]
    happened = {name: count for name, count in figures["link_counts"].items() if count}
    return [*lines, f"on the link: {_counts(happened)}"] if happened else lines


def _counts(counts: dict[str, int]) -> str:
    return ", ".join(f"{name.replace('_', ' ')} {count}" for name, count in counts.items())


def _implausible(found: dict[str, int]) -> list[str]:
    """Positions of the touch panel that were not taken for a finger's; nothing if there were none."""
    refused = found["points"] - found["believed"] - found["confirmed"]
    kinds = ", ".join(f"{kind.replace('_', ' ')} {found[kind]}" for kind in REFUSED if found[kind])
    return [f"{refused} of {found['points']} positions of the touch panel were no finger's: {kinds}"] if kinds else []


def service_table(figures: dict[str, Any]) -> str:
    """Table of a run of the service."""
    latency = figures["latency_us"]
    lines = [
        f"board {figures['board']}: {figures['emissions']} emissions ({figures['uploads']} uploads, {figures['resident']} "
        f"resident, {figures['scheduled']} at a time given to the FPGA), {figures['heartbeats']} heartbeats",
        f"bank: {figures['bank']}",
        figures["memory"],
        f"at the end: {figures['state']}" + (f" ({figures['cause']})" if figures["cause"] else ""),
        f"outputs were off for {_number(figures['outputs_off_s'])} s: {figures['host_silent']} stalls of this host, "
        f"{figures['outages']} other outages" + (f", the last: {figures['outage']}" if figures["outage"] else ""),
        *_became(figures),
        "",
        f"{'latency (µs)':<26}{'count':>8}{'p50':>11}{'p99':>11}{'p99.9':>11}{'worst':>11}",
        _latency_line("report to read", latency["report"]),
    ]
    lines += [
        _latency_line(f"{stage}, {kind}", latency[kind][stage]) for kind in ("uploads", "resident") for stage in latency[kind]
    ]
    return "\n".join(lines + [f"warning: {warning}" for warning in figures["warnings"]])


def check_table(figures: dict[str, Any]) -> str:
    """Table of a bring-up: each register with its expected value, then the checks, then the verdict."""
    expected, errors = figures["expected"], figures["bit_errors"]
    lines = [f"{'register':<20}{'read':>12}{'expected':>13}"]
    for name, value in figures["registers"].items():
        wanted = expected.get(name)
        verdict = "" if wanted is None else "  ok" if wanted == value else "  WRONG"
        lines.append(f"{name:<20}{_register(value):>12}{'' if wanted is None else _register(wanted):>13}{verdict}")
    back = (
        f"{errors['wrong_bits']} wrong of {errors['bits']:,} that came back" if errors["bits"] else "none come back over this link"
    )
    frames = f"of {errors['frames']} frames {errors['frames_refused']} refused, {errors['answers_damaged']} answers damaged"
    moved = "" if figures["channels_moved"] is None else ", their pins seen"
    return "\n".join(
        [
            *map(str.rstrip, lines),
            "",
            f"bits: {back}; {frames}",
            f"slots: {figures['slots'] - figures['slots_damaged']} of {figures['slots']} keep what they are given",
            f"channels: {len(figures['channels'])} chirped{moved}",
            "FAIL: " + "; ".join(figures["complaints"]) if figures["complaints"] else "PASS: all that was tried is as it should be",
        ]
    )


def _register(value: int) -> str:
    return f"{value}" if value < 1_000_000_000 else f"0x{value:08X}"


def plain_table(figures: dict[str, Any]) -> str:
    """One line for each figure, nested ones with dots."""
    flat = _flat(figures, "")
    width = max((len(name) for name, _ in flat), default=0)
    return "\n".join(f"{name:<{width}}  {_number(value)}" for name, value in flat)


def amplitude_table(figures: dict[str, Any]) -> str:
    """One line for each figure of composing; the values of each finger are only in --json."""
    fingers = {number: found["error_percent"] for number, found in figures["fingers"].items()}
    return plain_table(
        {name: value for name, value in figures.items() if name != "fingers"} | {"error_percent_of_fingers": fingers}
    )


def power_table(figures: dict[str, Any]) -> str:
    """Table of the load of a bank's waveforms on the driver stages, of their sound and of stress."""
    duty, resistor, limits = figures["max_duty"], figures["resistor"], figures["limits"]
    rows = [
        ("edges of an emission", figures["edges"]),
        ("edges per second (kHz)", {key: _scaled(spread, 1e-3) for key, spread in figures["edge_rate_hz"].items()}),
        ("loss at full duty (W)", figures["full_duty_w"]),
        (f"loss at max_duty = {duty:g} (W)", figures["max_duty_w"]),
    ]
    channels = f"{len(figures['channels'])} channels"
    lines = [
        f"board {figures['board']}, {figures['path']}: {figures['emissions']} emissions of {figures['emission_ms']:g} ms",
        f"{'':<32}{'one channel':>20}{channels:>20}",
        f"{'':<32}{'median':>10}{'max':>10}{'median':>10}{'max':>10}",
    ]
    for title, value in rows:
        shown = [_number(value[part][kind]) for part in ("channel", "all") for kind in ("median", "max")]
        lines.append(f"{title:<32}" + "".join(f"{text:>10}" for text in shown))
    edge = figures["loss_per_edge_uj"]
    lines += [
        "",
        f"loss of an edge (µJ): {_number(edge['median'])} median, {_number(edge['max'])} in the costliest emission; "
        f"{_number(edge['far_apart'])} far from any other, {_number(edge['worst_possible'])} in the worst possible waveform",
        f"a resistor of {resistor['rating_w']:g} W, derated to {resistor['derating']:g}, "
        f"may burn {_number(limits['permitted_w'])} W: " + ("holds at max_duty" if resistor["holds"] else "TOO LITTLE at max_duty"),
        f"limits for that: max_duty {_number(limits['max_duty'])} for these emissions; whatever plays, "
        f"{_number(limits['max_channel_edge_rate_hz'])} edges per second of one channel, "
        f"{_number(limits['max_total_edge_rate_hz'])} of all",
        "",
        plain_table({name: figures[name] for name in ("sound", "stress")}),
        *(f"warning: {warning}" for warning in figures["warnings"]),
    ]
    return "\n".join(lines)


def benchmark_table(figures: dict[str, Any]) -> str:
    """Pareto fronts of time for each number of fingers, and the baselines."""
    reported = figures["environment"]
    lines = [
        f"board {figures['board']}, seed {figures['seed']}: {figures['modes']} modes, {figures['modes_in_band']} in the band; "
        f"{reported['processor']}, {', '.join(reported['blas'])}, kernel {reported['kernel']}, commit {reported['commit']}",
        *figures["left_out"],
    ]
    for fingers in dict.fromkeys(row["fingers"] for row in figures["baselines"]):
        family = f"{fingers} off grid"
        error = "bound_loss" if fingers == 1 else "best_loss"
        heads = "".join(f"{head:>9}" for head in ("median", "p99 µs", "of C", "MB", "lost", "worst", "felt µm", "other"))
        lines += ["", f"{f'{fingers} fingers, front of time':<34}{'setting':<18}{heads}"]
        for index in figures["fronts"][f"time, {family}"]:
            setting = figures["settings"][index]
            time_us, found = setting["time_us"][str(fingers)], setting["families"][family]
            lost, felt = found[error], [found[name]["median"] for name in ("felt_um", "felt_crosstalk")]
            values = (time_us["median_us"], time_us["p99_us"], time_us["over"].get("plain C, vectors of 128 bits"))
            lines.append(
                f"{setting['curve']:<34}{setting['setting']:<18}"
                + "".join(f"{_number(value):>9}" for value in values)
                + f"{setting['memory_bytes'] * 1e-6:>9.1f}{lost['median']:>9.4f}{lost['worst']:>9.4f}{felt[0]:>9.3f}{felt[1]:>9.3f}"
            )
        for row in figures["baselines"]:
            if row["fingers"] == fingers:
                lines.append(f"{row['name']:<52}{_number(row['median_us']):>9}{_number(row['p99_us']):>9}")
    return "\n".join(lines)


def _scaled(spread: dict[str, float], factor: float) -> dict[str, float]:
    return {kind: value * factor for kind, value in spread.items()}


def _flat(value: Any, name: str) -> list[tuple[str, Any]]:
    if isinstance(value, dict):
        return [row for key, inner in value.items() for row in _flat(inner, f"{name}.{key}" if name else str(key))]
    return [(name, value)]


def _measured(values: dict[str, Any]) -> list[tuple[str, dict[str, float | None]]]:
    return [(name, value) for name, value in values.items() if isinstance(value, dict)]


def _latency_line(title: str, summary: dict[str, Any]) -> str:
    shown = "".join(f"{_number(summary[name]):>11}" for name in ("p50", "p99", "p999", "worst"))
    return f"{title:<26}{summary['count']:>8}{shown}"


def _number(value: Any) -> str:
    if value is None:
        return "–"
    if isinstance(value, float):
        return f"{value:.4g}" if abs(value) < 1000 else f"{value:,.0f}"
    return str(value)

"""What `run` prints without --verbose: what was felt, in sentences."""

from typing import Any

from controller.device.bank.expectation import in_words

MORE = "(--verbose: every count and latency; --json: for programs)"


def felt(figures: dict[str, Any]) -> str:
    """Report of a simulated run: what the fingers felt, how late, and how it ended."""
    from controller.workshop.physics.felt import felt_in_words

    focus, recording, total = figures["focus"], figures["recording"], figures["latency_us"]["total"]["uploads"]
    touches, share = _count(recording["contacts"], "touch", "touches"), focus["exact_share"]
    if focus["count"]:
        weakest = "" if figures["spoiled"] else f", {_percent(share['worst'])} at the weakest"
        found = (
            f"felt {_count(focus['count'], 'pulse')}: {_percent(share['median'])} of what this panel can do at the median{weakest}"
        )
    else:
        found = "felt nothing: " + ("no pulse was evaluated" if figures["foci"] else "0 emissions were played")
    lines = [f"{touches} of {recording['file']} {found}"]
    if figures["spoiled"]:
        lines.append(f"what was felt at worst is left out: {figures['spoiled']}")
    if (felt_um := focus["felt_light_touch_um"]) is not None:
        lines.append(f"a light touch feels {felt_um:.2f} µm of the median pulse: {felt_in_words(felt_um)}")
    lines += [f"expected from the bank: {in_words(figures['expected'])}", *figures["unfelt"]]
    if total["count"]:
        median_ms, worst_ms = total["p50"] * 1e-3, total["worst"] * 1e-3
        lines.append(f"from the report of a touch to its trigger: {median_ms:.2f} ms at the median, {worst_ms:.2f} ms at worst")
    return "\n".join([*lines, f"ended with outputs {'off' if figures['outputs_off'] else 'ON'} {MORE}"])


def served(figures: dict[str, Any]) -> str:
    """Report of a run of the service."""
    stalls = f"{_count(figures['host_silent'], 'stall')} of this host, {_count(figures['outages'], 'other outage')}"
    off_s = figures["outputs_off_s"]  # until they were on: 0 only if they never were
    off = f"were off for {off_s:.4g} s" if off_s else "were never on"
    lines = [
        f"board {figures['board']}: {_count(figures['foci'], 'pulse')} played; outputs {off} ({stalls})",
        f"at the end: {figures['state']}" + (f" ({figures['cause']})" if figures["cause"] else ""),
        f"expected from the bank: {in_words(figures['expected'])}",
        *(f"warning: {warning}" for warning in figures["warnings"]),
        *figures["unfelt"],
        MORE,
    ]
    return "\n".join(lines)


def _percent(share: float | None) -> str:
    return "–" if share is None else f"{100 * share:.0f} %"


def _count(number: int, one: str, many: str = "") -> str:
    return f"{number:,} {one if number == 1 else many or f'{one}s'}"

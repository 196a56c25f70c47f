"""A circuit as a netlist of KiCad (its S-expression format, version E), which Pcbnew imports: File, Import, Netlist."""

import uuid
from collections import defaultdict
from collections.abc import Sequence

from controller.workshop.bill.circuit import Component

SPACE = uuid.UUID("6f1a9d0e-7d0c-5b53-9a0e-6f1ab5f0c7a1")  # of the parts' identifiers: a part keeps its own from call to call


def kicad_netlist(components: Sequence[Component], source: str) -> str:
    """The file's text; `source` says what it was made from."""
    nets: defaultdict[str, list[tuple[str, str]]] = defaultdict(list)
    design = f'  (design (source {_text(source)}) (date "") (tool "haptic-panel board bom"))'
    lines = ['(export (version "E")', design, "  (components"]
    for one in components:
        stamp = uuid.uuid5(SPACE, one.reference)
        lines += [
            f"    (comp (ref {_text(one.reference)})",
            f"      (value {_text(one.value)})",
            f"      (footprint {_text(one.footprint)})",
            f'      (fields (field (name "Specification") {_text(one.text)}))',
            f'      (libsource (lib "haptic-panel") (part {_text(one.value)}) (description {_text(one.text)}))',
            '      (sheetpath (names "/") (tstamps "/"))',
            f'      (tstamps "{stamp}"))',
        ]
        for pad, net in one.pads.items():
            nets[net].append((one.reference, pad))
    lines += ["  )", "  (nets"]
    for code, net in enumerate(sorted(nets), 1):
        lines.append(f'    (net (code "{code}") (name {_text(net)})')
        lines += [f"      (node (ref {_text(reference)}) (pin {_text(pad)}))" for reference, pad in nets[net]]
        lines[-1] += ")"
    return "\n".join([*lines, "  ))", ""])


def _text(value: str) -> str:
    return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'

"""What is wired to each header pin of an FPGA board, and its drawing: `python tests/board_top/wiring.py` writes every wiring.svg.

Pins are those of pins.lpf or pins.cst, lines of the host those of board.toml, resistors those of the stages' netlists.
"""

from typing import NamedTuple

from compiled_top import BOARDS, CHANNELS, SIGNALS, files
from fpga_pins import Pin

from controller.workshop.benchmark.stage.stage_circuit import parameters

# Of the 40-pin header of every Raspberry Pi
PI_PINS = {
    "GPIO8": 24,
    "GPIO9": 21,
    "GPIO10": 19,
    "GPIO11": 23,
    "GPIO22": 15,
    "GPIO23": 16,
    "GPIO24": 18,
    "GPIO25": 22,
    "GPIO27": 13,
}
SPI_LINES = {"SCK": "GPIO11", "CS": "GPIO8", "MOSI": "GPIO10", "MISO": "GPIO9"}  # spidev0.0
SUPPLY = {"hv_enable": "switch of the 60 V supply", "hv_alive": "charge pump of the 60 V supply"}
COLOURS = {"host": "#1f4e79", "stage": "#7a1f1f", "safety": "#b45309", "plain": "#555"}
TITLES = {"ulx3s": "ULX3S", "colorlight_i5": "Colorlight i5 or i9", "tang_primer_20k": "Tang Primer 20K, Lite"}
SITES = ("tang_primer_20k",)  # boards that have the site of the FPGA printed beside each contact
NOTES = (
    "A resistor to ground at the input of each stage (boards/stage), while the FPGA is not configured. All grounds are joined.",
    "The switch is the emergency stop: with the wire of the run permit open, its resistor takes the permit away.",
)
ROW, LEFT, RIGHT, WIDTH = 20, 330, 560, 960


class Wire(NamedTuple):
    """One wire from a pin of the FPGA: the other end, what kind it is, and the resistor to ground on it in ohm, if any."""

    pin: Pin
    signal: str
    end: str
    kind: str
    pull_down_ohm: float | None = None

    @property
    def header(self):
        return self.pin.contact.partition("_")[0]


def wires_of(name):
    """What is connected to each pin of the headers, in the order of its file of pins."""
    board, part = files(name), parameters()
    link, signals = board.board.link, {port: signal for signal, port in SIGNALS.items()}
    lines = SPI_LINES | {"trigger": link.trigger_line, "configured": link.configured_line, "run permit": link.permit_line}
    made = []
    for pin in board.pins.values():
        signal = signals.get(pin.port, "")
        if pin.port in CHANNELS:
            channel = CHANNELS.index(pin.port)
            made.append(Wire(pin, f"channel {channel}", f"stage {channel}", "stage", part["pull_down_ohm"]))
        elif signal in SUPPLY:
            made.append(Wire(pin, signal, SUPPLY[signal], "safety", part["supply_pull_down_ohm"]))
        elif signal == "temperature good":
            made.append(Wire(pin, signal, "3.3 V by the switch that opens when hot", "safety", 10e3))
        elif signal in lines:
            line = str(lines[signal])
            end = f"Pi {line}, pin {PI_PINS[line]}"
            made.append(Wire(pin, signal, end, "host", 10e3 if signal == "run permit" else None))
        elif signal:
            made.append(Wire(pin, signal, "test point", "plain"))
    return made


def drawing(name):
    """SVG of all wires: the host on the left, stages and supply on the right."""
    made, body, y = wires_of(name), [], 80
    for header in dict.fromkeys(wire.header for wire in made):
        own = [wire for wire in made if wire.header == header]
        size = f'width="{RIGHT - LEFT}" height="{ROW * (len(own) + 2)}"'
        body.append(f'<rect x="{LEFT}" y="{y}" {size} fill="#e0ecfb" stroke="#444"/>')
        body.append(_text((LEFT + RIGHT) // 2, y + ROW, f"{TITLES[name]}, {header}", "middle", "#222", bold=True))
        for number, wire in enumerate(own):
            body += _drawn(wire, y + ROW * (number + 2), wire.pin.site if name in SITES else wire.pin.name)
        y += ROW * (len(own) + 3)
    heads = [_text(20, 28, f"{TITLES[name]}: host on the left, stages and supply on the right", "start", "#222", bold=True)]
    heads += [_text(20, 28 + ROW * (1 + number), note, "start", "#222") for number, note in enumerate(NOTES)]
    font = 'font-family="DejaVu Sans, sans-serif" font-size="12"'
    frame = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y}" {font}>'
    return "\n".join([frame, f'<rect width="{WIDTH}" height="{y}" fill="#fff"/>', *heads, *body, "</svg>", ""])


def _drawn(wire, y, printed):
    """One row: contact, name and signal in the box, the wire with its resistor or switch, and its other end."""
    colour, contact = COLOURS[wire.kind], wire.pin.contact.partition("_")[2]
    yield _text(LEFT + 8, y + 4, contact, "start", "#777")
    if printed != wire.pin.contact:
        yield _text(LEFT + 44, y + 4, printed, "start", "#222")
    yield _text(LEFT + 100, y + 4, wire.signal, "start", "#222")
    near, far, way = (LEFT, LEFT - 120, -1) if wire.kind == "host" else (RIGHT, RIGHT + 120, 1)
    middle = near + (20 if way > 0 else -70)
    line = f"M{near} {y}H{far}"
    if wire.signal == "run permit":  # by a switch
        line = f"M{near} {y}H{far - 35 * way}m{10 * way} -8L{far - 15 * way} {y}H{far}"
    yield f'<path d="{line}" fill="none" stroke="{colour}" stroke-width="1.5"/>'
    if wire.pull_down_ohm:
        yield f'<path d="M{middle} {y}v7h6v-2h14v4h-14v-2m14 0h6m0 -4v8m3 -6v4" fill="none" stroke="#222"/>'
        yield _text(middle + 34, y + 10, f"{wire.pull_down_ohm / 1e3:g} kΩ", "start", "#222", size=9)
    yield _text(far + 6 * way, y + 4, wire.end, "end" if way < 0 else "start", colour)


def _text(x, y, said, anchor, colour, *, bold=False, size=12):
    style = ' font-weight="bold"' * bold + (f' font-size="{size}"' if size != 12 else "")
    return f'<text x="{x}" y="{y}" text-anchor="{anchor}" fill="{colour}"{style}>{said}</text>'


if __name__ == "__main__":
    for each in BOARDS:
        (files(each).folder / "wiring.svg").write_text(drawing(each))

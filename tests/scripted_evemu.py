"""Recordings of touches that a test writes."""

AXES = "A: 2f 0 9 0 0 0\nA: 35 0 2100 0 0 0\nA: 36 0 1480 0 0 0\nA: 39 0 65535 0 0 0\n"  # tenths of a millimetre on the plate


def evemu(*reports):
    """Recording text of `(time_s, {slot: (x_mm, y_mm) or None})` reports; a slot that was away begins a new contact."""
    lines, down, ids = [AXES], set(), iter(range(65536))
    for time_s, slots in reports:
        for slot, place in slots.items():
            events = [(3, 0x2F, slot)]
            if place is None:
                events.append((3, 0x39, -1))
                down.discard(slot)
            else:
                if slot not in down:
                    events.append((3, 0x39, next(ids)))
                    down.add(slot)
                events += [(3, 0x35, round(10 * place[0])), (3, 0x36, round(10 * place[1]))]
            lines += [f"E: {time_s:.6f} {kind:04x} {code:04x} {value:04d}\n" for kind, code, value in events]
        lines.append(f"E: {time_s:.6f} 0000 0000 0000\n")
    return "".join(lines)

"""Text in the shapes of other programs that record input devices, from one list of events; written after their sources.

libinput record (tools/libinput-record.c), evtest (evtest.c), getevent (toolbox/getevent.c and its labels), evemu (evemu.c).
"""

EV_SYN, EV_KEY, EV_ABS, EV_MSC = 0, 1, 3, 4
TYPES = {EV_SYN: "EV_SYN", EV_KEY: "EV_KEY", EV_ABS: "EV_ABS", EV_MSC: "EV_MSC"}
NAMES = {
    (EV_SYN, 0): "SYN_REPORT",
    (EV_SYN, 2): "SYN_MT_REPORT",
    (EV_SYN, 3): "SYN_DROPPED",
    (EV_KEY, 0x14A): "BTN_TOUCH",
    (EV_KEY, 0x145): "BTN_TOOL_FINGER",
    (EV_KEY, 0x110): "BTN_MOUSE",
    (EV_ABS, 0x00): "ABS_X",
    (EV_ABS, 0x01): "ABS_Y",
    (EV_ABS, 0x2F): "ABS_MT_SLOT",
    (EV_ABS, 0x30): "ABS_MT_TOUCH_MAJOR",
    (EV_ABS, 0x35): "ABS_MT_POSITION_X",
    (EV_ABS, 0x36): "ABS_MT_POSITION_Y",
    (EV_ABS, 0x37): "ABS_MT_TOOL_TYPE",
    (EV_ABS, 0x39): "ABS_MT_TRACKING_ID",
    (EV_ABS, 0x3A): "ABS_MT_PRESSURE",
    (EV_MSC, 4): "MSC_SCAN",
}
AXES = {0x2F: (0, 9), 0x35: (0, 2100), 0x36: (0, 1480), 0x39: (0, 65535)}
KEYS = (0x14A,)
KEY_VALUES = {0: "UP", 1: "DOWN", 2: "REPEAT"}
TOOLS = {0: "MT_TOOL_FINGER", 1: "MT_TOOL_PEN", 2: "MT_TOOL_PALM"}
PROPERTIES = {1: "INPUT_PROP_DIRECT", 0: "INPUT_PROP_POINTER"}


def split(time_us):
    return time_us // 1_000_000, time_us % 1_000_000


def evemu(events, axes=AXES):
    head = "# EVEMU 1.3\nN: panel\n" + "".join(f"A: {code:02x} {low} {high} 0 0 0\n" for code, (low, high) in axes.items())
    lines = ["E: {}.{:06d} {:04x} {:04x} {:04d}\n".format(*split(us), kind, code, value) for us, kind, code, value in events]
    return head + "".join(lines)


def libinput(*devices):
    """Of (name, events, axes, keys, properties) each; times as that program has them, from the first event."""
    text = (
        f'# libinput record\nversion: 1\nndevices: {len(devices)}\nlibinput:\n  version: "1.22.1"\n  git: "unknown"\nsystem:\n'
        '  os: "debian:12"\n  kernel: "6.1.0"\n  dmi: "dmi:bvnX:"\ndevices:\n'
    )
    for number, (name, events, axes, keys, properties) in enumerate(devices):
        text += f"- node: /dev/input/event{number}\n  evdev:\n    # Name: {name}\n    # ID: bus 0x18 vendor 0 product 0 version 0\n"
        text += "    # Supported Events:\n    # Event type 0 (EV_SYN)\n    # Event type 3 (EV_ABS)\n"
        for code, (low, high) in axes.items():
            text += f"    #   Event code {code} ({NAMES[EV_ABS, code]})\n    #       Value  {3 if code == 0x2F else 0:9d}\n"
            text += f"    #       Min    {low:9d}\n    #       Max    {high:9d}\n    #       Fuzz           0\n"
        text += "    # Properties:\n" + "".join(f"    #    Property {bit} ({PROPERTIES[bit]})\n" for bit in properties)
        text += f'    name: "{name}"\n    id: [24, 0, 0, 0]\n    codes:\n      0: [0, 1, 2, 3] # EV_SYN\n'
        text += f"      1: [{', '.join(map(str, keys))}] # EV_KEY\n      3: [{', '.join(map(str, axes))}] # EV_ABS\n    absinfo:\n"
        text += "".join(f"      {code}: [{low}, {high}, 0, 0, 0]\n" for code, (low, high) in axes.items())
        text += f"    properties: [{', '.join(map(str, properties))}]\n  hid: [\n    0x05, 0x0d, 0x09, 0x04\n  ]\n"
        text += (
            "  udev:\n    properties:\n    - ID_INPUT=1\n    - ID_INPUT_TOUCHSCREEN=1\n    virtual: false\n  quirks:\n  events:\n"
        )
        text += "  # Current time is 12:32:28\n  - libinput:\n    - {time: 0.000000, type: DEVICE_ADDED, seat: seat0}\n"
        begins = True
        for us, kind, code, value in events:
            text += "  - evdev:\n" if begins else ""
            begins = (kind, code) == (EV_SYN, 0)
            second, microsecond = split(us)
            word = (
                f"------------ {NAMES[kind, code]} (0) ---------- +8ms"
                if kind == EV_SYN
                else f"{TYPES[kind]} / {NAMES[kind, code]:20s} {value:4d}"
            )
            text += f"    - [{second:3d}, {microsecond:6d}, {kind:3d}, {code:3d}, {value:7d}] # {word}\n"
    return text


def evtest(name, events, axes=AXES, keys=KEYS, properties=(1,), head=True):
    text = ""
    if head:
        text += "Input driver version is 1.0.1\nInput device ID: bus 0x18 vendor 0x0 product 0x0 version 0x0\n"
        text += f'Input device name: "{name}"\n'
        text += "Supported events:\n  Event type 0 (EV_SYN)\n  Event type 1 (EV_KEY)\n"
        text += "".join(f"    Event code {code} ({NAMES[EV_KEY, code]})\n" for code in keys) + "  Event type 3 (EV_ABS)\n"
        for code, (low, high) in axes.items():
            text += f"    Event code {code} ({NAMES[EV_ABS, code]})\n      Value {3 if code == 0x2F else 0:6d}\n"
            text += f"      Min   {low:6d}\n      Max   {high:6d}\n      Resolution  {10:6d}\n"
        text += "Properties:\n" + "".join(f"  Property type {bit} ({PROPERTIES[bit]})\n" for bit in properties)
        text += "Testing ... (interrupt to exit)\n"
    marks = {0: ("--------------", "------------"), 2: ("++++++++++++++", "++++++++++++"), 3: (">>>>>>>>>>>>>>", "<<<<<<<<<<<<")}
    for us, kind, code, value in events:
        stamp = "Event: time {}.{:06d}, ".format(*split(us + 1697531620_950000))
        if kind == EV_SYN:
            before, after = marks[code]
            text += f"{stamp}{before} {NAMES[kind, code]} {after}\n"
        else:
            said = f"{value:02x}" if kind == EV_MSC else str(value)
            text += f"{stamp}type {kind} ({TYPES[kind]}), code {code} ({NAMES[kind, code]}), value {said}\n"
    return text


def getevent(events, *, labels=True, device="", axes=None, name="panel", path="/dev/input/event3", rate=False, old=False):
    """`device`: the path before each event, as of a call for all devices; `axes`: the head that `-i` adds."""
    text = f'add device 1: {path}\n  name:     "{name}"\n'
    if axes is not None:
        text = (
            f'add device 1: {path}\n  bus:      0018\n  vendor    0000\n  product   0000\n  version   0000\n  name:     "{name}"\n'
        )
        text += '  location: ""\n  id:       ""\n  version:  1.0.1\n  events:\n'
        text += "    KEY (0001): " + ("BTN_TOUCH             BTN_TOOL_FINGER\n" if labels else "0145  014a \n")
        for k, (code, (low, high)) in enumerate(axes.items()):
            code_label = f"{NAMES[EV_ABS, code]:20s}" if labels else f"{code:04x} "
            value = 3 if code == 0x2F else 0
            begin = "ABS (0003):" if k == 0 else " " * 11
            text += f"    {begin} {code_label} : value {value}, min {low}, max {high}, fuzz 0, flat 0, resolution 0\n"
        text += "  input props:\n    INPUT_PROP_DIRECT\n"
    for us, kind, code, value in events:
        second, microsecond = split(us + 31_200_000)
        stamp = f"{second}-{microsecond}: " if old else f"[{second:8d}.{microsecond:06d}] "
        said = f"{value & 0xFFFFFFFF:08x}"
        if labels:
            labels_of = KEY_VALUES if kind == EV_KEY else TOOLS if (kind, code) == (EV_ABS, 0x37) else {}
            said = labels_of.get(value, said)
            what = f"{TYPES[kind]:12.12s} {NAMES[kind, code]:20.20s} {said:20.20s}"
        else:
            what = f"{kind:04x} {code:04x} {said}"
        text += (
            stamp + (f"{device}: " if device else "") + what + (" rate 100" if rate and (kind, code) == (EV_SYN, 0) else "") + "\n"
        )
    return text

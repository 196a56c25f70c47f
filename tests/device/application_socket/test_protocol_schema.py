"""The schema of the protocol takes what panel and clients say, and refuses what the panel refuses."""

import json

from device.application_socket.test_readme import conversations
from tables import each_row

from controller.device.application_socket.protocol.schema import protocol_schema, protocol_schema_text

SCHEMA = json.loads(json.dumps(protocol_schema()))
REGION = {"name": "a", "shape": "plate", "effects": ["click"]}


def validator_of(what):
    import jsonschema  # a second of each process that imports it

    return jsonschema.Draft202012Validator(what)


def fits(side, value):
    whole = {"$ref": f"#/$defs/{side}", "$defs": SCHEMA["$defs"]}
    return validator_of(whole).is_valid(value)


def test_it_is_a_schema():
    assert json.loads(protocol_schema_text()).keys() == SCHEMA.keys()
    validator_of(SCHEMA).check_schema(SCHEMA)


@each_row("line", [line for lines in conversations() for line in lines])
def test_every_line_of_the_readme_fits(line):
    side = "Request" if line.startswith("> ") else "Message"
    if "clik" not in line or side == "Message":
        assert fits(side, json.loads(line[2:]))


@each_row(
    ("request_", "good"),
    [
        ({"kind": "regions", "regions": [REGION]}, True),
        ({"kind": "regions", "regions": [REGION | {"effects": [{"when": "press", "pulses": [[0, 1], [20, 0.5]]}]}]}, True),
        ({"kind": "regions", "regions": [REGION | {"shape": "oval"}]}, False),
        ({"kind": "regions", "regions": [REGION | {"more": 1}]}, False),
        ({"kind": "regions", "regions": [], "effects": {"a": {"rate_hz": -1}}}, False),
        ({"kind": "regions", "regions": [], "transform": {"scale": 0}}, False),
        ({"kind": "transform", "x_mm": 1e5}, False),
        ({"kind": "subscribe", "to": ["faults", "description"]}, True),
        ({"kind": "subscribe", "to": []}, False),
        ({"kind": "load_scene", "name": "../x"}, False),
        ({"kind": "save_scene", "name": "mine", "toml": ""}, True),
        ({"kind": "save_scene", "name": ".mine", "toml": ""}, False),
        ({"kind": "pause"}, False),
        ([], False),
    ],
)
def test_what_the_panel_refuses_does_not_fit(request_, good):
    assert fits("Request", request_) is good

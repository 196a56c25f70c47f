"""The protocol as a JSON Schema, made from the records of both sides' messages and of a scene's regions: `protocol.schema.json`.

`$defs/Request` is any line of a client, `$defs/Message` any line of the panel.
"""

from __future__ import annotations

import json
from inspect import cleandoc
from typing import Any

import msgspec

from controller.device.application_socket.protocol.client_messages import LINE_BYTES, AnyRequest
from controller.device.application_socket.protocol.panel_messages import PROTOCOL, AnyMessage
from controller.device.board.descriptions import END
from controller.device.board.reference import SCHEMA_DIALECT
from controller.device.scene.effects.effects import EffectTable
from controller.device.scene.scene_tables import AnyRegionTable


def protocol_schema() -> dict[str, Any]:
    """The schema; regions and effects of a client are those of a scene."""
    kinds = AnyRequest, AnyMessage, AnyRegionTable, EffectTable
    (request, message, region, effect), found = msgspec.json.schema_components(kinds, ref_template="#/$defs/{name}")
    for record in found.values():
        if "description" in record:
            record["description"] = cleandoc(record["description"])  # Python 3.13 does so itself
    regions = found["Regions"]["properties"]
    regions["regions"]["items"] = region
    found["Clip"]["properties"]["effect"] = effect
    regions["effects"] = {"type": "object", "additionalProperties": effect, "default": {}}
    return {
        "$schema": SCHEMA_DIALECT,
        "title": f"Protocol {PROTOCOL} of the application socket",
        "description": f"One JSON object a line; a line of a client has at most {LINE_BYTES} bytes, but for regions.",
        "anyOf": [{"$ref": "#/$defs/Request"}, {"$ref": "#/$defs/Message"}],
        "$defs": {"Request": request, "Message": message} | dict(sorted(found.items())),
    }


def protocol_schema_text() -> str:
    """The schema as it is committed."""
    return json.dumps(protocol_schema(), indent=1, ensure_ascii=False).replace(json.dumps(END)[1:], '$"') + "\n"

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Reads sentences from stdin with pynmea2 and prints one JSON object for each.

A sentence of a type that pynmea2 does not know has no fields.

Run by the Python of .venv-clients.
"""

import json
import sys

import pynmea2

for line in sys.stdin:
    try:
        message = pynmea2.parse(line.strip(), check=True)
    except pynmea2.SentenceTypeError:
        print(json.dumps({"type": line[3:6], "fields": None}))
        continue
    known = {name: getattr(message, name) for _, name, *_ in type(message).fields}
    for name in ("latitude", "longitude"):
        if hasattr(message, name):
            known[name] = getattr(message, name)
    print(
        json.dumps(
            {"talker": message.talker, "type": message.sentence_type, "fields": known}, default=str
        )
    )

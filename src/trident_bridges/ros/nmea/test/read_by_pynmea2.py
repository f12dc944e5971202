# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Reads sentences from stdin with pynmea2 and prints one JSON object for each.

Run by the Python of .venv-clients.
"""

import json
import sys

import pynmea2

for line in sys.stdin:
    message = pynmea2.parse(line.strip(), check=True)
    known = {name: getattr(message, name) for _, name, *_ in type(message).fields}
    for name in ("latitude", "longitude"):
        if hasattr(message, name):
            known[name] = getattr(message, name)
    print(
        json.dumps(
            {"talker": message.talker, "type": message.sentence_type, "fields": known}, default=str
        )
    )

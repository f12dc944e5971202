# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Reads the formations of a launch file as its nodes will, and starts nothing.

What the launch file would start comes on the standard input, as JSON: `nodes`, each with `name`,
`package` and `type`, `params` by their full names, and `lowest_spawn_m`, the least height of a
spawned model, where it is known. What is worth knowing goes to the standard output, a line each;
the first error goes to the standard error, with exit code 1.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping
from typing import Any

from trident_fleet.core.errors import FormationError
from trident_fleet.core.file_check import check_formation
from trident_fleet.core.files.formation_file import FormationSource
from trident_fleet.core.settings import FleetSettings, read_settings
from trident_fleet.nodes.params import COMMON_NAMESPACE, default_formation_file, where_the_user_is

PACKAGE = "trident_fleet"
PROGRAMS = ("formation_node.py", "formation_all.py")


def formations(plan: Mapping[str, Any]) -> list[FleetSettings]:
    """Settings of the formations that the nodes of a launch file fly, each once.

    Args:
        plan: what the launch file would start; see the module.

    Raises:
        FormationError: a parameter is wrong.
    """
    found: dict[FormationSource, FleetSettings] = {}
    for node in plan["nodes"]:
        if node["package"] == PACKAGE and node["type"] in PROGRAMS:
            get = _getter(plan["params"], node["name"])
            settings = read_settings(get, default_formation_file())
            found.setdefault(settings.source, settings)
    return list(found.values())


def _getter(params: Mapping[str, Any], node: str) -> Callable[[str], Any]:
    def get(name: str) -> Any:
        value = params.get(f"{node}/{name}", params.get(f"{COMMON_NAMESPACE}/{name}"))
        is_path = name == "formation_file" and isinstance(value, str) and value
        return where_the_user_is(value) if is_path else value

    return get


def main() -> int:
    """Check a launch file.

    Returns:
        0: its formations can be flown; 1: they cannot, and the reason is reported.
    """
    try:
        plan = json.load(sys.stdin)
        for settings in formations(plan):
            for line in check_formation(settings, plan.get("lowest_spawn_m")):
                print(line)
    except FormationError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

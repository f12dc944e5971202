# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Reads the formations of a launch file as its nodes will, and starts nothing.

Usage: check_launch.py FILE.launch [name:=value ...]. What is worth knowing goes to the standard
output, a line each; the first error goes to the standard error, with exit code 1.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from typing import Any

import roslaunch.config
import roslaunch.core
import roslaunch.loader
import roslaunch.substitution_args
import roslaunch.xmlloader
import rospkg

from trident_fleet.core.errors import FormationError
from trident_fleet.core.file_check import check_formation
from trident_fleet.core.formation_file import FormationSource
from trident_fleet.core.settings import FleetSettings, read_settings
from trident_fleet.nodes.params import COMMON_NAMESPACE, default_formation_file, where_the_user_is

PACKAGE = "trident_fleet"
PROGRAMS = ("formation_node.py", "formation_all.py")


class _Loader(roslaunch.xmlloader.XmlLoader):  # type: ignore[misc]
    """Leaves out what takes long: robot descriptions, which programs have to expand."""

    def param_value(self, *args: Any) -> Any:
        """Value of a parameter; empty where a command would make it."""
        command = args[-1]
        return super().param_value(*args) if command is None else ""


def formations(file: str, words: list[str]) -> list[FleetSettings]:
    """Settings of the formations that the nodes of a launch file fly, each once.

    Args:
        file: path of the launch file.
        words: its arguments, `name:=value`.

    Raises:
        FormationError: the launch file cannot be loaded, or a parameter is wrong.
    """
    config = roslaunch.config.ROSLaunchConfig()
    try:
        _Loader().load(file, config, argv=words, verbose=False)
    except (
        roslaunch.core.RLException,
        roslaunch.xmlloader.XmlParseException,
        roslaunch.loader.LoadException,
        roslaunch.substitution_args.SubstitutionException,
    ) as error:
        raise FormationError(f"{file}: {' '.join(str(error).split())}") from error
    except rospkg.ResourceNotFound as error:
        raise FormationError(
            f"{file}: no package {error.args[0]}; legal: one that is built"
        ) from error
    params = {name: param.value for name, param in config.params.items()}
    found: dict[FormationSource, FleetSettings] = {}
    for node in config.nodes:
        if node.package == PACKAGE and node.type in PROGRAMS:
            settings = read_settings(_getter(params, node), default_formation_file())
            found.setdefault(settings.source, settings)
    return list(found.values())


def _getter(params: Mapping[str, Any], node: Any) -> Callable[[str], Any]:
    own = f"{node.namespace}{node.name}"

    def get(name: str) -> Any:
        value = params.get(f"{own}/{name}", params.get(f"{COMMON_NAMESPACE}/{name}"))
        is_path = name == "formation_file" and isinstance(value, str) and value
        return where_the_user_is(value) if is_path else value

    return get


def main(arguments: list[str] | None = None) -> int:
    """Check a launch file.

    Returns:
        0: its formations can be flown; 1: they cannot, and why is told.
    """
    file, *words = sys.argv[1:] if arguments is None else arguments
    try:
        for settings in formations(file, words):
            for line in check_formation(settings):
                print(line)
    except FormationError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

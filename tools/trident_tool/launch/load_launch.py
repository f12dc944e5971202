# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Prints as JSON what a launch file would start: ``load_launch.py FILE [name:=value …]``.

roslaunch's own loader does all substitution. It is run by its path in the environment of the
launch, because what it reads (packages, $(optenv …)) is in there. Commands of <param command=…> are
left out: they take long and have no part in what is started.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Sequence
from typing import Any

import roslaunch.config
import roslaunch.core
import roslaunch.loader
import roslaunch.xmlloader
import rospkg
from rosgraph.names import ns_join
from roslaunch import substitution_args

_LONGEST = 600
_TOO_DEEP = "it includes itself without end, or too often: Python's recursion limit is exceeded"


class _Loader(roslaunch.xmlloader.XmlLoader):  # type: ignore[misc]
    """roslaunch's loader, without commands."""

    def param_value(self, verbose: bool, name: str, ptype: Any, *sources: Any) -> Any:
        """As the base class has it; the last of the sources is the command."""
        if sources[-1] is not None and all(source is None for source in sources[:-1]):
            return ""
        return super().param_value(verbose, name, ptype, *sources)


def load(file: str, arguments: Sequence[str]) -> dict[str, Any]:
    """Nodes and parameters of a launch file.

    Args:
        file: its path.
        arguments: name:=value.

    Raises:
        ValueError: roslaunch does not take it; says why.
    """
    found = _watch_packages()
    config = _config_of(file, arguments)
    if config.config_errors:
        raise ValueError(_one_line("; ".join(config.config_errors)))
    return {
        "nodes": [_node(node) for node in config.nodes],
        "found": sorted(found),
        "params": {name: _plain(param.value) for name, param in config.params.items()},
    }


def _config_of(file: str, arguments: Sequence[str]) -> Any:
    """What roslaunch makes of a launch file; its own errors become ValueError."""
    try:
        return roslaunch.config.load_config_default(
            [(file, list(arguments))], None, loader=_Loader(), assign_machines=False
        )
    except RecursionError:
        raise ValueError(_TOO_DEEP) from None
    except rospkg.ResourceNotFound as error:
        raise ValueError(f"there is no package {error.args[0]!r}") from error
    except (roslaunch.core.RLException, ValueError, OSError) as error:
        raise ValueError(_one_line(error)) from error


def _watch_packages() -> set[str]:
    """The packages whose folders are looked up from now on, as $(find PACKAGE) does."""
    found: set[str] = set()
    find, of_eval = substitution_args._find, substitution_args._eval_dict
    eval_find = of_eval["find"]

    def watched_find(resolved: str, a: str, args: list[str], context: Any) -> Any:
        found.update(args)
        return find(resolved, a, args, context)

    def watched_eval_find(package: str) -> Any:
        found.add(package)
        return eval_find(package)

    substitution_args._find, of_eval["find"] = watched_find, watched_eval_find
    return found


def _one_line(error: object) -> str:
    """An error of roslaunch without its repetitions and line ends; the innermost file is kept."""
    *outer, reason = _without_traceback(str(error)).split("while processing ")
    if "maximum recursion depth" in reason:
        return _TOO_DEEP
    text = ("in " if outer else "") + reason.replace("Invalid roslaunch XML syntax: ", "")
    return text if len(text) <= _LONGEST else text[:_LONGEST] + " …"


def _without_traceback(text: str) -> str:
    """The lines of ``text`` in one, without that which names a traceback."""
    lines = [line.strip() for line in text.splitlines()]
    kept = " ".join(line for line in lines if line and not line.startswith("The traceback"))
    return re.sub(r"\s+", " ", kept)


def _node(node: Any) -> dict[str, Any]:
    return {
        "name": ns_join(node.namespace, node.name or node.type),
        "namespace": node.namespace,
        "package": node.package,
        "type": node.type,
        "args": node.args,
        "env": dict(node.env_args),
        "remap": [list(pair) for pair in node.remap_args],
        "required": bool(node.required),
        "respawn": bool(node.respawn),
    }


def _plain(value: Any) -> Any:
    """Binary parameters become their length: nobody asks for what is in them."""
    data = getattr(value, "data", None)
    return f"({len(data)} bytes)" if isinstance(data, bytes) else value


def main(arguments: Sequence[str]) -> int:
    """Print it; returns 1 and prints the reason to stderr where it cannot be loaded."""
    try:
        print(json.dumps(load(arguments[0], arguments[1:]), default=str))
    except ValueError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

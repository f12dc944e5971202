# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Which packages a launch file needs, so that no others are built for it. In doubt: all."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from trident_tool.building import package_manifests
from trident_tool.environment import ros_environment
from trident_tool.launch.launch_plan import load_facts
from trident_tool.launch.launchfile import find_launch_file, parse_request
from trident_tool.workspace import TridentError, Workspace

#: What `./trident run` itself uses to check and to judge a run; their Python needs no build.
_OF_THE_TOOL = ("trident_fleet", "trident_msgs")
#: The simulator loads plugins by name: what is compiled against it may be one.
_SIMULATOR = "trident_sim"
#: Compiled against it and no plugins: the simulator as a module of Python, and programs of benches.
_NO_PLUGINS = frozenset({"trident_sim_py", "trident_benchmarks"})
#: Folder of a package with its plugins of the simulator, when it has more than these.
_PLUGIN_FOLDER = "sim_plugin"
#: Their nodes start launch files of their own.
_START_OTHERS = frozenset(
    {"trident_benchmarks", "trident_eval", "trident_testing", "trident_viewer"}
)
_DISTRIBUTION = (Path("/usr/share"), Path("/opt/ros"))
_RUN = ("depend", "exec_depend", "run_depend")
_BUILD = ("depend", "build_depend", "build_export_depend")


@dataclass(frozen=True)
class Package:
    """A package of the workspace.

    Attributes:
        folder: of its package.xml, relative to the workspace.
        plugin_folder: of its plugins of the simulator, where these are apart from its nodes.
        runs_with: packages that it needs when it runs.
        builds_with: packages that it is compiled against.
    """

    folder: Path
    runs_with: frozenset[str]
    builds_with: frozenset[str]
    plugin_folder: Path | None = None


def read_packages(workspace: Workspace) -> dict[str, Package]:
    """All packages of the workspace by name.

    Raises:
        ElementTree.ParseError: a package.xml is not well-formed.
    """
    found = {}
    for manifest in package_manifests(workspace):
        root = ElementTree.parse(manifest).getroot()
        folder = manifest.parent.relative_to(workspace.root)
        plugins = folder / _PLUGIN_FOLDER
        found[(root.findtext("name") or "").strip()] = Package(
            folder,
            _named(root, _RUN),
            _named(root, _BUILD),
            plugins if (workspace.root / plugins / "CMakeLists.txt").is_file() else None,
        )
    return found


def _named(root: ElementTree.Element, tags: Iterable[str]) -> frozenset[str]:
    return frozenset((item.text or "").strip() for tag in tags for item in root.iter(tag))


def needed_packages(
    facts: Mapping[str, Any], packages: Mapping[str, Package], has_installed: Callable[[str], bool]
) -> set[str] | None:
    """Packages of the workspace that a launch file needs to be built; None: it may be any.

    A package whose nodes are started is needed with all that it runs with; one that is only looked
    into, by $(find …), with nothing but what it builds itself.

    Args:
        facts: of the launch file, as load_launch.py prints them.
        packages: of the workspace.
        has_installed: whether a package is one of the distribution, which needs none of ours.

    Returns:
        Without packages of which it needs no more than the plugins of the simulator.
    """
    started = {node["package"] for node in facts["nodes"]}
    known = (name in packages or has_installed(name) for name in started)
    if started & _START_OTHERS or not all(known):
        return None
    started |= _named_in_args(facts)
    needed = _with_all_they_run_with(started | set(_OF_THE_TOOL), packages)
    if needed & _START_OTHERS:
        return None
    if _SIMULATOR in needed:
        needed |= _with_all_they_run_with(_whole_plugin_packages(packages), packages)
    return needed | (set(facts["found"]) & set(packages))


def _named_in_args(facts: Mapping[str, Any]) -> set[str]:
    """What the arguments of nodes may mean by a package.

    A nodelet is named PACKAGE/TYPE, a command of rosrun or roslaunch by its package.
    """
    words = [word for node in facts["nodes"] for word in node["args"].split()]
    return {word.partition("/")[0] for word in words}


def _plugin_packages(packages: Mapping[str, Package]) -> set[str]:
    """Packages of the workspace with plugins of the simulator."""
    plugins = {name for name, one in packages.items() if _SIMULATOR in one.builds_with}
    return plugins - _NO_PLUGINS


def _whole_plugin_packages(packages: Mapping[str, Package]) -> set[str]:
    """Those whose plugins have no folder of their own."""
    return {name for name in _plugin_packages(packages) if not packages[name].plugin_folder}


def _with_all_they_run_with(names: set[str], packages: Mapping[str, Package]) -> set[str]:
    found: set[str] = set()
    ahead = names & set(packages)
    while ahead:
        name = ahead.pop()
        found.add(name)
        ahead |= (packages[name].runs_with & set(packages)) - found
    return found


def targets_of(names: Collection[str], packages: Mapping[str, Package]) -> list[str]:
    """Targets of ninja that build packages, with what these are compiled against.

    With the simulator come all its plugins, those of packages that are not needed otherwise, too.
    """
    folders = [packages[name].folder for name in names]
    if _SIMULATOR in names:
        others = (packages[name].plugin_folder for name in _plugin_packages(packages) - set(names))
        folders += [folder for folder in others if folder]
    return [f"{folder}/all" for folder in sorted(folders)]


def is_installed(name: str) -> bool:
    """Whether a package is one of Debian's or of a ROS distribution."""
    places = [_DISTRIBUTION[0], *_DISTRIBUTION[1].glob("*/share")]
    return any((place / name / "package.xml").is_file() for place in places)


def targets_of_launch(workspace: Workspace, words: Sequence[str]) -> list[str]:
    """Targets of ninja for the launch file of a command line; none: all are to be built.

    The workspace is configured. A launch file that roslaunch does not take is refused later, when
    all is there that it may refer to.

    Args:
        workspace: the clone.
        words: of the command line, behind ``run``.

    Raises:
        TridentError: there is no such launch file.
    """
    env = ros_environment(workspace)
    request = parse_request(words)
    launch_file = find_launch_file(workspace, request, env)
    try:
        facts = load_facts(launch_file, request.args, env)
        packages = read_packages(workspace)
    except (TridentError, ElementTree.ParseError):
        return []
    needed = needed_packages(facts, packages, is_installed)
    return [] if needed is None else targets_of(needed, packages)

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Loads launch files as roslaunch does, without a master or a process of theirs."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import roslaunch.config
import roslaunch.core
import roslaunch.xmlloader

PACKAGE = Path(__file__).resolve().parents[1]
LAUNCH = PACKAGE / "launch"


@cache
def load(file: Path, *arguments: str) -> roslaunch.config.ROSLaunchConfig:
    """The configuration that a launch file describes; runs its parameter commands (xacro)."""
    config = roslaunch.config.ROSLaunchConfig()
    loader = roslaunch.xmlloader.XmlLoader(resolve_anon=False)
    loader.load(str(file), config, argv=list(arguments), verbose=False)
    assert not config.config_errors
    return config


def nodes(config: roslaunch.config.ROSLaunchConfig) -> dict[str, roslaunch.core.Node]:
    """Nodes by their full name."""
    return {f"{node.namespace}{node.name}": node for node in config.nodes}


def parameters(config: roslaunch.config.ROSLaunchConfig) -> dict[str, object]:
    """Parameter values by their full name."""
    return {name: parameter.value for name, parameter in config.params.items()}


def arguments_of(node: roslaunch.core.Node) -> list[str]:
    """The words of a node's command line."""
    return str(node.args).split()

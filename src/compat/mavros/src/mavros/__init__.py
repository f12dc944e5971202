# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Names of mavros' topics and services, for scripts."""

from __future__ import annotations

DEFAULT_NAMESPACE = "mavros"

_namespace = [DEFAULT_NAMESPACE]


def set_namespace(namespace: str = DEFAULT_NAMESPACE) -> None:
    """Choose the node that `get_topic` names.

    Args:
        namespace: name of mavros_node, e.g. /uav1/mavros.
    """
    _namespace[0] = namespace.rstrip("/")


def get_namespace() -> str:
    """Name of the node that was chosen."""
    return _namespace[0]


def get_topic(*names: str) -> str:
    """Name of a topic or service of the node.

    Args:
        names: its parts below the node's name.
    """
    return "/".join((_namespace[0], *names))

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Methods of allocation by name: one file each, one line here."""

from __future__ import annotations

from trident_fleet.core.tasks.fields import TaskError
from trident_fleet.core.tasks.methods.auction import PriceAuction
from trident_fleet.core.tasks.methods.base import Method
from trident_fleet.core.tasks.methods.bundle import Bundle
from trident_fleet.core.tasks.methods.improved import Improved
from trident_fleet.core.tasks.methods.nearest import Nearest
from trident_fleet.core.tasks.methods.optimal import Optimal
from trident_fleet.core.tasks.methods.plain import Plain
from trident_fleet.core.tasks.methods.sequential import Sequential

DEFAULT = "improved"

_ALL: tuple[Method, ...] = (
    Nearest(),
    Plain(),
    Sequential(),
    Bundle(),
    PriceAuction(),
    Improved(),
    Optimal(),
)
METHODS: dict[str, Method] = {method.name: method for method in _ALL}


def method_named(name: str) -> Method:
    """The method of this name.

    Raises:
        TaskError: the name is unknown.
    """
    if name not in METHODS:
        raise TaskError(f"method is {name!r}, legal: {', '.join(METHODS)}")
    return METHODS[name]

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What each vehicle of a demonstration is to do: a YAML file, and the record that is left of it."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml
from trident_base.params import unknown

from trident_eval.core.errors import EvalError

KINDS = ("uav", "ugv", "usv")
ENDS = ("land", "return", "hold")
_LEGAL = (
    "a list `errands` of {vehicle: name, system: 1 to 254, kind: uav, ugv or usv, places: "
    "[[ahead, left, up], ...] [m], radius: [m], take_off: [m], end: land, return or hold}"
)


@dataclass(frozen=True)
class Errand:
    """What one vehicle is to do.

    Attributes:
        vehicle: name of its model.
        system: its system id.
        kind: `uav`, `ugv` or `usv`.
        places: to be reached one after the other: ahead, left, up of where it starts [m].
        radius: a place counts as reached within it [m].
        take_off: height of a take-off above the start [m]; 0: no take-off.
        end: `land`: back home and down; `return`: back home; `hold`: where the last place is.
    """

    vehicle: str
    system: int
    kind: str
    places: tuple[tuple[float, float, float], ...]
    radius: float
    take_off: float = 0.0
    end: str = "hold"

    @property
    def is_legal(self) -> bool:
        """Whether kind and end are known, and there are places that can be reached."""
        is_known = self.kind in KINDS and self.end in ENDS
        return is_known and bool(self.places) and not self.radius <= 0.0


@dataclass
class ErrandRecord:
    """What became of an errand, as the vehicle has said.

    Attributes:
        start: where it stood [m, world: east, north, up].
        places: of its mission [m, world].
        armed: whether it was.
        uploaded: items of its mission that it took.
        downloaded_equal: whether it returned what it was sent.
        reached: items that it has reported as reached.
        ended: whether it landed, or holds, as it was to.
        refusals: commands, missions and parameters that it has refused.
        texts: what it said about these and its modes.
        problem: why the errand was given up; empty: it was not.
    """

    start: list[float] = field(default_factory=list)
    places: list[list[float]] = field(default_factory=list)
    armed: bool = False
    uploaded: int = 0
    downloaded_equal: bool = False
    reached: list[int] = field(default_factory=list)
    ended: bool = False
    refusals: int = 0
    texts: list[str] = field(default_factory=list)
    problem: str = ""


def read_errands(path: Path) -> list[Errand]:
    """Those of a file.

    Raises:
        EvalError: unreadable or not legal; says which entry, and what is.
    """
    try:
        entries = yaml.safe_load(path.read_text(encoding="utf-8"))["errands"]
        return [_errand(entry, f"{path}: errands[{index}]") for index, entry in enumerate(entries)]
    except (OSError, yaml.YAMLError, UnicodeDecodeError, KeyError, TypeError) as error:
        raise EvalError(f"{path}: {type(error).__name__}: {error}; legal: {_LEGAL}") from error


def _errand(entry: dict[str, Any], where: str) -> Errand:
    for text in unknown(map(str, entry), list(Errand.__dataclass_fields__)):
        raise EvalError(f"{where}: {text}")
    try:
        given = dict(entry)
        places = tuple((float(x), float(y), float(z)) for x, y, z in given.pop("places"))
        errand = Errand(places=places, **given)
    except (KeyError, TypeError, ValueError) as error:
        raise EvalError(f"{where}: {error}; legal: {_LEGAL}") from error
    if not errand.is_legal:
        raise EvalError(f"{where}: {entry}; legal: {_LEGAL}")
    return errand

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Files of parameters and of missions, in the formats that ground stations write."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import Enum

_MISSION_HEADER = "QGC WPL 110"
_MISSION_COLUMNS = 12
_INTEGER, _REAL = 6, 9  # MAV_PARAM_TYPE_INT32, MAV_PARAM_TYPE_REAL32


class FormatError(ValueError):
    """A line of a file that is not of its format."""

    def __init__(self, name: str, line: int, text: str, legal: str) -> None:
        """Describe it.

        Args:
            name: of the file.
            line: number of the line, from 1.
            text: the line.
            legal: what it should be.
        """
        super().__init__(f"{name}, line {line}: '{text.strip()}', legal: {legal}")


class ParameterFormat(Enum):
    """Of a file of parameters: what separates the columns, and which are name and value."""

    MISSION_PLANNER = "mission planner"
    QGROUNDCONTROL = "qgroundcontrol"
    MAVPROXY = "mavproxy"


def _columns(line: str, layout: ParameterFormat) -> tuple[str, str]:
    if layout is ParameterFormat.MISSION_PLANNER:
        name, value = line.split(",")[:2]
    elif layout is ParameterFormat.QGROUNDCONTROL:
        name, value = line.split("\t")[2:4]
    else:
        name, value = line.split()[:2]
    return name.strip(), value.strip()


def parse_parameters(
    name: str, lines: Iterable[str], layout: ParameterFormat
) -> dict[str, int | float]:
    """Read a file of parameters.

    Args:
        name: of the file, for errors.
        lines: its text.
        layout: its format.

    Returns:
        Values by name; whole numbers as int.

    Raises:
        FormatError: a line is not a name and a number.
    """
    result: dict[str, int | float] = {}
    for number, line in enumerate(lines, 1):
        if not line.strip() or line.startswith("#"):
            continue
        try:
            key, text = _columns(line, layout)
            result[key] = float(text) if "." in text or "e" in text.lower() else int(text)
        except ValueError as error:
            legal = f"a name and a number as {layout.value} writes them"
            raise FormatError(name, number, line, legal) from error
    return result


def format_parameters(values: Mapping[str, int | float], layout: ParameterFormat) -> str:
    """The text of a file of parameters, ordered by name.

    Args:
        values: by name.
        layout: its format.
    """
    if layout is ParameterFormat.MISSION_PLANNER:
        lines = [f"{name},{values[name]}" for name in sorted(values)]
    elif layout is ParameterFormat.QGROUNDCONTROL:
        lines = [
            f"1\t1\t{name}\t{values[name]}\t{_INTEGER if isinstance(values[name], int) else _REAL}"
            for name in sorted(values)
        ]
    else:
        lines = [f"{name:16} {values[name]}" for name in sorted(values)]
    return "\n".join(lines) + "\n"


@dataclass(frozen=True)
class Item:
    """One item of a mission.

    Attributes:
        is_current: where the mission begins.
        frame: MAV_FRAME.
        command: MAV_CMD.
        params: param1 to param4.
        x: latitude [deg] or local x [m].
        y: longitude [deg] or local y [m].
        z: altitude by the frame [m].
        autocontinue: to the next item by itself.
    """

    is_current: bool
    frame: int
    command: int
    params: tuple[float, float, float, float]
    x: float
    y: float
    z: float
    autocontinue: bool


def parse_mission(name: str, lines: Iterable[str]) -> list[Item]:
    """Read a mission as QGroundControl and Mission Planner write it.

    Args:
        name: of the file, for errors.
        lines: its text.

    Raises:
        FormatError: the header or a line is not of the format.
    """
    items: list[Item] = []
    for number, line in enumerate(lines, 1):
        if number == 1:
            if not line.startswith("QGC WPL "):
                raise FormatError(name, number, line, f"'{_MISSION_HEADER}'")
            continue
        if not line.strip() or line.startswith("#"):
            continue
        try:
            items.append(_parse_item(line.split()))
        except ValueError as error:
            legal = f"{_MISSION_COLUMNS} numbers: item, current, frame, command ..."
            raise FormatError(name, number, line, legal) from error
    return items


def _parse_item(columns: list[str]) -> Item:
    if len(columns) != _MISSION_COLUMNS:
        raise ValueError
    p1, p2, p3, p4, x, y, z = (float(column) for column in columns[4:11])
    return Item(
        is_current=int(columns[1]) != 0,
        frame=int(columns[2]),
        command=int(columns[3]),
        params=(p1, p2, p3, p4),
        x=x,
        y=y,
        z=z,
        autocontinue=int(columns[11]) != 0,
    )


def format_mission(items: Iterable[Item]) -> str:
    """The text of a mission's file.

    Args:
        items: in their order.
    """
    lines = [_MISSION_HEADER]
    for number, item in enumerate(items):
        columns: list[object] = [number, int(item.is_current), item.frame, item.command]
        columns += [*item.params, f"{item.x:.9f}", f"{item.y:.9f}", item.z, int(item.autocontinue)]
        lines.append("\t".join(str(column) for column in columns))
    return "\n".join(lines) + "\n"

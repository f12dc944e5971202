# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""mavparam: parameters from and to files, single ones."""

from __future__ import annotations

import argparse
from pathlib import Path

import rospy
from mavros_msgs.msg import ParamValue
from mavros_msgs.srv import ParamGet, ParamPull, ParamSet

import mavros
from mavros.files import ParameterFormat, format_parameters, parse_parameters
from mavros.tool import ToolError, add_command, call, make_parser, require, run


def _value(number: float) -> ParamValue:
    if isinstance(number, int):
        return ParamValue(integer=number)
    return ParamValue(real=number)


def _number(value: ParamValue) -> int | float:
    return int(value.integer) if value.integer != 0 else float(value.real)


def _layout(a: argparse.Namespace) -> ParameterFormat:
    if a.mission_planner:
        return ParameterFormat.MISSION_PLANNER
    return ParameterFormat.QGROUNDCONTROL if a.qgroundcontrol else ParameterFormat.MAVPROXY


def _pull(is_forced: bool) -> int:
    answer = call("param/pull", ParamPull, force_pull=is_forced)
    require(answer.success, "parameters")
    return int(answer.param_received)


def _load(a: argparse.Namespace) -> None:
    wanted = parse_parameters(a.file, Path(a.file).read_text().splitlines(), _layout(a))
    _pull(False)
    sent = 0
    for name, number in wanted.items():
        if rospy.get_param(mavros.get_topic("param", name), None) == number:
            continue
        answer = call("param/set", ParamSet, param_id=name, value=_value(number))
        require(answer.success, f"parameter {name}")
        sent += 1
    print(f"Parameters transferred: {sent}")


def _dump(a: argparse.Namespace) -> None:
    count = _pull(a.force)
    values = rospy.get_param(mavros.get_topic("param"))
    Path(a.file).write_text(format_parameters(values, _layout(a)))
    print(f"Parameters received: {count}")


def _get(a: argparse.Namespace) -> None:
    answer = call("param/get", ParamGet, param_id=a.param_id)
    require(answer.success, f"parameter {a.param_id}")
    print(_number(answer.value))


def _set(a: argparse.Namespace) -> None:
    try:
        number = float(a.value) if "." in a.value else int(a.value)
    except ValueError as error:
        raise ToolError(f"value is '{a.value}', legal: a number") from error
    answer = call("param/set", ParamSet, param_id=a.param_id, value=_value(number))
    require(answer.success, f"parameter {a.param_id}")
    print(_number(answer.value))


def _add_formats(parser: argparse.ArgumentParser) -> None:
    layout = parser.add_mutually_exclusive_group()
    layout.add_argument("-mp", "--mission-planner", action="store_true", help="NAME,value")
    layout.add_argument("-qgc", "--qgroundcontrol", action="store_true", help="five columns")
    layout.add_argument("-mavpx", "--mavproxy", action="store_true", help="NAME value (default)")


def main() -> int:
    """Run the tool."""
    parser = make_parser("Reads and sets parameters of a vehicle.")
    commands = parser.add_subparsers(dest="command", required=True)
    load = add_command(commands, "load", "send a file of parameters", _load)
    load.add_argument("file", help="to read")
    _add_formats(load)
    dump = add_command(commands, "dump", "write all parameters to a file", _dump)
    dump.add_argument("file", help="to write")
    dump.add_argument("-f", "--force", action="store_true", help="read them from the vehicle again")
    _add_formats(dump)
    get = add_command(commands, "get", "print a parameter", _get)
    get.add_argument("param_id", help="its name")
    change = add_command(commands, "set", "set a parameter", _set)
    change.add_argument("param_id", help="its name")
    change.add_argument("value", help="with a point: a real number")
    return run(parser)

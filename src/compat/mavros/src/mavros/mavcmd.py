# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""mavcmd: any command, home, take-off, landing."""

from __future__ import annotations

import argparse

import rospy
from mavros_msgs.srv import (
    CommandHome,
    CommandInt,
    CommandLong,
    CommandTOL,
    CommandTriggerControl,
)
from sensor_msgs.msg import NavSatFix

import mavros
from mavros.tool import Handler, ToolError, add_command, call, make_parser, require, run

_PARAMS = [f"param{i}" for i in range(1, 8)]
_FIX_LIMIT_S = 10.0


def _send_long(a: argparse.Namespace) -> None:
    params = {name: getattr(a, name) for name in _PARAMS}
    answer = call(
        "cmd/command",
        CommandLong,
        broadcast=a.broadcast,
        confirmation=int(a.confirmation),
        command=a.number,
        **params,
    )
    require(answer.success, f"command {a.number} (result {answer.result})")


def _send_int(a: argparse.Namespace) -> None:
    params = {name: getattr(a, name) for name in _PARAMS[:4]}
    answer = call(
        "cmd/command_int",
        CommandInt,
        frame=a.frame,
        command=a.number,
        current=int(a.current),
        autocontinue=int(a.autocontinue),
        x=a.x,
        y=a.y,
        z=a.z,
        **params,
    )
    require(answer.success, f"command {a.number}")


def _set_home(a: argparse.Namespace) -> None:
    answer = call(
        "cmd/set_home",
        CommandHome,
        current_gps=a.current_gps,
        latitude=a.latitude,
        longitude=a.longitude,
        altitude=a.altitude,
    )
    require(answer.success, "home")


def _fix() -> NavSatFix:
    topic = mavros.get_topic("global_position", "global")
    try:
        return rospy.wait_for_message(topic, NavSatFix, _FIX_LIMIT_S)
    except rospy.ROSException as error:
        raise ToolError(f"no fix on {topic}: {error}") from error


def _go(service: str, a: argparse.Namespace) -> None:
    if a.latitude is None:
        fix = _fix()
        a.latitude, a.longitude = fix.latitude, fix.longitude
    answer = call(
        f"cmd/{service}",
        CommandTOL,
        min_pitch=getattr(a, "min_pitch", 0.0),
        yaw=a.yaw,
        latitude=a.latitude,
        longitude=a.longitude,
        altitude=a.altitude,
    )
    require(answer.success, f"{service} (result {answer.result})")


def _take_off(a: argparse.Namespace) -> None:
    _go("takeoff", a)


def _land(a: argparse.Namespace) -> None:
    _go("land", a)


def _trigger(a: argparse.Namespace) -> None:
    answer = call("cmd/trigger_control", CommandTriggerControl, trigger_enable=a.trigger_enable)
    require(answer.success, "trigger")


def _add_raw(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    long = add_command(commands, "long", "send COMMAND_LONG", _send_long)
    long.add_argument("-c", "--confirmation", action="store_true", help="of a repeated one")
    long.add_argument("-b", "--broadcast", action="store_true", help="to all vehicles")
    long.add_argument("number", type=int, metavar="command", help="MAV_CMD")
    for name in _PARAMS:
        long.add_argument(name, type=float)
    whole = add_command(commands, "int", "send COMMAND_INT", _send_int)
    whole.add_argument("-c", "--current", action="store_true", help="field current")
    whole.add_argument("-a", "--autocontinue", action="store_true", help="field autocontinue")
    whole.add_argument("-f", "--frame", type=int, default=3, help="MAV_FRAME")
    whole.add_argument("number", type=int, metavar="command", help="MAV_CMD")
    for name in _PARAMS[:4]:
        whole.add_argument(name, type=float)
    whole.add_argument("x", type=int, help="latitude [1e-7 deg] or [1e-4 m]")
    whole.add_argument("y", type=int, help="longitude [1e-7 deg] or [1e-4 m]")
    whole.add_argument("z", type=float, help="[m]")


def _add_places(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    home = add_command(commands, "sethome", "set the home position", _set_home)
    home.add_argument("-c", "--current-gps", action="store_true", help="where the vehicle is")
    for name in ("latitude", "longitude", "altitude"):
        home.add_argument(name, type=float)
    _add_go(commands, "takeoff", _take_off)
    _add_go(commands, "land", _land)


def _add_go(
    commands: argparse._SubParsersAction[argparse.ArgumentParser], name: str, handler: Handler
) -> None:
    for is_here in (False, True):
        text = f"{name} " + ("where the vehicle is" if is_here else "at a place")
        parser = add_command(commands, name + ("cur" if is_here else ""), text, handler)
        if name == "takeoff":
            parser.add_argument("min_pitch", type=float, help="of aeroplanes [deg]")
        parser.add_argument("yaw", type=float, help="clockwise from north [deg]")
        if is_here:
            parser.add_argument("-a", "--any-gps", action="store_true", help="kept for callers")
            parser.set_defaults(latitude=None, longitude=None)
        else:
            parser.add_argument("latitude", type=float, help="[deg]")
            parser.add_argument("longitude", type=float, help="[deg]")
        parser.add_argument("altitude", type=float, help="[m]")


def main() -> int:
    """Run the tool."""
    parser = make_parser("Sends commands to a vehicle.")
    commands = parser.add_subparsers(dest="command", required=True)
    _add_raw(commands)
    _add_places(commands)
    trigger = add_command(commands, "trigger_control", "switch a camera's trigger", _trigger)
    which = trigger.add_mutually_exclusive_group()
    which.add_argument("-e", "--enable", dest="trigger_enable", action="store_true", default=True)
    which.add_argument("-d", "--disable", dest="trigger_enable", action="store_false")
    return run(parser)

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""mavwp: missions from and to files."""

from __future__ import annotations

import argparse
from pathlib import Path

import rospy
from mavros_msgs.msg import Waypoint, WaypointList
from mavros_msgs.srv import WaypointClear, WaypointPull, WaypointPush, WaypointSetCurrent

import mavros
from mavros.files import Item, format_mission, parse_mission
from mavros.tool import ToolError, add_command, call, make_parser, require, run

_LIST_LIMIT_S = 10.0


def _to_waypoint(item: Item) -> Waypoint:
    p1, p2, p3, p4 = item.params
    return Waypoint(
        frame=item.frame,
        command=item.command,
        is_current=item.is_current,
        autocontinue=item.autocontinue,
        param1=p1,
        param2=p2,
        param3=p3,
        param4=p4,
        x_lat=item.x,
        y_long=item.y,
        z_alt=item.z,
    )


def _to_item(waypoint: Waypoint) -> Item:
    return Item(
        is_current=bool(waypoint.is_current),
        frame=waypoint.frame,
        command=waypoint.command,
        params=(waypoint.param1, waypoint.param2, waypoint.param3, waypoint.param4),
        x=waypoint.x_lat,
        y=waypoint.y_long,
        z=waypoint.z_alt,
        autocontinue=bool(waypoint.autocontinue),
    )


def _pull() -> int:
    answer = call("mission/pull", WaypointPull)
    require(answer.success, "mission")
    return int(answer.wp_received)


def _items() -> list[Item]:
    topic = mavros.get_topic("mission", "waypoints")
    try:
        message = rospy.wait_for_message(topic, WaypointList, _LIST_LIMIT_S)
    except rospy.ROSException as error:
        raise ToolError(f"no list on {topic}: {error}") from error
    return _items_of(message)


def _items_of(message: WaypointList) -> list[Item]:
    return [_to_item(waypoint) for waypoint in message.waypoints]


def _show(a: argparse.Namespace) -> None:
    if a.pull:
        _pull()
    if not a.follow:
        print(format_mission(_items()), end="")
        return
    topic = mavros.get_topic("mission", "waypoints")  # latched: the first is that of now
    rospy.Subscriber(
        topic, WaypointList, lambda list_: print(format_mission(_items_of(list_)), end="")
    )
    rospy.spin()


def _load(a: argparse.Namespace) -> None:
    items = parse_mission(a.file, Path(a.file).read_text().splitlines())
    if a.end_index > 0:
        items = items[: a.end_index]
    if a.preserve_home and items:
        _pull()
        known = _items()
        items[0] = known[0] if known else items[0]
    waypoints = [_to_waypoint(item) for item in items[a.start_index :]]
    answer = call("mission/push", WaypointPush, start_index=a.start_index, waypoints=waypoints)
    require(answer.success, "mission")
    print(f"Waypoints transferred: {answer.wp_transfered}")


def _print_pulled(_arguments: argparse.Namespace) -> None:
    print(f"Waypoints received: {_pull()}")


def _dump(a: argparse.Namespace) -> None:
    count = _pull()
    Path(a.file).write_text(format_mission(_items()))
    print(f"Waypoints received: {count}")


def _clear(_arguments: argparse.Namespace) -> None:
    require(call("mission/clear", WaypointClear).success, "clear")


def _set_current(a: argparse.Namespace) -> None:
    require(call("mission/set_current", WaypointSetCurrent, wp_seq=a.seq).success, f"item {a.seq}")


def main() -> int:
    """Run the tool."""
    parser = make_parser("Reads and sets the mission of a vehicle.")
    commands = parser.add_subparsers(dest="command", required=True)
    show = add_command(commands, "show", "print the mission", _show)
    show.add_argument("-f", "--follow", action="store_true", help="print each change, too")
    show.add_argument("-p", "--pull", action="store_true", help="read it from the vehicle first")
    load = add_command(commands, "load", "send a file", _load)
    load.add_argument("-p", "--preserve-home", action="store_true", help="item 0 stays")
    load.add_argument("-s", "--start-index", type=int, default=0, help="the first item to replace")
    load.add_argument("-e", "--end-index", type=int, default=0, help="behind the last one; 0: all")
    load.add_argument("file", help="to read")
    add_command(commands, "pull", "read the mission from the vehicle", _print_pulled)
    dump = add_command(commands, "dump", "write the mission to a file", _dump)
    dump.add_argument("file", help="to write")
    add_command(commands, "clear", "remove the mission", _clear)
    current = add_command(commands, "setcur", "choose the next item", _set_current)
    current.add_argument("seq", type=int, help="number of the item")
    return run(parser)

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""mavsys: mode, stream rates, message intervals."""

from __future__ import annotations

import argparse

from mavros_msgs.srv import MessageInterval, SetMode, StreamRate, StreamRateRequest

from mavros.tool import ToolError, add_command, call, make_parser, require, run

_STREAMS = {
    "all": StreamRateRequest.STREAM_ALL,
    "raw-sensors": StreamRateRequest.STREAM_RAW_SENSORS,
    "ext-status": StreamRateRequest.STREAM_EXTENDED_STATUS,
    "rc-channels": StreamRateRequest.STREAM_RC_CHANNELS,
    "raw-controller": StreamRateRequest.STREAM_RAW_CONTROLLER,
    "position": StreamRateRequest.STREAM_POSITION,
    "extra1": StreamRateRequest.STREAM_EXTRA1,
    "extra2": StreamRateRequest.STREAM_EXTRA2,
    "extra3": StreamRateRequest.STREAM_EXTRA3,
}


def _set_mode(arguments: argparse.Namespace) -> None:
    answer = call(
        "set_mode",
        SetMode,
        base_mode=arguments.base_mode or 0,
        custom_mode=arguments.custom_mode or "",
    )
    require(answer.mode_sent, f"mode {arguments.custom_mode or arguments.base_mode}")
    print("Mode changed.")


def _set_rate(stream: int, rate_Hz: int) -> None:
    call("set_stream_rate", StreamRate, stream_id=stream, message_rate=rate_Hz, on_off=rate_Hz != 0)


def _set_rates(arguments: argparse.Namespace) -> None:
    chosen = {
        number: getattr(arguments, name.replace("-", "_")) for name, number in _STREAMS.items()
    }
    if arguments.stream_id is not None:
        chosen[arguments.stream_id[0]] = arguments.stream_id[1]
    for number, rate_Hz in chosen.items():
        if rate_Hz is not None:
            _set_rate(number, rate_Hz)


def _set_interval(arguments: argparse.Namespace) -> None:
    if arguments.id is None or arguments.rate is None:
        raise ToolError("message_interval needs --id and --rate")
    answer = call(
        "set_message_interval",
        MessageInterval,
        message_id=arguments.id,
        message_rate=arguments.rate,
    )
    require(answer.success, f"message {arguments.id}")


def main() -> int:
    """Run the tool."""
    parser = make_parser("Changes the mode of a vehicle and what it sends.")
    commands = parser.add_subparsers(dest="command", required=True)
    mode = add_command(commands, "mode", "set the mode", _set_mode)
    chosen = mode.add_mutually_exclusive_group(required=True)
    chosen.add_argument("-b", "--base-mode", type=int, help="MAV_MODE")
    chosen.add_argument("-c", "--custom-mode", help="name of the mode, as state has it, or number")
    rate = add_command(commands, "rate", "set rates of streams", _set_rates)
    for name in _STREAMS:
        rate.add_argument(f"--{name}", type=int, metavar="rate", help="[Hz]; 0: off")
    rate.add_argument("--stream-id", type=int, nargs=2, metavar=("id", "rate"), help="any stream")
    interval = add_command(commands, "message_interval", "set the rate of a message", _set_interval)
    interval.add_argument("--id", type=int, help="number of the message")
    interval.add_argument("--rate", type=float, help="[Hz]")
    return run(parser)

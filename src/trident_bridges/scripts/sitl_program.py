#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Becomes the program of an outside autopilot: PX4's, ArduPilot's, or the stand-in for one."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from rospkg import RosPack

PACKAGE = Path(RosPack().get_path("trident_bridges"))
VARIABLES = {"px4": "PX4_SITL", "ardupilot": "ARDUPILOT_SITL"}


def stand_in(autopilot: str, instance: int) -> list[str]:
    """The command of a stand-in, by the Python that has pymavlink."""
    own = PACKAGE.parents[1] / ".venv" / "bin" / "python"
    python = str(own) if own.is_file() else sys.executable
    program = PACKAGE / "test_support" / f"{autopilot}_stand_in.py"
    flag = "-i" if autopilot == "px4" else "-I"
    return [python, str(program), flag, str(instance)]


def program(autopilot: str, instance: int) -> list[str]:
    """The command of the autopilot's program; raises SystemExit where it does not exist."""
    variable = VARIABLES[autopilot]
    path = os.environ.get(variable, "")
    if not os.access(path, os.X_OK) or Path(path).is_dir():
        sys.exit(
            f"{variable} is '{path}', legal: the path of {autopilot}'s SITL program; "
            "without one: stand_in:=true"
        )
    if autopilot == "px4":
        # build/px4_sitl_default/bin/px4: its etc/ lies next to bin/
        return [path, "-d", "-i", str(instance), str(Path(path).parents[1] / "etc")]
    return [path, "--model", "JSON:127.0.0.1", "-I", str(instance), "--slave", "0"]


def main() -> None:
    """Replace this process by the program."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--autopilot", choices=sorted(VARIABLES), required=True)
    parser.add_argument("--instance", type=int, required=True, help="of the vehicle, from 0")
    parser.add_argument("--stand-in", action="store_true", help="the stand-in, not the autopilot")
    options, _ = parser.parse_known_args()
    make = stand_in if options.stand_in else program
    command = make(options.autopilot, options.instance)
    os.environ.setdefault("PX4_SIM_MODEL", "iris")
    os.execv(command[0], command)


if __name__ == "__main__":
    main()

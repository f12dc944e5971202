# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""``./trident plan``: plans on a map with any of the planners, and draws the path."""

from __future__ import annotations

import argparse
import json
import math
import re
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from PIL import Image, ImageDraw

from trident_nav.core.errors import NavError
from trident_nav.core.programs import find_program

_POSE = re.compile(r"-[\d.][^a-z]*")
_LETHAL, _UNKNOWN, _INSCRIBED = 254, 255, 253


@dataclass(frozen=True)
class Plan:
    """What a planner answered.

    Attributes:
        found: there is a path.
        reason: why it was not found, or a comment.
        path: poses x, y [m], yaw [rad], shape (n, 3).
        footprint: corners [m] in the base's axes, shape (k, 2).
        costs: the costmap, row 0 on top, shape (rows, columns).
        resolution_m: side of a cell.
        origin_m: x, y of the costmap's lower left corner.
        time_s: that the planner took.
    """

    found: bool
    reason: str
    path: np.ndarray[Any, np.dtype[np.float64]]
    footprint: np.ndarray[Any, np.dtype[np.float64]]
    costs: np.ndarray[Any, np.dtype[np.uint8]]
    resolution_m: float
    origin_m: tuple[float, float]
    time_s: float

    def length_m(self) -> float:
        """Of the path."""
        return float(np.hypot(*np.diff(self.path[:, :2], axis=0).T).sum())


def make_parser() -> argparse.ArgumentParser:
    """The command line."""
    parser = argparse.ArgumentParser(prog="trident plan", description=__doc__)
    parser.add_argument("map", metavar="MAP.yaml", help="a map of map_server")
    parser.add_argument("start", metavar="X,Y,YAW", help="[m, rad]")
    parser.add_argument("goal", metavar="X,Y,YAW", help="[m, rad]")
    parser.add_argument(
        "--planner",
        default="nav2_smac_planner/SmacPlannerHybrid",
        metavar="NAME",
        help="as in base_global_planner; default %(default)s",
    )
    parser.add_argument(
        "--params", default="{}", metavar="YAML", help="of the planner: a file, or the text"
    )
    parser.add_argument(
        "--footprint",
        default="[[-0.21,-0.165],[0.21,-0.165],[0.21,0.165],[-0.21,0.165]]",
        metavar="[[X,Y],...]",
        help="of the robot [m]; default: a Jackal's",
    )
    parser.add_argument("--radius", type=float, metavar="M", help="of a round robot instead")
    parser.add_argument(
        "--turning-radius", type=float, default=0.0, metavar="M", help="of the robot; default 0"
    )
    parser.add_argument("--inflation", type=float, default=0.55, metavar="M", help="default 0.55")
    parser.add_argument(
        "--scaling", type=float, default=10.0, metavar="K", help="cost_scaling_factor; default 10"
    )
    parser.add_argument("--out", type=Path, metavar="FILE.png", help="picture of map and path")
    parser.add_argument("--json", type=Path, metavar="FILE.json", help="the path's poses")
    return parser


def costmap_yaml(options: argparse.Namespace) -> str:
    """The configuration of a costmap with the map and its inflation."""
    config: dict[str, Any] = {
        "plugins": [
            {"name": "static", "type": "costmap_2d::StaticLayer"},
            {"name": "inflation", "type": "costmap_2d::InflationLayer"},
        ],
        "track_unknown_space": True,
        "footprint_padding": 0.0,
        "inflation": {
            "inflation_radius": options.inflation,
            "cost_scaling_factor": options.scaling,
        },
    }
    if options.radius is None:
        config["footprint"] = options.footprint
    else:
        config["robot_radius"] = options.radius
    return str(yaml.safe_dump(config, default_flow_style=True, width=10000))


def find_plan(options: argparse.Namespace) -> Plan:
    """Has ``nav_plan`` plan.

    Raises:
        NavError: wrong input; the text is the program's.
    """
    is_file = Path(options.params).is_file()
    params = Path(options.params).read_text(encoding="utf-8") if is_file else options.params
    with tempfile.TemporaryDirectory() as folder:
        grid = Path(folder) / "grid.pgm"
        words = [options.map, options.start.strip(), options.goal.strip()]
        words += ["--planner", options.planner, "--params", params, "--grid", str(grid)]
        words += ["--costmap", costmap_yaml(options)]
        words += ["--turning-radius", str(options.turning_radius)]
        done = subprocess.run(
            [str(find_program("nav_plan")), *words], capture_output=True, text=True, check=False
        )
        if done.returncode not in (0, 1):
            raise NavError(done.stderr.strip().removeprefix("nav_plan: "))
        with Image.open(grid) as image:
            costs = np.asarray(image, dtype=np.uint8)
    answer = json.loads(done.stdout)
    return Plan(
        found=answer["found"],
        reason=answer["reason"],
        path=np.array(answer["path"], dtype=float).reshape(-1, 3),
        footprint=np.array(answer["footprint"], dtype=float).reshape(-1, 2),
        costs=costs,
        resolution_m=answer["resolution_m"],
        origin_m=(answer["origin_m"][0], answer["origin_m"][1]),
        time_s=answer["time_s"],
    )


def colors_of(costs: np.ndarray[Any, np.dtype[np.uint8]]) -> np.ndarray[Any, np.dtype[np.uint8]]:
    """A costmap in colors: free white, costs light blue to blue, lethal black, unknown gray.

    Returns:
        shape (rows, columns, 3).
    """
    table = np.zeros((256, 3), dtype=np.uint8)
    share = np.arange(_INSCRIBED)[:, None] / float(_INSCRIBED)
    table[:_INSCRIBED] = (255 - share * np.array([150, 90, 20])).astype(np.uint8)
    table[_INSCRIBED] = (90, 130, 210)
    table[_LETHAL] = (20, 20, 20)
    table[_UNKNOWN] = (150, 150, 150)
    return np.asarray(table[costs])


def draw(plan: Plan, poses: Sequence[Sequence[float]], scale: int) -> Image.Image:
    """The costmap, the path with the footprint along it, and the start's and the goal's poses.

    Args:
        plan: what is drawn.
        poses: the start and the goal: x, y [m], yaw [rad].
        scale: pixels per cell.
    """
    image = Image.fromarray(colors_of(plan.costs))
    image = image.resize((image.width * scale, image.height * scale), Image.Resampling.NEAREST)
    pen = ImageDraw.Draw(image)

    def pixel(x: float, y: float) -> tuple[float, float]:
        column = (x - plan.origin_m[0]) / plan.resolution_m * scale
        return column, image.height - (y - plan.origin_m[1]) / plan.resolution_m * scale

    def outline(pose: Sequence[float], color: str, width: int) -> None:
        c, s = math.cos(pose[2]), math.sin(pose[2])
        corners = plan.footprint @ np.array([[c, s], [-s, c]]) + np.asarray(pose[:2])
        points = [pixel(x, y) for x, y in corners]
        pen.line([*points, points[0]], fill=color, width=width)

    every = max(1, round(0.3 / plan.resolution_m))
    for pose in plan.path[::every]:
        outline(pose, "orange", 1)
    if len(plan.path) > 1:
        pen.line([pixel(x, y) for x, y, _ in plan.path], fill="red", width=2)
    for pose, color in zip(poses, ("green", "purple"), strict=True):
        outline(pose, color, 2)
        tip = (pose[0] + 0.5 * math.cos(pose[2]), pose[1] + 0.5 * math.sin(pose[2]))
        pen.line([pixel(pose[0], pose[1]), pixel(*tip)], fill=color, width=2)
    return image


def _pose(text: str) -> list[float]:
    return [float(word) for word in text.split(",")]


def run(options: argparse.Namespace) -> int:
    """Plans, reports in one line, and writes what was asked for; 1 when there is no path."""
    plan = find_plan(options)
    if plan.found:
        print(
            f"{options.planner}: {plan.length_m():.2f} m, {len(plan.path)} poses, "
            f"{1e3 * plan.time_s:.1f} ms. {plan.reason}".rstrip()
        )
    else:
        print(f"{options.planner}: no path. {plan.reason}")
    if options.out is not None:
        scale = max(1, min(8, 1200 // max(plan.costs.shape)))
        draw(plan, [_pose(options.start), _pose(options.goal)], scale).save(options.out)
    if options.json is not None:
        options.json.write_text(json.dumps(plan.path.tolist()) + "\n", encoding="utf-8")
    return 0 if plan.found else 1


def main(words: Sequence[str] | None = None) -> int:
    """Returns 0 when there is a path, 1 when it was not found, 2 for wrong input."""
    given = sys.argv[1:] if words is None else list(words)
    # A pose that begins with a minus is no option: argparse takes words with blanks as they are.
    given = [f" {word}" if _POSE.fullmatch(word) else word for word in given]
    try:
        return run(make_parser().parse_args(given))
    except (NavError, OSError) as error:
        print(f"plan: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())

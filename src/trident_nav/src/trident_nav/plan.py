# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""``./trident plan``: plans on a map with any of the planners, and draws the path.

With ``--planner all`` each of them plans, and the picture has all paths. With ``--controller`` the
picture has what that weighs at the start; with ``--layers`` a second one has the costmap layer by
layer.
"""

from __future__ import annotations

import argparse
import json
import math
import re
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from PIL import Image, ImageDraw

from trident_nav.core.errors import NavError
from trident_nav.core.programs import find_program

_POSE = re.compile(r"-[\d.][^a-z]*")
_LETHAL, _UNKNOWN, _INSCRIBED = 254, 255, 253
ALL = "all"
# Planners that plan around obstacles, each with the color of its path.
PLANNERS = {
    "navfn/NavfnROS": "#d62728",
    "global_planner/GlobalPlanner": "#ff7f0e",
    "nav2_theta_star_planner/ThetaStarPlanner": "#2ca02c",
    "nav2_smac_planner/SmacPlanner2D": "#9467bd",
    "nav2_smac_planner/SmacPlannerHybrid": "#1f77b4",
    "nav2_smac_planner/SmacPlannerLattice": "#e377c2",
}
# What makes a controller show all that it weighs.
_SHOWN = {
    "MPPI": "{visualize: true}",
    "mppi": "{visualize: true}",
    "DWA": "{publish_traj_pc: true}",
    "dwa": "{publish_traj_pc: true}",
}


@dataclass(frozen=True)
class Weighed:
    """What a controller weighed for a command.

    Attributes:
        reason: why it commands nothing; empty: it does.
        trajectories: points x, y [m], shape (n, 2) each.
        costs: of the trajectories; negative: not admissible.
        selected: index of the best one; -1: none.
    """

    reason: str
    trajectories: list[np.ndarray[Any, np.dtype[np.float64]]]
    costs: list[float]
    selected: int


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
    weighed: Weighed | None = None

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
        help="as in base_global_planner, or all; default %(default)s",
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
    parser.add_argument(
        "--controller", default="", metavar="NAME", help="as in base_local_planner: what it weighs"
    )
    parser.add_argument(
        "--speed", type=float, default=0.5, metavar="V", help="of the robot there; default 0.5"
    )
    parser.add_argument(
        "--obstacle",
        action="append",
        default=[],
        metavar="X,Y,R",
        help="a round one that the map does not have [m]; may be repeated",
    )
    parser.add_argument("--layers", type=Path, metavar="FILE.png", help="picture of the layers")
    parser.add_argument("--out", type=Path, metavar="FILE.png", help="picture of map and path")
    parser.add_argument("--json", type=Path, metavar="FILE.json", help="the path's poses")
    return parser


def layers_of(options: argparse.Namespace) -> list[dict[str, str]]:
    """The costmap's layers: the map, what stands in it besides, inflation."""
    layers = [{"name": "static", "type": "costmap_2d::StaticLayer"}]
    if options.obstacle:
        layers.append({"name": "obstacles", "type": "costmap_2d::ObstacleLayer"})
    return [*layers, {"name": "inflation", "type": "costmap_2d::InflationLayer"}]


def costmap_yaml(options: argparse.Namespace, layers: int | None = None) -> str:
    """The configuration of a costmap, or of the first layers of it."""
    config: dict[str, Any] = {
        "plugins": layers_of(options)[:layers],
        "track_unknown_space": True,
        "footprint_padding": 0.0,
        "obstacles": {
            "observation_sources": "given",
            "given": {
                "data_type": "PointCloud2",
                "clearing": False,
                "min_obstacle_height": -1.0,
                "obstacle_range": 1e4,
                "raytrace_range": 1e4,
            },
        },
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


def _controller_words(options: argparse.Namespace) -> list[str]:
    if not options.controller:
        return []
    shown = next((text for key, text in _SHOWN.items() if key in options.controller), "{}")
    words = ["--controller", options.controller, "--controller-params", shown]
    return [*words, "--speed", str(options.speed)]


def _weighed(answer: dict[str, Any]) -> Weighed | None:
    control = answer.get("control")
    if control is None:
        return None
    return Weighed(
        reason=control["reason"],
        trajectories=[np.array(one["points"], dtype=float) for one in control["trajectories"]],
        costs=[float(one["cost"]) for one in control["trajectories"]],
        selected=control["selected"],
    )


def find_plan(options: argparse.Namespace, planner: str = "", layers: int | None = None) -> Plan:
    """Has ``nav_plan`` plan, with another planner and fewer layers than the options' if given.

    Raises:
        NavError: wrong input; the text is the program's.
    """
    is_file = Path(options.params).is_file()
    params = Path(options.params).read_text(encoding="utf-8") if is_file else options.params
    with tempfile.TemporaryDirectory() as folder:
        grid = Path(folder) / "grid.pgm"
        words = [options.map, options.start.strip(), options.goal.strip()]
        words += ["--planner", planner or options.planner, "--params", params]
        words += ["--grid", str(grid), "--costmap", costmap_yaml(options, layers)]
        words += ["--obstacles", ";".join(options.obstacle)]
        words += ["--turning-radius", str(options.turning_radius), *_controller_words(options)]
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
        weighed=_weighed(answer),
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


class Canvas:
    """A costmap that is drawn on, in meters."""

    def __init__(self, plan: Plan, scale: int) -> None:
        """`scale`: pixels per cell."""
        image = Image.fromarray(colors_of(plan.costs))
        size = (image.width * scale, image.height * scale)
        self.image = image.resize(size, Image.Resampling.NEAREST)
        self._plan, self._scale = plan, scale
        self.pen = ImageDraw.Draw(self.image, "RGBA")

    def pixel(self, x: float, y: float) -> tuple[float, float]:
        """Of a point [m]."""
        column = (x - self._plan.origin_m[0]) / self._plan.resolution_m * self._scale
        row = (y - self._plan.origin_m[1]) / self._plan.resolution_m * self._scale
        return column, self.image.height - row

    def line(self, points: np.ndarray[Any, Any], color: str, width: int) -> None:
        """Through points, shape (n, 2 or more)."""
        if len(points) > 1:
            self.pen.line([self.pixel(p[0], p[1]) for p in points], fill=color, width=width)

    def outline(self, pose: Sequence[float], color: str, width: int) -> None:
        """The footprint at a pose."""
        c, s = math.cos(pose[2]), math.sin(pose[2])
        corners = self._plan.footprint @ np.array([[c, s], [-s, c]]) + np.asarray(pose[:2])
        self.line(np.vstack([corners, corners[:1]]), color, width)

    def ends(self, poses: Sequence[Sequence[float]]) -> None:
        """The start's and the goal's poses."""
        for pose, color in zip(poses, ("green", "purple"), strict=True):
            self.outline(pose, color, 2)
            tip = (pose[0] + 0.5 * math.cos(pose[2]), pose[1] + 0.5 * math.sin(pose[2]))
            self.line(np.array([pose[:2], tip]), color, 2)

    def with_legend(self, entries: dict[str, str]) -> Image.Image:
        """The picture above texts, each with its color."""
        line = 14
        picture = Image.new(
            "RGB", (self.image.width, self.image.height + line * len(entries) + 6), "white"
        )
        picture.paste(self.image, (0, 0))
        pen = ImageDraw.Draw(picture)
        for i, (text, color) in enumerate(entries.items()):
            top = self.image.height + 3 + line * i
            pen.rectangle((6, top + 2, 18, top + 10), fill=color)
            pen.text((24, top), text, fill="black")
        return picture


def draw_fan(canvas: Canvas, weighed: Weighed) -> None:
    """All trajectories from green, the cheapest, to red; gray: not admissible; the best in blue."""
    # By rank: a few samples in contact cost far more than all others.
    order = np.argsort(np.argsort(weighed.costs)) / max(1, len(weighed.costs) - 1)
    for cost, points, share in sorted(
        zip(weighed.costs, weighed.trajectories, order, strict=True), key=lambda one: -one[2]
    ):
        color = f"#{int(255 * share):02x}{int(200 * (1 - share)):02x}2850"
        canvas.line(points, "#80808040" if cost < 0.0 else color, 1)
    if weighed.selected >= 0:
        canvas.line(weighed.trajectories[weighed.selected], "blue", 3)


def around(plan: Plan, weighed: Weighed) -> Plan:
    """The plan on the part of the costmap in which all that was weighed lies, and 0.5 m more."""
    points = np.vstack([*weighed.trajectories, plan.path[:1, :2]])
    low = np.floor((points.min(axis=0) - 0.5 - plan.origin_m) / plan.resolution_m).astype(int)
    high = np.ceil((points.max(axis=0) + 0.5 - plan.origin_m) / plan.resolution_m).astype(int)
    rows, columns = plan.costs.shape
    low, high = np.maximum(low, 0), np.minimum(high, (columns, rows))
    origin = np.asarray(plan.origin_m) + low * plan.resolution_m
    return replace(
        plan,
        costs=plan.costs[rows - high[1] : rows - low[1], low[0] : high[0]],
        origin_m=(float(origin[0]), float(origin[1])),
    )


def draw(plan: Plan, poses: Sequence[Sequence[float]], scale: int) -> Image.Image:
    """The costmap, the path with the footprint along it, and the start's and the goal's poses.

    Args:
        plan: what is drawn.
        poses: the start and the goal: x, y [m], yaw [rad].
        scale: pixels per cell.
    """
    if plan.weighed is not None and plan.weighed.trajectories:
        plan = around(plan, plan.weighed)
        scale = max(1, 900 // max(plan.costs.shape))
    canvas = Canvas(plan, scale)
    every = max(1, round(0.3 / plan.resolution_m))
    for pose in plan.path[::every]:
        canvas.outline(pose, "orange", 1)
    canvas.line(plan.path, "red", 2)
    if plan.weighed is not None:
        draw_fan(canvas, plan.weighed)
    canvas.ends(poses)
    return canvas.image


def draw_all(plans: dict[str, Plan], poses: Sequence[Sequence[float]], scale: int) -> Image.Image:
    """The paths of several planners on one costmap, with a legend."""
    canvas = Canvas(next(iter(plans.values())), scale)
    entries = {}
    for name, plan in plans.items():
        canvas.line(plan.path, PLANNERS[name], 2)
        length = f"{plan.length_m():.2f} m" if plan.found else "no path"
        entries[f"{name}: {length}"] = PLANNERS[name]
    canvas.ends(poses)
    return canvas.with_legend(entries)


def draw_layers(options: argparse.Namespace, planner: str) -> Image.Image:
    """The costmap with one layer more in each panel, from left to right."""
    panels, layers = [], layers_of(options)
    for count in range(1, len(layers) + 1):
        plan = find_plan(options, planner, count)
        title = " + ".join(layer["name"] for layer in layers[:count])
        panels.append(Canvas(plan, _scale_of(plan)).with_legend({title: "black"}))
    gap = 10
    width = sum(one.width for one in panels) + gap * (len(panels) - 1)
    image = Image.new("RGB", (width, panels[0].height), "white")
    for i, one in enumerate(panels):
        image.paste(one, (i * (one.width + gap), 0))
    return image


def _scale_of(plan: Plan) -> int:
    return max(1, min(8, 1200 // max(plan.costs.shape)))


def _pose(text: str) -> list[float]:
    return [float(word) for word in text.split(",")]


def _line(name: str, plan: Plan) -> str:
    if not plan.found:
        return f"{name}: no path. {plan.reason}"
    length = f"{plan.length_m():.2f} m, {len(plan.path)} poses"
    return f"{name}: {length}, {1e3 * plan.time_s:.1f} ms. {plan.reason}".rstrip()


def run(options: argparse.Namespace) -> int:
    """Plans, reports in one line, and writes what was asked for; 1 when there is no path."""
    names = list(PLANNERS) if options.planner == ALL else [options.planner]
    plans = {name: find_plan(options, name) for name in names}
    for name, plan in plans.items():
        print(_line(name, plan))
    poses = [_pose(options.start), _pose(options.goal)]
    if options.out is not None:
        _draw_plans(plans, poses, options.out)
    if options.layers is not None:
        draw_layers(options, names[0]).save(options.layers)
    if options.json is not None:
        _write_paths(plans, options.json)
    return 0 if all(plan.found for plan in plans.values()) else 1


def _draw_plans(plans: dict[str, Plan], poses: list[list[float]], out: Path) -> None:
    """One plan alone, several together."""
    first = next(iter(plans.values()))
    if len(plans) > 1:
        draw_all(plans, poses, _scale_of(first)).save(out)
    else:
        draw(first, poses, _scale_of(first)).save(out)


def _write_paths(plans: dict[str, Plan], out: Path) -> None:
    paths = {name: plan.path.tolist() for name, plan in plans.items()}
    only = paths if len(paths) > 1 else next(iter(paths.values()))
    out.write_text(json.dumps(only) + "\n", encoding="utf-8")


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

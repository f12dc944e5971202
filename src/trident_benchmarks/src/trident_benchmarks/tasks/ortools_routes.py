# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What OR-tools' routing finds for instances, as a program: ``ortools_routes.py SECONDS < JSON``.

Needs nothing of this workspace, so that it runs under any Python that has OR-tools. Each line of
stdin is an instance: name, starts and places [m], speeds [m/s], work [s], objective (``sum`` or
``makespan``). Each line of stdout is an object: name, objective, version, CPU seconds, length_m and
finish_s of the routes found. Routes begin at the starts and end at any task. Guided local search
from parallel cheapest insertion, stopped by this process' CPU time.
"""

from __future__ import annotations

import itertools
import json
import math
import sys
import time
from typing import Any

_UNITS = 1000  # to a meter and to a second: OR-tools computes with integers


def distances(instance: dict[str, Any]) -> list[list[float]]:
    """Between places, then starts, then the end, which is nowhere in particular [m]."""
    points = [*instance["places"], *instance["starts"]]
    rows = [[math.dist(one, other) for other in points] + [0.0] for one in points]
    return [*rows, [0.0] * (len(points) + 1)]


def solve(instance: dict[str, Any], seconds: float) -> dict[str, Any]:
    """The best routes found in so much CPU time."""
    from ortools.constraint_solver import pywrapcp, routing_enums_pb2

    length_m, tasks, robots = distances(instance), len(instance["places"]), len(instance["starts"])
    starts = [tasks + robot for robot in range(robots)]
    manager = pywrapcp.RoutingIndexManager(len(length_m), robots, starts, [tasks + robots] * robots)
    model = pywrapcp.RoutingModel(manager)

    def leg(one: int, other: int) -> int:
        return round(_UNITS * length_m[manager.IndexToNode(one)][manager.IndexToNode(other)])

    model.SetArcCostEvaluatorOfAllVehicles(model.RegisterTransitCallback(leg))
    if instance["objective"] == "makespan":
        _add_span(model, manager, instance, length_m)
    search = pywrapcp.DefaultRoutingSearchParameters()
    search.first_solution_strategy = (
        routing_enums_pb2.FirstSolutionStrategy.PARALLEL_CHEAPEST_INSERTION
    )
    search.local_search_metaheuristic = (
        routing_enums_pb2.LocalSearchMetaheuristic.GUIDED_LOCAL_SEARCH
    )
    search.time_limit.seconds = 86_400  # of wall time: only the CPU time below ends it
    end_s = time.process_time() + seconds
    model.AddSearchMonitor(model.solver().CustomLimit(lambda: time.process_time() > end_s))
    solution = model.SolveWithParameters(search)
    return _measured(instance, _routes(model, manager, solution, robots), length_m)


def _add_span(model: Any, manager: Any, instance: dict[str, Any], length_m: list[Any]) -> None:
    """The last robot's finish weighs a hundred times as much as a path."""
    tasks, numbers = len(instance["places"]), []
    for speed in instance["speeds"]:

        def lasts(one: int, other: int, speed: float = speed) -> int:
            here, there = manager.IndexToNode(one), manager.IndexToNode(other)
            work = instance["work"] if there < tasks else 0.0
            return round(_UNITS * (length_m[here][there] / speed + work))

        numbers.append(model.RegisterTransitCallback(lasts))
    model.AddDimensionWithVehicleTransits(numbers, 0, 10**9, True, "time")
    model.GetDimensionOrDie("time").SetGlobalSpanCostCoefficient(100)


def _routes(model: Any, manager: Any, solution: Any, robots: int) -> list[list[int]]:
    routes = []
    for robot in range(robots):
        index, route = model.Start(robot), []
        while not model.IsEnd(index):
            route.append(manager.IndexToNode(index))
            index = solution.Value(model.NextVar(index))
        routes.append(route)
    return routes


def _measured(
    instance: dict[str, Any], routes: list[list[int]], length_m: list[list[float]]
) -> dict[str, Any]:
    """The routes in numbers that are not rounded."""
    lengths = [sum(length_m[a][b] for a, b in itertools.pairwise(r)) for r in routes]
    finish = [
        length / speed + instance["work"] * (len(route) - 1)
        for length, speed, route in zip(lengths, instance["speeds"], routes, strict=True)
    ]
    assert sum(len(route) - 1 for route in routes) == len(instance["places"])
    return {"length_m": round(sum(lengths), 6), "finish_s": round(max(finish), 6)}


def main() -> None:
    """Solve what comes."""
    import ortools

    for line in sys.stdin:
        instance, begin_s = json.loads(line), time.process_time()
        found = solve(instance, float(sys.argv[1]))
        said = {name: instance[name] for name in ("name", "objective")}
        said |= {"version": ortools.__version__, "cpu_s": round(time.process_time() - begin_s, 2)}
        print(json.dumps(said | found), flush=True)


if __name__ == "__main__":
    main()

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What GTSAM needs for the same file, as a program: ``gtsam_timing.py FILE.g2o METHOD``.

Needs nothing of this workspace, so that it runs under any Python that has GTSAM. METHOD is
``gn``, ``lm`` (from the file's vertices), ``chordal`` (Gauss-Newton from averaged rotations) or
``isam2``, to which the vertices are added one after the other, each with the edges to those before.
Prints a JSON object: CPU seconds of initialisation and optimiser (one process, all its threads),
chi2 as the sum of squared Mahalanobis distances, iterations.
"""

from __future__ import annotations

import gzip
import json
import resource
import sys
import tempfile
from pathlib import Path
from typing import Any


def cpu_seconds() -> float:
    """CPU time of this process."""
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def unpacked(file: Path, folder: Path) -> Path:
    """GTSAM reads plain text only."""
    if file.suffix != ".gz":
        return file
    plain = folder / file.stem
    plain.write_bytes(gzip.decompress(file.read_bytes()))
    return plain


def optimize(file: Path, method: str) -> dict[str, Any]:
    """Reads, initialises and optimises one file."""
    import gtsam  # what this program is for, and not of this workspace

    is_3d = b"SE3" in file.read_bytes()[:4096]
    graph, initial = gtsam.readG2o(str(file), is_3d)
    first = min(initial.keys())
    if is_3d:
        prior = gtsam.PriorFactorPose3(
            first, initial.atPose3(first), gtsam.noiseModel.Isotropic.Sigma(6, 1e-6)
        )
    else:
        prior = gtsam.PriorFactorPose2(
            first, initial.atPose2(first), gtsam.noiseModel.Isotropic.Sigma(3, 1e-6)
        )
    graph.add(prior)
    begin = cpu_seconds()
    if method == "chordal":
        starter = gtsam.InitializePose3 if is_3d else gtsam.lago
        initial = starter.initialize(graph)
    initialized = cpu_seconds()
    if method == "lm":
        optimizer = gtsam.LevenbergMarquardtOptimizer(graph, initial)
    else:
        optimizer = gtsam.GaussNewtonOptimizer(graph, initial)
    result = optimizer.optimize()
    end = cpu_seconds()
    return {
        "cpu_s": end - begin,
        "start_cpu_s": initialized - begin,
        "chi2_after": 2.0 * graph.error(result),
        "iterations": optimizer.iterations(),
    }


def grow(file: Path) -> dict[str, Any]:
    """Adds the vertices of one file to iSAM2, with its default parameters, one after the other.

    Only its own updates and the last estimate are timed: not what Python does in between.
    """
    import gtsam  # what this program is for, and not of this workspace

    is_3d = b"SE3" in file.read_bytes()[:4096]
    graph, initial = gtsam.readG2o(str(file), is_3d)
    kind = "Pose3" if is_3d else "Pose2"
    keys = sorted(initial.keys())
    edges: dict[int, list[tuple[int, int, Any]]] = {key: [] for key in keys}
    for k in range(graph.size()):
        a, b = graph.at(k).keys()
        edges[max(a, b)].append((a, b, graph.at(k)))
    start = getattr(initial, f"at{kind}")(keys[0])
    sigma = gtsam.noiseModel.Isotropic.Sigma(6 if is_3d else 3, 1e-6)
    prior = getattr(gtsam, f"PriorFactor{kind}")(keys[0], start, sigma)
    isam, spent, last = gtsam.ISAM2(gtsam.ISAM2Params()), 0.0, keys[0]
    for key in keys:
        factors, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
        guess = start
        if key == keys[0]:
            factors.add(prior)
        for number, (a, b, factor) in enumerate(edges[key]):
            factors.add(factor)
            other = min(a, b)
            if number == 0 or other == last:
                measured = factor.measured() if a == other else factor.measured().inverse()
                at = getattr(isam, f"calculateEstimate{kind}")(other)
                guess = at.compose(measured)
        values.insert(key, guess)
        begin = cpu_seconds()
        isam.update(factors, values)
        spent += cpu_seconds() - begin
        last = key
    begin = cpu_seconds()
    result = isam.calculateEstimate()
    spent += cpu_seconds() - begin
    graph.add(prior)
    return {"cpu_s": spent, "chi2_after": 2.0 * graph.error(result), "iterations": len(keys)}


def main() -> None:
    """Command line: a g2o file and a method."""
    with tempfile.TemporaryDirectory() as folder:
        file, method = unpacked(Path(sys.argv[1]), Path(folder)), sys.argv[2]
        print(json.dumps(grow(file) if method == "isam2" else optimize(file, method)))


if __name__ == "__main__":
    main()

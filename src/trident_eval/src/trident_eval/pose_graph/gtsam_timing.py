# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What GTSAM needs for the same file, as a program: ``gtsam_timing.py FILE.g2o METHOD``.

Needs nothing of this workspace, so that it runs under any Python that has GTSAM. METHOD is
``gn``, ``lm`` (from the file's vertices) or ``chordal`` (Gauss-Newton from averaged rotations).
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


def main() -> None:
    """Command line: a g2o file and a method."""
    with tempfile.TemporaryDirectory() as folder:
        print(json.dumps(optimize(unpacked(Path(sys.argv[1]), Path(folder)), sys.argv[2])))


if __name__ == "__main__":
    main()

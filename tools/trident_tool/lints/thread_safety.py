# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""clang's thread-safety analysis over the sources that use marked mutexes.

Which member is under which mutex is written in the headers (trident_base/mutex.h); clang proves
that each function keeps to it. Results are kept as those of clang-tidy are.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

from trident_tool.lints.tidy import (
    CompileCommand,
    IncludeScanner,
    Result,
    cache_folder,
    cache_key,
    compile_commands,
    load_result,
    store_result,
)
from trident_tool.workspace import Runner, Workspace, base_environment

_MUTEX = "src/trident_base/include/trident_base/mutex.h"
_COMPILER = "clang++-14"
_FLAGS = ("-fsyntax-only", "-w", "-Wthread-safety", "-Werror=thread-safety")


def marked_units(
    units: Iterable[CompileCommand], scanner: IncludeScanner
) -> dict[Path, tuple[CompileCommand, list[Path]]]:
    """The sources of this repository that reach the marked mutexes, with the files they reach."""
    mutex = scanner.root / _MUTEX
    found: dict[Path, tuple[CompileCommand, list[Path]]] = {}
    for unit in units:
        if unit.source in found or not unit.source.is_file():
            continue
        if not unit.source.is_relative_to(scanner.root / "src"):
            continue
        reached = scanner.reached(unit)
        if mutex in reached:
            found[unit.source] = unit, reached
    return dict(sorted(found.items()))


def analyze(unit: CompileCommand, root: Path) -> Result:
    """Exit code and warnings of one source."""
    flags = [flag for flag in unit.flags if not flag.startswith(("-fno-semantic", "-W", "-M"))]
    process = subprocess.run(
        [_COMPILER, *_without_files(flags), *_FLAGS, str(unit.source)],
        capture_output=True,
        text=True,
        check=False,
        env=base_environment(),
        cwd=root,
    )
    return Result(process.returncode, process.stderr.replace(f"{root}/", ""))


def _without_files(flags: list[str]) -> list[str]:
    """What -MT and -MF named goes with them."""
    return [flag for flag in flags if not flag.endswith((".o", ".o.d", ".cpp", ".cxx"))]


def run_thread_safety(workspace: Workspace, runner: Runner) -> int:
    """Checks every source whose result is not known yet; returns 1 if any has findings.

    Raises:
        TridentError: the workspace is not configured.
    """
    if runner.dry_run:
        return runner.run([_COMPILER, *_FLAGS, "src/**.cpp"])
    units = marked_units(
        compile_commands(workspace),
        IncludeScanner(workspace.root),
    )
    bad = 0
    for source, (unit, reached) in units.items():
        settings = " ".join((_COMPILER, *_FLAGS))
        path = cache_folder(base_environment()) / cache_key(unit, reached, workspace.root, settings)
        result = load_result(path)
        if result is None:
            result = analyze(unit, workspace.root)
            store_result(path, result)
        if result.code != 0:
            bad += 1
            sys.stdout.write(f"{source.relative_to(workspace.root)}:\n{result.findings}")
    print(f"thread-safety: {bad} of {len(units)} files have findings")
    return int(bad > 0)

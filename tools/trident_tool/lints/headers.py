# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Whether each public header compiles alone: it includes what it uses.

A header that a source includes before all others is compiled alone by the thread-safety analysis of
that source, and not here again. Results are kept as those of clang-tidy are.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from os import sched_getaffinity
from pathlib import Path

from trident_tool.lints.thread_safety import marked_units
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

_COMPILER = "clang++-14"
_MODE = ("-fsyntax-only", "-w", "-x", "c++")


def public_headers(root: Path) -> list[Path]:
    """Headers below the include/ folders of the packages."""
    return sorted(path for path in root.glob("src/**/include/**/*.h") if path.is_file())


def header_units(
    headers: Iterable[Path], units: Iterable[CompileCommand], scanner: IncludeScanner
) -> dict[Path, CompileCommand]:
    """For each header the flags of a source that reaches it; others are left out."""
    missing = set(headers)
    found: dict[Path, CompileCommand] = {}
    for unit in units:
        if not missing:
            break
        if unit.source.is_file():
            for header in missing.intersection(scanner.reached(unit)):
                found[header] = CompileCommand(header, unit.flags)
            missing -= found.keys()
    return dict(sorted(found.items()))


def analyzed_first(units: Iterable[CompileCommand], scanner: IncludeScanner) -> set[Path]:
    """Headers that come first in a source that the thread-safety analysis compiles."""
    marked = (unit for unit, _ in marked_units(units, scanner).values())
    return {header for unit in marked if (header := scanner.first(unit)) is not None}


def compile_header(unit: CompileCommand, root: Path) -> Result:
    """Exit code and errors of one header."""
    flags = [
        flag
        for flag in unit.flags
        if not flag.startswith(("-fno-semantic", "-W", "-M"))
        and not flag.endswith((".o", ".o.d", ".cpp", ".cxx"))
    ]
    process = subprocess.run(
        [_COMPILER, *flags, *_MODE, str(unit.source)],
        capture_output=True,
        text=True,
        check=False,
        env=base_environment(),
        cwd=root,
    )
    return Result(process.returncode, process.stderr.replace(f"{root}/", ""))


def _known_or_compiled(unit: CompileCommand, scanner: IncludeScanner) -> Result:
    settings = " ".join((_COMPILER, *_MODE))
    key = cache_key(unit, scanner.reached(unit), scanner.root, settings)
    path = cache_folder(base_environment()) / key
    result = load_result(path)
    if result is None:
        result = compile_header(unit, scanner.root)
        store_result(path, result)
    return result


def run_headers(workspace: Workspace, runner: Runner) -> int:
    """Compiles every public header whose result is not known yet; returns 1 if any fails.

    Raises:
        TridentError: the workspace is not configured.
    """
    if runner.dry_run:
        return runner.run([_COMPILER, *_MODE, "src/**/include/**.h"])
    scanner = IncludeScanner(workspace.root)
    commands = compile_commands(workspace)
    elsewhere = analyzed_first(commands, scanner)
    headers = [header for header in public_headers(workspace.root) if header not in elsewhere]
    units = header_units(headers, commands, scanner)
    with ThreadPoolExecutor(max_workers=len(sched_getaffinity(0))) as pool:
        results = list(pool.map(lambda unit: _known_or_compiled(unit, scanner), units.values()))
    bad = [(path, result) for path, result in zip(units, results, strict=True) if result.code != 0]
    for path, result in bad:
        sys.stdout.write(f"{path.relative_to(workspace.root)}:\n{result.findings}")
    print(f"headers: {len(bad)} of {len(units)} that no source includes first do not compile alone")
    return int(bool(bad))

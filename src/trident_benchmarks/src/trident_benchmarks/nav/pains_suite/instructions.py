# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""P12: instructions that not every x86-64 processor has, outside of what is chosen at run time."""

from __future__ import annotations

import platform
import re
import shutil
import subprocess
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program

from trident_benchmarks.nav.pains_suite.rows import pain

_FUNCTION = re.compile(r"^[0-9a-f]+ <(.+)>:$")
# VEX and EVEX mnemonics begin with v; those of SSE and before do not, but for these.
_INSTRUCTION = re.compile(r"^\s*[0-9a-f]+:\s+(?:\w+ )*?(v\w+|\w+ .*%[yz]mm\d+)")
_NOT_VECTOR = ("verr", "verw", "vmcall", "vmxon")
#: Names of functions that are called only where the processor has what they use.
CHOSEN = re.compile(r"avx2|avx512|\bfma\b")


def is_wide(line: str) -> bool:
    """Whether a line of a disassembly is an instruction of AVX or later."""
    match = _INSTRUCTION.match(line)
    return match is not None and not match[1].startswith(_NOT_VECTOR)


def wide_functions(listing: Iterable[str]) -> dict[str, str]:
    """Functions of a disassembly that use AVX though nothing chose them, with an instruction.

    Args:
        listing: lines of `objdump --disassemble --no-show-raw-insn`.
    """
    found: dict[str, str] = {}
    function = ""
    for line in listing:
        if match := _FUNCTION.match(line):
            function = match[1]
        elif is_wide(line) and not CHOSEN.search(function):
            found.setdefault(function, line.strip())
    return found


def built_files() -> list[Path]:
    """Libraries and programs of this workspace.

    Raises:
        EvalError: it is not built.
    """
    folder = Path(program("trident_nav", "nav_pain_scenes")).parents[1]
    libraries = sorted(folder.glob("libtrident_*.so"))
    programs = sorted(
        file
        for package in ("trident_nav", "move_base", "trident_benchmarks", "gazebo_ros")
        for file in (folder / package).glob("*")
        if file.is_file() and file.read_bytes()[:4] == b"\x7fELF"
    )
    if not libraries:
        raise EvalError(f"{folder}: no libtrident_*.so in it; run ./trident build")
    return libraries + programs


def _files(quick: bool) -> list[Path]:
    """Those that are looked at: all, or in haste those of trident_nav."""
    files = built_files()
    return [file for file in files if "trident_nav" in file.name] if quick else files


def _chosen_functions(listing: Iterable[str]) -> int:
    """How many functions of a disassembly are chosen at run time."""
    matches = (_FUNCTION.match(line) for line in listing)
    return sum(1 for match in matches if match and CHOSEN.search(match[1]))


def _listing(file: Path) -> list[str]:
    done = subprocess.run(
        ["objdump", "--disassemble", "--no-show-raw-insn", "-M", "att", str(file)],
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode != 0:
        raise EvalError(f"objdump {file}: {done.stderr.strip()[-200:]}")
    return done.stdout.splitlines()


def instructions(quick: bool) -> list[dict[str, Any]]:
    """P12: by objdump; no rows without objdump, or on another processor.

    Raises:
        EvalError: nothing is built, or objdump fails.
    """
    if platform.machine() != "x86_64" or shutil.which("objdump") is None:
        return []
    files = _files(quick)
    chosen, wide = 0, []
    for file in files:
        listing = _listing(file)
        chosen += _chosen_functions(listing)
        wide += [f"{file.name}: {name}: {line}" for name, line in wide_functions(listing).items()]
    rival = "navigation2#5447, #4061, #5061"
    return [
        pain(
            "P12",
            rival,
            f"AVX outside of the functions chosen at run time, in {len(files)} libraries and"
            " programs",
            float(len(wide)),
            0.0,
            "functions",
            note="; ".join(wide[:5]),
        ),
        pain(
            "P12",
            rival,
            "the same: functions chosen at run time, which are found",
            float(chosen),
            1.0,
            "functions",
            is_least=True,
        ),
    ]

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""clang-tidy over the ROS-free cores, with results cached by content.

A result is kept under a key made of everything that it depends on: the source, the headers of this
repository that it reaches, the compiler flags, the configuration and clang-tidy's version. The
cache lives outside the clone, so that a fresh clone of a checked commit has nothing to do. Several
of these processes share the work: each checks what no other is at.
"""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from trident_tool.lints.tidy_batches import batch_source, batches
from trident_tool.workspace import Runner, TridentError, Workspace, base_environment

_INCLUDE = re.compile(rb'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"]', re.MULTILINE)
_UNITY = re.compile(r"/Unity/unity_[^/]+_cxx\.cxx$")
_CORE = re.compile(r"src/[^/]+(?<!_ros)(?<!_py)/src/.+\.(cpp|cc)")
_TOKEN_ROOT = "<root>"
_UNITS_IN_A_BATCH = 10  # two groups of the unity build


@dataclass(frozen=True)
class CompileCommand:
    """One translation unit: its source and the flags it is compiled with."""

    source: Path
    flags: tuple[str, ...]

    @property
    def include_dirs(self) -> list[Path]:
        """Folders of -I and -isystem, in order."""
        dirs: list[Path] = []
        following = False
        for flag in self.flags:
            if following:
                dirs.append(Path(flag))
                following = False
            elif flag in ("-I", "-isystem"):
                following = True
            elif flag.startswith("-I"):
                dirs.append(Path(flag[2:]))
        return dirs


def _flags(words: Sequence[str]) -> list[str]:
    """A compiler's flags without itself, and without -o and -c and what follows these."""
    start = next((i for i, word in enumerate(words) if word.startswith("-")), len(words))
    flags: list[str] = []
    skip = False
    for word in words[start:]:
        if skip or word in ("-o", "-c"):
            skip = not skip
        else:
            flags.append(word)
    return flags


def compile_commands(workspace: Workspace) -> list[CompileCommand]:
    """Translation units of the configured workspace.

    Raises:
        TridentError: it is not configured.
    """
    database = workspace.build / "compile_commands.json"
    if not database.is_file():
        raise TridentError(f"{database} does not exist: run ./trident build")
    return parse_compile_commands(database.read_text(encoding="utf-8"))


def parse_compile_commands(text: str) -> list[CompileCommand]:
    """Translation units of a compile_commands.json.

    Sources of a unity build are units of their own. Compiler, -o and -c are left out, and so are
    precompiled headers: they are gcc's, which clang cannot read, and a source must include by
    itself what it uses.
    """
    units = []
    for entry in json.loads(text):
        source = Path(entry["directory"], entry["file"]).resolve()
        words = entry["arguments"] if "arguments" in entry else shlex.split(entry["command"])
        kept = _without_precompiled_headers(_flags(words))
        units += [CompileCommand(each, kept) for each in _joined_sources(source)]
    return units


def _joined_sources(source: Path) -> list[Path]:
    """What cmake's unity build compiles in ``source``; any other file stands for itself."""
    if not _UNITY.search(source.as_posix()):
        return [source]
    names = _INCLUDE.findall(source.read_bytes())
    return [Path(name.decode("utf-8", "replace")) for name in names]


def _without_precompiled_headers(flags: list[str]) -> tuple[str, ...]:
    kept: list[str] = []
    for flag in flags:
        if flag.endswith("/cmake_pch.hxx") and kept and kept[-1] == "-include":
            kept.pop()
        elif flag != "-Winvalid-pch":
            kept.append(flag)
    return tuple(kept)


def core_units(units: Iterable[CompileCommand], root: Path) -> list[CompileCommand]:
    """Those of ``units`` in the core (``src/<pkg>/src``) of a package without ROS, once each."""
    found: dict[Path, CompileCommand] = {}
    for unit in units:
        if unit.source.is_relative_to(root) and _CORE.fullmatch(
            unit.source.relative_to(root).as_posix()
        ):
            found.setdefault(unit.source, unit)
    return list(found.values())


@dataclass
class IncludeScanner:
    """Finds the headers of this repository that a file reaches.

    The search is textual, conditions are not evaluated: including too much only makes a key
    change more often than it must.
    """

    root: Path
    _direct: dict[Path, list[str]] = field(default_factory=dict)

    def reached(self, unit: CompileCommand) -> list[Path]:
        """The source and all headers below ``root`` that it includes, directly or not, sorted."""
        pending = [unit.source]
        seen = {unit.source}
        while pending:
            current = pending.pop()
            for name in self._included_names(current):
                header = self._resolve(name, current.parent, unit.include_dirs)
                if header is not None and header not in seen:
                    seen.add(header)
                    pending.append(header)
        return sorted(seen)

    def first(self, unit: CompileCommand) -> Path | None:
        """The header below ``root`` that the source includes before all others, if it does."""
        names = self._included_names(unit.source)
        if not names:
            return None
        return self._resolve(names[0], unit.source.parent, unit.include_dirs)

    def _included_names(self, path: Path) -> list[str]:
        if path not in self._direct:
            names = _INCLUDE.findall(path.read_bytes())
            self._direct[path] = [name.decode("utf-8", "replace") for name in names]
        return self._direct[path]

    def _resolve(self, name: str, sibling_dir: Path, include_dirs: Iterable[Path]) -> Path | None:
        for folder in (sibling_dir, *include_dirs):
            candidate = Path(os.path.normpath(folder / name))
            if candidate.is_relative_to(self.root) and candidate.is_file():
                return candidate
        return None


def cache_key(unit: CompileCommand, files: Iterable[Path], root: Path, settings: str) -> str:
    """Digest of all that a result depends on; equal for equal content in clones at other places."""
    digest = hashlib.sha256(settings.encode())
    for flag in unit.flags:
        digest.update(flag.replace(str(root), _TOKEN_ROOT).encode() + b"\0")
    for path in files:
        digest.update(path.relative_to(root).as_posix().encode() + b"\0")
        digest.update(hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()


def cache_folder(env: Mapping[str, str]) -> Path:
    """Where results are kept: $XDG_CACHE_HOME or ~/.cache."""
    base = env.get("XDG_CACHE_HOME") or os.path.join(env.get("HOME", "/tmp"), ".cache")
    return Path(base, "trident", "clang-tidy")


@dataclass(frozen=True)
class Result:
    """Exit code and findings of one translation unit, paths relative to the clone."""

    code: int
    findings: str

    @property
    def is_complete(self) -> bool:
        """Whether clang-tidy came to its end; a signal that ends it says nothing of the source."""
        return self.code >= 0


def load_result(path: Path) -> Result | None:
    """A kept result, or None if it cannot be read or is not complete."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        result = Result(int(data["code"]), str(data["findings"]))
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return result if result.is_complete else None


def store_result(path: Path, result: Result) -> None:
    """Keeps ``result``; a reader never sees half of it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_suffix(f".{os.getpid()}")
    temporary.write_text(json.dumps(result.__dict__), encoding="utf-8")
    temporary.replace(path)


@contextmanager
def _locked(path: Path) -> Iterator[None]:
    """Keeps other processes from what ``path`` stands for; a killed one leaves no lock behind."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.with_suffix(".lock").open("w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def _check_once(
    lock: Path,
    units: Sequence[tuple[CompileCommand, Path]],
    workspace: Workspace,
    env: Mapping[str, str],
) -> dict[Path, Result]:
    """Results of one batch, which ``lock`` stands for; each unit with where its result is kept.

    What another process has found meanwhile is taken from there, the others are found now: all in
    one go, and where that reports anything, by halves.
    """
    with _locked(lock):
        found = {unit.source: load_result(path) for unit, path in units}
        missing = [(unit, path) for unit, path in units if found[unit.source] is None]
        results = _check_together([unit for unit, _ in missing], workspace, env)
        for (unit, path), result in zip(missing, results, strict=True):
            found[unit.source] = result
            if result.is_complete:
                store_result(path, result)
    return {source: result for source, result in found.items() if result is not None}


def _check_together(
    units: Sequence[CompileCommand], workspace: Workspace, env: Mapping[str, str]
) -> list[Result]:
    """Results of several sources that are read as one, by halves where that has findings."""
    if not units:
        return []
    if len(units) == 1:
        return [_check(units[0].source, units[0].flags, workspace, env)]
    with tempfile.TemporaryDirectory(prefix="trident_tidy_") as folder:
        source = Path(folder, "batch.cpp")
        source.write_text(batch_source(units), encoding="utf-8")
        (Path(folder) / ".clang-tidy").write_bytes((workspace.root / ".clang-tidy").read_bytes())
        if _check(source, units[0].flags, workspace, env).code == 0:
            return [Result(0, "")] * len(units)
    half = len(units) // 2
    halves = units[:half], units[half:]
    return [result for part in halves for result in _check_together(part, workspace, env)]


def _check(
    source: Path, flags: Sequence[str], workspace: Workspace, env: Mapping[str, str]
) -> Result:
    process = subprocess.run(
        ["clang-tidy", "--quiet", str(source), "--", *flags],
        env=env,
        capture_output=True,
        text=True,
        check=False,
        cwd=workspace.build,
    )
    findings = process.stdout.replace(f"{workspace.root}/", "")
    if process.returncode != 0 and not findings.strip():
        findings = process.stderr.replace(f"{workspace.root}/", "")
    if process.returncode < 0:
        findings += f"{source.name}: clang-tidy was ended by signal {-process.returncode}\n"
    return Result(process.returncode, findings)


def _settings(workspace: Workspace) -> str:
    version = subprocess.run(
        ["clang-tidy", "--version"], capture_output=True, text=True, check=False
    )
    config = (workspace.root / ".clang-tidy").read_text(encoding="utf-8")
    return version.stdout + config


def _batch_name(batch: Iterable[CompileCommand], root: Path) -> str:
    names = "\0".join(unit.source.relative_to(root).as_posix() for unit in batch)
    return f"batch-{hashlib.sha256(names.encode()).hexdigest()}"


def _open_batches(
    units: Sequence[CompileCommand],
    open_units: Mapping[Path, tuple[CompileCommand, Path]],
    root: Path,
) -> Iterator[tuple[str, list[tuple[CompileCommand, Path]]]]:
    """Name of each batch with something to be checked, and what that is."""
    for batch in batches(units, _UNITS_IN_A_BATCH):
        missing = [open_units[unit.source] for unit in batch if unit.source in open_units]
        if missing:
            yield _batch_name(batch, root), missing


def _check_all(
    units: Sequence[CompileCommand],
    open_units: Mapping[Path, tuple[CompileCommand, Path]],
    folder: Path,
    workspace: Workspace,
) -> dict[Path, Result]:
    """Checks ``open_units``. Batches are made of all units, so that every process has the same."""
    env = base_environment()
    found: dict[Path, Result] = {}
    with ThreadPoolExecutor(max_workers=len(os.sched_getaffinity(0))) as pool:
        futures = [
            pool.submit(_check_once, folder / name, missing, workspace, env)
            for name, missing in _open_batches(units, open_units, workspace.root)
        ]
        for future in as_completed(futures):
            found |= future.result()
            names = ", ".join(sorted(source.name for source in future.result()))
            print(f"[{len(found)}/{len(open_units)}] {names}", flush=True)
    return found


def _read_units(workspace: Workspace) -> list[CompileCommand]:
    """The core files of the configured workspace that are still there."""
    units = core_units(compile_commands(workspace), workspace.root)
    return [unit for unit in units if unit.source.is_file()]


def _load_results(
    units: Sequence[CompileCommand], folder: Path, workspace: Workspace
) -> tuple[dict[Path, Result], dict[Path, tuple[CompileCommand, Path]]]:
    """Results that are known already, and the other units, with where theirs are to be kept."""
    settings = _settings(workspace)
    scanner = IncludeScanner(workspace.root)
    kept: dict[Path, Result] = {}
    open_units: dict[Path, tuple[CompileCommand, Path]] = {}
    for unit in units:
        key = cache_key(unit, scanner.reached(unit), workspace.root, settings)
        result = load_result(folder / key)
        if result is None:
            open_units[unit.source] = (unit, folder / key)
        else:
            kept[unit.source] = result
    return kept, open_units


def run_clang_tidy(workspace: Workspace, runner: Runner) -> int:
    """Checks every core file whose result is not known yet; returns 1 if any has findings.

    Raises:
        TridentError: the workspace is not configured.
    """
    if runner.dry_run:
        return runner.run(["clang-tidy", "--quiet", "-p", workspace.build, "src/*/src/**.cpp"])
    units = _read_units(workspace)
    folder = cache_folder(base_environment())
    kept, open_units = _load_results(units, folder, workspace)
    print(f"clang-tidy: {len(units)} core files, {len(kept)} known, {len(open_units)} to check")
    kept |= _check_all(units, open_units, folder, workspace)
    bad = [source for source in sorted(kept) if kept[source].code != 0]
    for source in bad:
        sys.stdout.write(kept[source].findings)
    print(f"clang-tidy: {len(bad)} of {len(units)} files have findings")
    return int(bool(bad))

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The static checks: which files each of them covers and how it is called."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from trident_tool.lints.headers import run_headers
from trident_tool.lints.markdown import check_pages
from trident_tool.lints.rooms import check_rooms
from trident_tool.lints.thread_safety import run_thread_safety
from trident_tool.lints.tidy import run_clang_tidy
from trident_tool.lints.words import check_words
from trident_tool.workspace import Runner, TridentError, Workspace, base_environment

_SKIPPED_FOLDERS = {"build", "out", "third_party", "__pycache__", "node_modules"}
_CPP_SUFFIXES = {".h", ".hpp", ".cpp", ".cc"}
_SPELLED_SUFFIXES = _CPP_SUFFIXES | {
    *(".py", ".pyi", ".md", ".yaml", ".txt", ".cmake", ".xml", ".launch", ".test"),
    *(".msg", ".srv", ".action", ".xacro", ".urdf", ".sdf", ".world"),
}


def source_files(root: Path) -> Iterator[Path]:
    """Every file of the clone that is not generated, in a fixed order; links are not followed."""
    for folder, subfolders, files in os.walk(root):
        subfolders[:] = sorted(name for name in subfolders if _is_walked(Path(folder, name)))
        yield from (Path(folder, name) for name in sorted(files))


def _is_walked(folder: Path) -> bool:
    if folder.name in _SKIPPED_FOLDERS or folder.name.startswith("."):
        return False
    return not folder.is_symlink()


def is_python(path: Path) -> bool:
    """Whether ``path`` is a Python source: by its suffix, or by its first line when it has none."""
    if path.suffix == ".py":
        return True
    if path.suffix or path.is_symlink():
        return False
    with path.open("rb") as file:
        first_line = file.readline(80)
    return first_line.startswith(b"#!") and b"python" in first_line


def cpp_files(root: Path) -> list[Path]:
    """C++ sources and headers."""
    return [path for path in source_files(root) if path.suffix in _CPP_SUFFIXES]


def python_files(root: Path) -> list[Path]:
    """Python modules and scripts."""
    return [path for path in source_files(root) if is_python(path)]


def python_roots(root: Path) -> list[Path]:
    """Folders that hold Python packages: tools/, and src/ or python/ of the catkin packages."""
    found = [root / "tools"]
    for pattern in ("src/*/src", "src/compat/*/src", "src/*/python"):
        found += [
            folder for folder in sorted(root.glob(pattern)) if any(folder.glob("*/__init__.py*"))
        ]
    return found


def _clang_format(workspace: Workspace, runner: Runner, fix: bool) -> int:
    files = cpp_files(workspace.root)
    if not files:
        return 0
    mode = ["-i"] if fix else ["--dry-run", "--Werror"]
    return runner.run(["clang-format", "--style=file", *mode, *map(str, files)])


def _ruff(workspace: Workspace, runner: Runner, fix: bool) -> int:
    ruff = str(workspace.venv / "bin" / "ruff")
    config = ["--config", str(workspace.root / "pyproject.toml"), "--no-cache"]
    files = python_files(workspace.root)
    check = runner.run([ruff, "check", *config, *(["--fix"] if fix else []), *files])
    layout = runner.run([ruff, "format", *config, *([] if fix else ["--check", "--diff"]), *files])
    return check or layout


def _mypy(workspace: Workspace, runner: Runner, fix: bool) -> int:
    del fix  # types have to be mended by hand
    roots = python_roots(workspace.root)
    packages = [package.parent for root in roots for package in sorted(root.glob("*/__init__.py"))]
    env = base_environment()
    env["MYPYPATH"] = os.pathsep.join(map(str, roots))
    command: list[str | Path] = [
        workspace.venv_python,
        "-m",
        "mypy",
        "--config-file",
        workspace.root / "pyproject.toml",
        "--cache-dir",
        workspace.build / "mypy_cache",
        *packages,
    ]
    return runner.run(command, env=env, cwd=workspace.root)


def _clang_tidy(workspace: Workspace, runner: Runner, fix: bool) -> int:
    del fix  # a fix may change what the code does
    return run_clang_tidy(workspace, runner)


def _thread_safety(workspace: Workspace, runner: Runner, fix: bool) -> int:
    del fix  # which lock is to be taken is a question of design
    return run_thread_safety(workspace, runner)


def _markdown(workspace: Workspace, runner: Runner, fix: bool) -> int:
    pages = [path for path in source_files(workspace.root) if path.suffix == ".md"]
    if runner.dry_run:
        print("check the links and lines of", *pages)
        return 0
    return check_pages(pages, workspace.root, fix)


def _headers(workspace: Workspace, runner: Runner, fix: bool) -> int:
    del fix  # which header a name is from is for its user to say
    return run_headers(workspace, runner)


def _rooms(workspace: Workspace, runner: Runner, fix: bool) -> int:
    del fix  # where a file belongs is a question of design
    files = cpp_files(workspace.root)
    if runner.dry_run:
        print("check the includes of", *files)
        return 0
    return check_rooms(workspace.root, files)


def _reference(workspace: Workspace, runner: Runner, fix: bool) -> int:
    # The parser's module names the checks of this one in its help.
    from trident_tool.cli import make_parser
    from trident_tool.lints.reference import check_reference

    if runner.dry_run:
        print("compare docs/reference with launch files, commands and plugins")
        return 0
    return check_reference(workspace.root, make_parser(), fix)


def _words(workspace: Workspace, runner: Runner, fix: bool) -> int:
    files = [path for path in source_files(workspace.root) if path.suffix in _SPELLED_SUFFIXES]
    config: list[str | Path] = ["--toml", workspace.root / "pyproject.toml"]
    spelling = runner.run([workspace.venv_python, "-m", "codespell_lib", *config, *files])
    if runner.dry_run:
        return spelling
    sources = [*cpp_files(workspace.root), *python_files(workspace.root)]
    return check_words(workspace.root, sources, fix) or spelling


CHECKS: dict[str, Callable[[Workspace, Runner, bool], int]] = {
    "clang-format": _clang_format,
    "ruff": _ruff,
    "mypy": _mypy,
    "clang-tidy": _clang_tidy,
    "thread-safety": _thread_safety,
    "markdown": _markdown,
    "rooms": _rooms,
    "words": _words,
    "headers": _headers,
    "reference": _reference,
}


def run_checks(
    workspace: Workspace, runner: Runner, names: Sequence[str] = (), fix: bool = False
) -> int:
    """Runs the named checks (default: all) to the end; returns 0 if every one is content.

    Raises:
        TridentError: a name is not a check.
    """
    for name in names:
        if name not in CHECKS:
            raise TridentError(f"there is no check {name!r}; the checks are {', '.join(CHECKS)}")
    codes = [CHECKS[name](workspace, runner, fix) for name in names or CHECKS]
    return int(any(codes))

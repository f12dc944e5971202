# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Which code a sweep runs: what it must not be mixed with the results of."""

from __future__ import annotations

import hashlib
import importlib.util
import platform
import subprocess
import sys
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from trident_eval.core.errors import EvalError
from trident_eval.sweep.launches import LAUNCH

_PACKAGES = ("numpy", "scipy", "pyarrow")


def code_version(subject: str) -> str:
    """The commit of Trident, with hashes of what is not committed and of the function's file.

    Raises:
        EvalError: there is no such module.
    """
    parts = [_trident_version()]
    if not subject.startswith(LAUNCH):
        module = subject.partition(":")[0]
        parts.append(f"{module} {_digest(_source(subject, module).read_bytes())}")
    return ", ".join(parts)


def machine_facts(subject: str) -> dict[str, str]:
    """What workers must have in common: code, versions and kind of processor."""
    facts = {
        "code": code_version(subject),
        "Python": platform.python_version(),
        "processor": platform.machine(),
        "C library": " ".join(platform.libc_ver()),
    }
    for name in _PACKAGES:
        try:
            facts[name] = version(name)
        except PackageNotFoundError:
            facts[name] = "none"
    return facts


def unlike(ours: Mapping[str, str], theirs: Mapping[str, str]) -> str:
    """How another machine differs, in words; "" if it does not."""
    return "; ".join(
        f"{name}: {theirs.get(name, 'none')} instead of {value}"
        for name, value in ours.items()
        if theirs.get(name) != value
    )


def _source(subject: str, module: str) -> Path:
    try:
        spec = importlib.util.find_spec(module)
    except (ImportError, ValueError) as error:
        raise EvalError(f"{subject}: {error}; legal: a module on {_path()}") from error
    if spec is None or spec.origin is None or not Path(spec.origin).is_file():
        raise EvalError(f"{subject}: no module {module} on {_path()}")
    return Path(spec.origin)


def _path() -> str:
    return ":".join(part or "." for part in sys.path[:6])


def _trident_version() -> str:
    here = Path(__file__).resolve().parent
    commit = _git(here, "rev-parse", "HEAD").decode().strip()
    if not commit:
        return f"trident_eval {_digest(Path(__file__).read_bytes())}"
    changes = _git(here, "diff", "HEAD", "--binary")
    return f"{commit}+{_digest(changes)}" if changes else commit


def _git(folder: Path, *words: str) -> bytes:
    command = ["git", "-C", str(folder), *words]
    try:
        return subprocess.run(command, capture_output=True, check=False).stdout
    except OSError:
        return b""


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:12]

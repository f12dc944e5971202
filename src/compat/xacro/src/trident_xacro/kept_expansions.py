# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Expansions kept between calls, for launch files that expand the same vehicles at every start.

An expansion is a function of the call (arguments, working directory, interpreter, encodings), of
the code that is imported, of the bytes of the files that it reads, and of what `$(find)`, `$(env)`
and `$(optenv)` stand for. All of these are kept with its output, and it is used again only after
each has been looked up again and found equal; files are compared byte by byte. What depends on more
is never kept: globs, other substitutions such as `$(eval)` and `$(anon)`, expressions that may lead
out of xacro's sandbox. Neither is one that says anything on stderr, nor one that fails.
"""

from __future__ import annotations

import builtins
import io
import marshal
import os
import sys
import zlib
from importlib.machinery import PathFinder

TYPE_CHECKING = False  # typing takes a third of the time of a call to import
if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType
    from typing import IO, Any

# The version whose accesses to the outside are those that Recorder watches.
_LIBRARY_VERSION = "1.13.3"
_IMPORTED = ("trident_xacro", "xacro", "roslaunch", "rosgraph", "rospkg", "yaml")
_MAX_KEPT = 200


def describe_call() -> dict[str, Any]:
    """What of this process an expansion depends on, other than code, files and environment."""
    files = [word for word in sys.argv[1:] if ":=" not in word and not word.startswith("-")]
    needs_folder = not all(os.path.isabs(file) for file in files)
    return {
        "words": sys.argv,
        "folder": os.getcwd() if needs_folder else None,
        "interpreter": (sys.version, tuple(sys.flags), sys.path),
        "encodings": (sys.stdout.encoding, sys.getdefaultencoding(), io.text_encoding(None)),
    }


def _signature(path: str) -> tuple[int, int, int]:
    status = os.stat(path)
    return status.st_mtime_ns, status.st_size, status.st_ino


def _origin(package: str) -> str | None:
    spec = PathFinder.find_spec(package)
    return None if spec is None else spec.origin


def _read(path: str) -> bytes:
    with builtins.open(path, "rb") as file:
        return file.read()


def _path_of(call: dict[str, Any]) -> str:
    cache = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    name = f"{zlib.crc32(repr(call).encode('utf-8', 'surrogateescape')):08x}"
    return os.path.join(cache, "trident", "xacro", name)


def _is_current(kept: dict[str, Any], find_package: Callable[[str], str]) -> bool:
    checks: tuple[tuple[Callable[[str], Any], str], ...] = (
        (os.environ.get, "environment"),
        (_signature, "code"),
        (_origin, "origins"),
        (_read, "files"),
        (find_package, "packages"),
    )
    return all(now(name) == was for now, key in checks for name, was in kept[key].items())


def look_up(call: dict[str, Any], find_package: Callable[[str], str]) -> str | None:
    """The output of the same call, if nothing that it depends on has changed."""
    try:
        kept = marshal.loads(_read(_path_of(call)))
        if kept["call"] == call and _is_current(kept, find_package):
            return str(kept["output"])
    except Exception:  # nothing kept, damaged, or a file or package is gone: expand
        return None
    return None


def _imported_code() -> list[str]:
    """Files of those modules that are loaded and belong to an expansion."""
    modules = [module for name, module in sys.modules.items() if name.split(".")[0] in _IMPORTED]
    files = [getattr(module, "__file__", None) for module in modules]
    return [file for file in files if file]


class Recorder:
    """Watches the library during an expansion, and keeps it if it may be kept."""

    def __init__(self, library: ModuleType, call: dict[str, Any]) -> None:
        """Puts itself between the library and all that it asks the outside."""
        self._call = call
        self._files: dict[str, bytes] = {}
        self._packages: dict[str, str] = {}
        self._environment: dict[str, str | None] = {}
        self._eval_extension = library.eval_extension
        self._glob = library.glob
        folder = os.path.dirname(os.path.dirname(str(library.__file__)))
        self._may_be_kept = os.path.isdir(
            os.path.join(folder, f"xacro-{_LIBRARY_VERSION}.dist-info")
        )
        watched: dict[str, Any] = {
            "open": self._open_watched,
            "glob": self,
            "eval": self._evaluate,
            "eval_extension": self._substitute,
        }
        vars(library).update(watched)

    def glob(self, pattern: str) -> list[str]:
        """Stands for glob.glob."""
        self._may_be_kept = False
        return list(self._glob.glob(pattern))

    def run(self, expand: Callable[[], None]) -> str:
        """Runs an expansion.

        Returns:
            What it writes to stdout.
        """
        stdout, stderr = sys.stdout, sys.stderr
        output, errors = io.StringIO(), _Watched(stderr)
        sys.stdout, sys.stderr = output, errors
        try:
            expand()
        finally:
            sys.stdout, sys.stderr = stdout, stderr
            stdout.write(output.getvalue())
        self._may_be_kept = self._may_be_kept and not errors.was_written
        return output.getvalue()

    def keep(self, output: str) -> None:
        """Keeps the output of an expansion that has succeeded."""
        if not self._may_be_kept:
            return
        kept = {
            "call": self._call,
            "code": {path: _signature(path) for path in [*_imported_code(), __file__]},
            "origins": {name: _origin(name) for name in _IMPORTED},
            "files": self._files,
            "packages": self._packages,
            "environment": self._environment,
            "output": output,
        }
        try:
            _write(_path_of(self._call), marshal.dumps(kept))
        except OSError:
            return  # a full disk or a home that cannot be written: it is expanded every time

    def _open_watched(self, path: str, mode: str = "r") -> IO[str]:
        """Stands for open(); the library reads the very bytes that are kept."""
        if mode != "r":
            self._may_be_kept = False
            return builtins.open(path, mode)
        content = _read(path)
        is_same = self._files.setdefault(path, content) == content
        is_found_again = os.path.isabs(path) or self._call["folder"] is not None
        self._may_be_kept = self._may_be_kept and is_same and is_found_again
        return io.TextIOWrapper(_NamedBytes(path, content))

    def _evaluate(self, expression: str, names: dict[str, Any], values: Any) -> Any:
        """Stands for eval(). Special attributes lead everywhere, str.format() can spell them."""
        if "__" in expression or "format" in expression:
            self._may_be_kept = False
        return builtins.eval(expression, names, values)

    def _substitute(self, text: str) -> str:
        """Stands for the library's eval_extension; `text`: `$(command argument ...)`."""
        result = str(self._eval_extension(text))
        words = text[2:-1].split()
        if words[:1] == ["find"] and len(words) == 2:
            self._packages[words[1]] = result
        elif words[:1] in (["env"], ["optenv"]) and len(words) > 1:
            self._environment[words[1]] = os.environ.get(words[1])
        elif words[:1] == ["cwd"]:
            self._may_be_kept = self._may_be_kept and self._call["folder"] is not None
        elif words[:1] != ["arg"]:
            self._may_be_kept = False
        return result


class _NamedBytes(io.BytesIO):
    """Bytes of a file, whose name a parser may report."""

    def __init__(self, name: str, content: bytes) -> None:
        super().__init__(content)
        self.name = name


class _Watched:
    """A stream that knows whether anything was written to it."""

    def __init__(self, stream: Any) -> None:
        self._stream = stream
        self.was_written = False

    def write(self, text: str) -> int:
        self.was_written = True
        return int(self._stream.write(text))

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


def _write(path: str, data: bytes) -> None:
    folder = os.path.dirname(path)
    os.makedirs(folder, mode=0o700, exist_ok=True)
    temporary = f"{path}.{os.getpid()}"
    with builtins.open(temporary, "wb") as file:
        file.write(data)
    os.replace(temporary, path)
    _forget_oldest(folder)


def _forget_oldest(folder: str) -> None:
    with os.scandir(folder) as entries:
        by_age = sorted((entry.stat().st_mtime_ns, entry.path) for entry in entries)
    for _, path in by_age[:-_MAX_KEPT]:
        os.unlink(path)

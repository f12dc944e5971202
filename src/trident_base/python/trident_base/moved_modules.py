# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Old names of modules that have moved: they still import, and say once what to write instead."""

from __future__ import annotations

import importlib
import importlib.util
import sys
import warnings
from collections.abc import Mapping, Sequence
from importlib.abc import InspectLoader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import CodeType, ModuleType


def keep_old_names(new_names: Mapping[str, str]) -> None:
    """Lets modules be imported, and run by `python -m`, by the names that they had.

    An old name gives the very module of the new name, no second copy of it. The first import of
    each old name warns (`FutureWarning`, which Python shows to everybody).

    Args:
        new_names: the new name of each module or package by its old one; what lies below a package
            goes with it, unless it is named itself.
    """
    # Before Python's own finders: they would look for what lies below an old name by the path of
    # the new module, and load it a second time.
    sys.meta_path.insert(0, _OldNames(dict(new_names)))


class _OldNames(MetaPathFinder):
    """Finds modules by their old names."""

    def __init__(self, new_names: dict[str, str]) -> None:
        self._new_names = new_names
        self._warned: set[str] = set()

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """The module of the new name, as `importlib` wants it."""
        del path, target
        old = self._moved_part(fullname)
        if old is None:
            return None
        new_name = self._new_names[old] + fullname.removeprefix(old)
        found = importlib.util.find_spec(new_name)
        if found is None:
            return None
        if old not in self._warned:
            self._warned.add(old)
            text = f"{old} is {self._new_names[old]} now: import that instead"
            warnings.warn(text, FutureWarning, stacklevel=2)
        is_package = found.submodule_search_locations is not None
        return ModuleSpec(fullname, _NewModule(new_name), is_package=is_package)

    def _moved_part(self, fullname: str) -> str | None:
        """The longest old name that the module has or lies below."""
        name = fullname
        while name not in self._new_names:
            name, dot, _ = name.rpartition(".")
            if not dot:
                return None
        return name


class _NewModule(InspectLoader):
    """Loads a module by its new name."""

    def __init__(self, new_name: str) -> None:
        self._new_name = new_name

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """The module of the new name itself; it keeps what it knows of where it comes from."""
        module = importlib.import_module(self._new_name)
        self._spec = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        """It has run already; importlib has given it the old name's spec meanwhile."""
        module.__spec__ = self._spec

    def get_code(self, fullname: str) -> CodeType | None:
        """What `python -m` runs."""
        found = importlib.util.find_spec(self._new_name)
        loader = found.loader if found else None
        return loader.get_code(self._new_name) if isinstance(loader, InspectLoader) else None

    def get_source(self, fullname: str) -> str | None:
        """Not by the old name: tracebacks show the files of the new one."""
        return None

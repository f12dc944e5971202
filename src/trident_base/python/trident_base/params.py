# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters of Python code: a dataclass says which there are, and what they are by default.

`read` fills a dataclass, with the dataclasses in it, from anything that gives a value for a name.
A field is the parameter of its own name; `named` gives it another one, or another unit. Values are
checked by the type of the default here, and by the dataclass itself for their range (`require`).
"""

from __future__ import annotations

import dataclasses
import difflib
import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any, TypeVar

Getter = Callable[[str], Any]
Config = TypeVar("Config")

_NAME, _CONVERT = "trident_param", "trident_convert"


class ParamError(ValueError):
    """A bad parameter: the text names it, its value and what is legal."""


def named(default: Any, name: str, convert: Callable[[float], Any] | None = None) -> Any:
    """A field of a dataclass whose parameter has another name.

    Args:
        default: of the field.
        name: of the parameter.
        convert: makes the field's value from a number in the parameter's unit.
    """
    return dataclasses.field(default=default, metadata={_NAME: name, _CONVERT: convert})


def nearest(name: str, known: Iterable[str]) -> str:
    """`; did you mean 'x'?`, or nothing where no known name is near."""
    close = difflib.get_close_matches(name, sorted(set(known)), n=1)
    return f"; did you mean '{close[0]}'?" if close else ""


def unknown(given: Iterable[str], known: Iterable[str]) -> list[str]:
    """A text for each name that is given and not known, with the nearest one that is."""
    names = set(known)
    return [f"{name}: unknown{nearest(name, names)}" for name in sorted(set(given) - names)]


def is_within(value: float, lowest: float, highest: float) -> bool:
    """Whether a value is finite and lowest <= value <= highest."""
    return math.isfinite(value) and lowest <= value <= highest


def require(
    name: str,
    value: float,
    lowest: float,
    highest: float,
    unit: str = "",
    error: type[ValueError] = ParamError,
) -> None:
    """Raises `error` unless the value is finite and lowest <= value <= highest."""
    if not is_within(value, lowest, highest):
        after = f" {unit}" if unit else ""
        raise error(f"{name}: {value:g}{after}, legal: {lowest:g} to {highest:g}{after}")


def _is_legal(value: float, may_be_zero: bool) -> bool:
    return math.isfinite(value) and (value >= 0 if may_be_zero else value > 0)


def require_positive(
    config: Any, allow_zero: Iterable[str] = (), error: type[ValueError] = ParamError
) -> None:
    """Raises `error` for the first number of a dataclass that is not finite and above (or at) 0."""
    for item in dataclasses.fields(config):
        value = getattr(config, item.name)
        if not isinstance(value, int | float) or isinstance(value, bool):
            continue
        may_be_zero = item.name in allow_zero
        if not _is_legal(value, may_be_zero):
            bound = "0 or more" if may_be_zero else "greater than 0"
            raise error(f"{item.name}: {value}; legal: finite, {bound}")


class Recorded:
    """A getter that remembers what it was asked for.

    Attributes:
        asked: the names, whether they are set or not.
    """

    def __init__(self, get: Getter) -> None:
        """Ask another getter."""
        self._get = get
        self.asked: set[str] = set()

    def __call__(self, name: str) -> Any:
        """The value of a parameter, None if it is not set."""
        self.asked.add(name)
        return self._get(name)


class Params:
    """Typed access by name, with one clear error for a value of another type."""

    def __init__(
        self, get: Getter, error: type[ValueError] = ParamError, before: str = "", joint: str = "; "
    ) -> None:
        """Read from a getter.

        Args:
            get: value of a parameter, or None where it is not set.
            error: what is raised.
            before: stands before names in messages.
            joint: stands before "legal" in messages.
        """
        self._get, self._error = Recorded(get), error
        self._before, self._joint = before, joint

    @property
    def asked(self) -> set[str]:
        """The names that were asked for, whether they are set or not."""
        return self._get.asked

    def text(self, name: str, default: str) -> str:
        """A text."""
        value = self._value(name, default)
        if not isinstance(value, str):
            raise self._wrong(name, repr(value), "a text")
        return value

    def number(self, name: str, default: float) -> float:
        """A finite number."""
        value = self._value(name, default)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise self._wrong(name, repr(value), "a number")
        if not math.isfinite(value):
            raise self._wrong(name, str(value), "a finite number")
        return float(value)

    def integer(self, name: str, default: int) -> int:
        """A whole number."""
        value = self._value(name, default)
        if isinstance(value, bool) or not isinstance(value, int):
            raise self._wrong(name, repr(value), "a whole number")
        return value

    def flag(self, name: str, default: bool) -> bool:
        """True or false."""
        value = self._value(name, default)
        if not isinstance(value, bool):
            raise self._wrong(name, repr(value), "true or false")
        return value

    def vector(self, name: str, default: tuple[float, float, float]) -> tuple[float, float, float]:
        """Components `name_x`, `name_y`, `name_z`, each by default `name`, then its own default."""
        common = None if self.given(name) is None else self.number(name, 0.0)
        parts = zip("xyz", default, strict=True)
        values = [
            self.number(f"{name}_{axis}", own if common is None else common) for axis, own in parts
        ]
        return values[0], values[1], values[2]

    def given(self, name: str) -> Any:
        """The value as it is, None if it is not set."""
        return self._get(name)

    def like(self, name: str, default: Any) -> Any:
        """A value of the type that the default has."""
        if isinstance(default, bool):
            return self.flag(name, default)
        if isinstance(default, int):
            return self.integer(name, default)
        if isinstance(default, float):
            return self.number(name, default)
        if isinstance(default, tuple):
            return self.vector(name, default)
        return self.text(name, default)

    def _value(self, name: str, default: Any) -> Any:
        value = self.given(name)
        return default if value is None else value

    def _wrong(self, name: str, value: str, legal: str) -> ValueError:
        return self._error(f"{self._before}{name}: {value}{self._joint}legal: {legal}")


def read(
    defaults: Config,
    params: Params,
    prefixes: Mapping[str, str] | None = None,
    leave: Iterable[str] = (),
) -> Config:
    """A dataclass like `defaults`, with what the parameters set.

    Args:
        defaults: an instance; a field that is a dataclass itself is a group, whose parameters are
            read by the same rules.
        params: where from.
        prefixes: of the names of the parameters of a group, by the group's path of fields.
        leave: fields that are not read.

    Raises:
        ParamError, or the error of `params`: a value of another type.
    """
    return _Reader(params, prefixes or {}, frozenset(leave)).read(defaults, path="", prefix="")


@dataclasses.dataclass(frozen=True)
class _Reader:
    params: Params
    prefixes: Mapping[str, str]
    leave: frozenset[str]

    def read(self, defaults: Any, path: str, prefix: str) -> Any:
        """A group; `path` is that of its field."""
        values = {}
        for item in dataclasses.fields(defaults):
            here = f"{path}.{item.name}" if path else item.name
            if here not in self.leave:
                values[item.name] = self._field(item, getattr(defaults, item.name), here, prefix)
        return dataclasses.replace(defaults, **values)

    def _field(self, item: dataclasses.Field[Any], default: Any, path: str, prefix: str) -> Any:
        if dataclasses.is_dataclass(default):
            return self.read(default, path, self.prefixes.get(path, prefix))
        name = prefix + item.metadata.get(_NAME, item.name)
        convert = item.metadata.get(_CONVERT)
        if convert is None:
            return self.params.like(name, default)
        given = self.params.given(name)
        return default if given is None else convert(self.params.number(name, 0.0))

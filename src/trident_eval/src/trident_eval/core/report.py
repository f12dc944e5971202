# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A verdict for people: its rows, and a short table of text."""

from __future__ import annotations

from typing import Any

from trident_eval.core.rows import Row, value_text
from trident_eval.core.subjects import SUBJECTS

_ROWS = (
    ("mode", "mode", ""),
    ("rows flown by all", "rows_flown", ""),
    ("formation RMS", "formation_rms_m", "m"),
    ("tracking RMS", "tracking_rms_m", "m"),
    ("minimum separation", "min_separation_m", "m"),
    ("of the file itself", "file_min_separation_m", "m"),
    ("simulated time", "sim_s", "s"),
    ("wall-clock time", "wall_s", "s"),
    ("real-time factor", "rtf", ""),
    ("state hash", "state_hash", ""),
)
_BELOW = {"formation_rms_m": "formation_rms_limit_m"}
_MIN_LIMITS = {"min_separation_m": "min_separation_limit_m"}


def verdict_rows(verdict: dict[str, Any]) -> list[Row]:
    """Everything in a verdict that is known, in the order to be shown."""
    shown = [Row("vehicles", ", ".join(verdict.get("vehicles") or []))]
    for label, key, unit in _ROWS:
        value = verdict.get(key)
        if value is not None or _limit(verdict, key) is not None:
            shown.append(_row(verdict, label, key, unit))
    shown += _not_repeatable(verdict)
    return shown + [row for subject in SUBJECTS for row in subject.rows(verdict)]


def _not_repeatable(verdict: dict[str, Any]) -> list[Row]:
    """What would not come again, so that another run has another state hash: who, when, why."""
    return [
        Row("not repeatable", f"{note['who']}, t = {note['t']:.2f} s: {note['why']}", "", False)
        for note in verdict.get("not_repeatable") or []
    ]


def table(verdict: dict[str, Any]) -> str:
    """The verdict as aligned lines of text."""
    rows = verdict_rows(verdict)
    width = max(len(row.label) for row in rows)
    lines = [f"  {row.label:<{width}}  {_shown(row)}" for row in rows]
    lines.append(f"  {'verdict':<{width}}  {'PASS' if verdict['pass'] else 'FAIL'}")
    lines += [f"    - {reason}" for reason in verdict["reasons"]]
    lines += [f"    ({note})" for note in verdict.get("notes") or []]
    return "\n".join(lines)


def _shown(row: Row) -> str:
    return f"{row.value}  (limit: {row.limit})" if row.limit else row.value


def _value_text(verdict: dict[str, Any], key: str, unit: str) -> str:
    value = verdict.get(key)
    text = "unknown" if value is None else value_text(value, unit)
    if key == "state_hash" and verdict.get("repeatable") is False:
        return f"{text} (not repeatable)"
    return text


def _row(verdict: dict[str, Any], label: str, key: str, unit: str) -> Row:
    value, limit = verdict.get(key), _limit(verdict, key)
    if key == "rows_flown":
        return Row(label, f"{value} of {verdict.get('rows')}", "", value == verdict.get("rows"))
    text = _value_text(verdict, key, unit)
    if limit is None:
        return Row(label, text)
    if key in _BELOW:
        return Row(
            label, text, f"below {value_text(limit, unit)}", value is not None and value < limit
        )
    is_satisfied = value is not None and value >= limit
    return Row(label, text, f"at least {value_text(limit, unit)}", is_satisfied)


def _limit(verdict: dict[str, Any], key: str) -> Any:
    name = _BELOW.get(key) or _MIN_LIMITS.get(key)
    return verdict.get(name) if name else None

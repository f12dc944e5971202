# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A verdict for people: its rows, and a short table of text."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

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
_NAME_OF_RULE = re.compile(r"\((.+)\)$")


@dataclass(frozen=True)
class Row:
    """One line of a verdict.

    Attributes:
        label: what it is.
        value: with its unit.
        limit: what it is held against; "" where nothing is, or the value says it.
        is_satisfied: whether the value is as it must be; None where any value is.
    """

    label: str
    value: str
    limit: str = ""
    is_satisfied: bool | None = None


def verdict_rows(verdict: dict[str, Any]) -> list[Row]:
    """Everything in a verdict that is known, in the order to be shown."""
    shown = [Row("vehicles", ", ".join(verdict.get("vehicles") or []))]
    for label, key, unit in _ROWS:
        value = verdict.get(key)
        if value is not None or _limit(verdict, key) is not None:
            shown.append(_row(verdict, label, key, unit))
    shown += _not_repeatable(verdict)
    platforms: dict[str, dict[str, Any]] = verdict.get("platforms") or {}
    shown += [_platform_row(name, numbers) for name, numbers in platforms.items()]
    shown += _trial_rows(verdict.get("link_trial") or {})
    shown += [_nmea_row(numbers) for numbers in verdict.get("nmea") or []]
    commanded: dict[str, dict[str, Any]] = verdict.get("commanded") or {}
    shown += [_commanded_row(name, numbers) for name, numbers in commanded.items()]
    shown += _plc_rows(verdict["plc"]) if verdict.get("plc") else []
    shown += [_relay_row(numbers) for numbers in verdict.get("relay") or []]
    return shown + [_call_row(numbers) for numbers in verdict.get("calls") or []]


def _trial_rows(trial: dict[str, Any]) -> list[Row]:
    """What crossed without a base station of the air, and with one."""
    rows = []
    for key, word in (("direct", "directly"), ("relayed", "with base station")):
        if key not in trial:
            continue
        numbers = trial[key]
        share, limit = numbers["share"], numbers["limit"]
        counts = f"{numbers['delivered']} of {numbers['offered']}"
        value = counts if share is None else f"{100.0 * share:.1f} %, {counts}"
        value += f", {numbers['from_s']:.0f} s to {numbers['to_s']:.0f} s"
        is_above = share is not None and share >= limit
        is_satisfied = share is not None and is_above == (key == "relayed")
        held = "below" if key == "direct" else "at least"
        label = f"{trial['source']} -> {trial['destination']} {word}"
        rows.append(Row(label, value, f"{held} {100.0 * limit:g} %", is_satisfied))
    return rows


def _not_repeatable(verdict: dict[str, Any]) -> list[Row]:
    """What would not come again, so that another run has another state hash: who, when, why."""
    return [
        Row("not repeatable", f"{note['who']}, t = {note['t']:.2f} s: {note['why']}", "", False)
        for note in verdict.get("not_repeatable") or []
    ]


def _platform_row(name: str, numbers: dict[str, Any]) -> Row:
    """What one platform of a run of missions did."""
    rms, limit = numbers["tracking_rms_m"], numbers["tracking_limit_m"]
    places = f"{numbers['waypoints_reached']} of {numbers['waypoints']} waypoints"
    done = f" in {numbers['done_s']:.1f} s" if numbers["done_s"] is not None else ""
    is_satisfied = numbers["done_s"] is not None and rms is not None and rms <= limit
    error = "unknown" if rms is None else _text(rms, "m")
    value = f"{places}{done}, tracking RMS {error}"
    return Row(name, value, f"all, at most {_text(limit, 'm')}", is_satisfied)


def _nmea_row(numbers: dict[str, Any]) -> Row:
    """What a vehicle sent as NMEA 0183, and how far its RTK fixed positions were from the truth."""
    value = f"{numbers['sentences']} sentences, {numbers['rtk_fixed']} RTK fixed positions"
    if numbers["position_max_m"] is not None:
        value += f" within {_text(numbers['position_max_m'], 'm')}"
    limit = f"at most {_text(numbers['position_limit_m'], 'm')}, no wrong line"
    return Row(f"NMEA of {numbers['vehicle']}", value, limit, numbers["satisfied"])


def _commanded_row(name: str, numbers: dict[str, Any]) -> Row:
    """What one vehicle did that a client has commanded."""
    items, passed, reported = (numbers[f"items{key}"] for key in ("", "_passed", "_reported"))
    armed = "armed" if numbers["armed"] else "not armed"
    refusals = f"{numbers['refusals']} refusal{'s' * (numbers['refusals'] != 1)}"
    value = (
        f"{armed}, {passed} of {items} items ({reported} reported), {numbers['end']}, {refusals}"
    )
    is_satisfied = (
        numbers["armed"]
        and numbers["mission_equal"]
        and numbers["ended"]
        and passed == reported == items
        and not numbers["refusals"]
    )
    return Row(name, value, f"all, within {_text(numbers['radius_m'], 'm')}", is_satisfied)


def _plc_rows(numbers: dict[str, Any]) -> list[Row]:
    """What went through a PLC's registers."""

    def row(label: str, counts: tuple[str, str], worst: str, unit: str, limit: float) -> Row:
        done, total = numbers[counts[0]], numbers[counts[1]]
        value, most = f"{done} of {total}", numbers[worst]
        if most is not None:
            value += f", within {_text(most, unit)}"
        is_satisfied = total > 0 and done == total and (most or 0.0) <= limit
        return Row(label, value, f"all, within {_text(limit, unit)}", is_satisfied)

    arrived, stopped = ("commands_arrived", "commands"), ("stopped", "silences")
    return [
        row("commands arrived", arrived, "delay_max_s", "s", numbers["delay_limit_s"]),
        row("stopped in silence", stopped, "stopped_after_max_s", "s", numbers["stopped_limit_s"]),
        Row(
            "commands beyond limits",
            f"{numbers['illegal_arrived']} of {numbers['illegal_commands']} arrived",
            "none",
            numbers["illegal_arrived"] == 0,
        ),
    ]


def _relay_row(numbers: dict[str, Any]) -> Row:
    """What arrived of one robot's topic at another robot by radio."""
    value = f"{numbers['delivered']} of {numbers['offered']}"
    return _radio_row(numbers, numbers["source"], numbers["destination"], value)


def _call_row(numbers: dict[str, Any]) -> Row:
    """How many calls of a robot's service by another one were answered by radio."""
    value = f"{numbers['answered']} of {numbers['called']} calls answered"
    return _radio_row(numbers, numbers["caller"], numbers["server"], value)


def _radio_row(numbers: dict[str, Any], source: str, destination: str, value: str) -> Row:
    """By a rule, with its delays, if there is any."""
    named = _NAME_OF_RULE.search(numbers["rule"])
    name = named[1] if named else numbers["rule"]
    if numbers["delay_max_s"] is not None:
        mean, longest = numbers["delay_mean_s"], numbers["delay_max_s"]
        value += f", delay {_delay_text(mean)}, at most {_delay_text(longest)}"
    deadline_s, is_satisfied = numbers["deadline_s"], numbers["satisfied"]
    limit = f"delay at most {deadline_s:g} s" if deadline_s else ""
    has_limit = bool(limit) or not is_satisfied
    label = f"{name} {source} -> {destination}"
    return Row(label, value, limit, is_satisfied if has_limit else None)


def _delay_text(delay_s: float) -> str:
    return f"{1e3 * delay_s:.1f} ms" if delay_s < 1.0 else f"{delay_s:.2f} s"


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
    text = "unknown" if value is None else _text(value, unit)
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
        return Row(label, text, f"below {_text(limit, unit)}", value is not None and value < limit)
    is_satisfied = value is not None and value >= limit
    return Row(label, text, f"at least {_text(limit, unit)}", is_satisfied)


def _limit(verdict: dict[str, Any], key: str) -> Any:
    name = _BELOW.get(key) or _MIN_LIMITS.get(key)
    return verdict.get(name) if name else None


def _text(value: Any, unit: str) -> str:
    text = f"{value:.3f}" if isinstance(value, float) else str(value)
    return f"{text} {unit}".strip()

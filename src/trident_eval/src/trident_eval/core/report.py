# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Verdict and pictures for people: a short table, and a page."""

from __future__ import annotations

import html
from pathlib import Path
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


def verdict_rows(verdict: dict[str, Any]) -> list[tuple[str, str]]:
    """Label and value of everything in a verdict that is known, in the order to be shown."""
    shown = [("vehicles", ", ".join(verdict.get("vehicles") or []))]
    for label, key, unit in _ROWS:
        value = verdict.get(key)
        if value is None:
            continue
        text = f"{value:.3f}" if isinstance(value, float) else str(value)
        if key == "rows_flown":
            text = f"{value} of {verdict.get('rows')}"
        shown.append((label, f"{text} {unit}".strip()))
    return shown


def table(verdict: dict[str, Any]) -> str:
    """The verdict as aligned lines of text."""
    rows = verdict_rows(verdict)
    width = max(len(label) for label, _ in rows)
    lines = [f"  {label:<{width}}  {value}" for label, value in rows]
    lines.append(f"  {'verdict':<{width}}  {'PASS' if verdict['pass'] else 'FAIL'}")
    lines += [f"    - {reason}" for reason in verdict["reasons"]]
    return "\n".join(lines)


def page(title: str, verdict: dict[str, Any] | None, pictures: list[Path]) -> str:
    """The verdict (if there is one) and the pictures, which lie beside it, as one HTML page."""
    parts = [
        "<!doctype html><html lang='en'><meta charset='utf-8'>",
        f"<title>{html.escape(title)}</title>",
        "<style>body{font:15px/1.5 sans-serif;max-width:1100px;margin:2em auto;padding:0 1em}"
        "img{max-width:100%}td{padding:.1em 1.5em .1em 0}.bad{color:#b00020}</style>",
        f"<h1>{html.escape(title)}</h1>",
    ]
    if verdict is not None:
        word = "pass" if verdict["pass"] else "fail"
        parts.append(f"<p><b class='{'' if verdict['pass'] else 'bad'}'>{word}</b></p><table>")
        for label, value in verdict_rows(verdict):
            parts.append(f"<tr><td>{html.escape(label)}<td>{html.escape(value)}")
        parts.append("</table><ul class='bad'>")
        parts += [f"<li>{html.escape(reason)}" for reason in verdict["reasons"]]
        parts.append("</ul>")
    for picture in pictures:
        name = html.escape(picture.name)
        parts.append(f"<p><img src='{name}' alt='{name}'></p>")
    return "\n".join(parts) + "\n"

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The report of a run: one HTML file that holds everything, pictures included."""

from __future__ import annotations

import base64
import html
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from trident_eval.core.provenance import Provenance
from trident_eval.core.report import verdict_rows
from trident_eval.core.rows import Row
from trident_eval.core.vehicles import FlightLog

PAGE_STYLE = """
body{font:15px/1.5 system-ui,sans-serif;color:#222;max-width:1080px;margin:2em auto;padding:0 1em}
h1{margin-bottom:0}h2{margin-top:2em;border-bottom:1px solid #ddd}
.about{color:#666;margin-top:0}
.verdict{display:inline-block;padding:.2em 1em;border-radius:.3em;color:#fff;font-weight:bold}
.pass{background:#1b7f4b}.fail{background:#b00020}.bad{color:#b00020}.good{color:#1b7f4b}
table{border-collapse:collapse;margin:.5em 0}
td,th{padding:.15em 1.5em .15em 0;text-align:left;vertical-align:top}
th{font-weight:normal;color:#666;white-space:nowrap}td{overflow-wrap:anywhere}
td:first-child,.limit{white-space:nowrap}
figure{margin:1.5em 0}figcaption{color:#666}img{max-width:100%;height:auto}
pre{background:#f5f5f5;padding:.8em 1em;overflow-x:auto;white-space:pre-wrap}
summary{cursor:pointer;margin:.5em 0}pre{font-family:ui-monospace,monospace;font-size:.9em}
"""
_CAPTIONS = {
    "paths": "Paths in 3D and in plan; dots and grey outlines: the formation at some instants.",
    "height": "Height of each vehicle above the ground plane of the world.",
    "formation_error": "Error of the shape, after the rigid motion that fits it best.",
    "separation": "Distance of the closest two vehicles.",
    "tracking_error": "Distance of each vehicle to its set-point.",
    "links": "Signal over noise between radios with traffic, and messages delivered per second.",
    "animation": "Plan view in time; hollow circles: the vehicles' set-points.",
}
_MIME = {".png": "image/png", ".gif": "image/gif"}


@dataclass(frozen=True)
class Report:
    """Everything that a page shows.

    Attributes:
        title: of the page.
        about: one line below the title.
        verdict: as in verdict.json; None: nothing was judged.
        flown: of each vehicle.
        pictures: image files, animations first.
        provenance: where it comes from.
        warnings: warnings and errors of the launch.
        drawn_with: versions of what has made the pictures.
    """

    title: str
    about: str = ""
    verdict: dict[str, Any] | None = None
    flown: Sequence[FlightLog] = ()
    pictures: Sequence[Path] = ()
    provenance: Provenance = field(default_factory=Provenance)
    warnings: Sequence[str] = ()
    drawn_with: dict[str, str] = field(default_factory=dict)


def page(report: Report) -> str:
    """The report as the text of one HTML file."""
    parts = [
        "<!doctype html><html lang='en'><meta charset='utf-8'>",
        "<meta name='viewport' content='width=device-width'>",
        f"<title>{html.escape(report.title)}</title><style>{PAGE_STYLE}</style>",
        f"<h1>{html.escape(report.title)}</h1><p class='about'>{html.escape(report.about)}</p>",
        *_verdict(report.verdict),
        *_warnings(report.warnings),
        *_flown(report.flown),
        *(html_figure(picture) for picture in report.pictures),
        *_repeat(report),
        *_went_in(report.provenance),
        *_versions(report),
    ]
    return "\n".join(parts) + "\n"


def _items(texts: Iterable[str]) -> str:
    return "".join(f"<li>{html.escape(text)}" for text in texts)


def _facts(known: dict[str, Any], labels: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
    """Rows of what is known: each label with the value of its key, where that is not empty."""
    return [(label, str(known[key])) for label, key in labels if known.get(key)]


def _verdict(verdict: dict[str, Any] | None) -> Iterable[str]:
    if verdict is None:
        return
    word = "pass" if verdict["pass"] else "fail"
    yield f"<p class='verdict {word}'>{word.upper()}</p>"
    if verdict["reasons"]:
        yield f"<ul class='bad'>{_items(verdict['reasons'])}</ul>"
    if verdict.get("notes"):
        yield f"<ul>{_items(verdict['notes'])}</ul>"
    rows = "".join(_verdict_row(row) for row in verdict_rows(verdict))
    yield f"<table><tr><th><th>value<th>limit<th>{rows}</table>"


def _verdict_row(row: Row) -> str:
    kept = {True: "<span class='good'>✓</span>", False: "<span class='bad'>✗</span>"}
    label, value, limit = (html.escape(cell) for cell in (row.label, row.value, row.limit))
    if row.is_satisfied is None:
        return f"<tr><td>{label}<td colspan='2'>{value}"
    return f"<tr><td>{label}<td>{value}<td class='limit'>{limit} {kept[row.is_satisfied]}"


def _warnings(warnings: Sequence[str]) -> Iterable[str]:
    if warnings:
        lines = html.escape("\n".join(warnings))
        yield _folded(f"{len(warnings)} warnings and errors", f"<pre>{lines}</pre>")


def _flown(flown: Sequence[FlightLog]) -> Iterable[str]:
    if not flown:
        return
    yield "<h2>Vehicles</h2>"
    header = [
        "vehicle",
        "path [m]",
        "highest [m]",
        "fastest [m/s]",
        "tracking RMS [m]",
        "tracking maximum [m]",
    ]
    rows = [
        [
            one.name,
            f"{one.path_m:.2f}",
            f"{one.highest_m:.2f}",
            f"{one.fastest_m_s:.2f}",
            _known(one.tracking_rms_m),
            _known(one.tracking_max_m),
        ]
        for one in flown
    ]
    yield html_table(rows, header)


def html_figure(picture: Path) -> str:
    """A PNG or GIF with its caption, inside the page."""
    data = base64.b64encode(picture.read_bytes()).decode()
    caption = html.escape(_CAPTIONS.get(picture.stem, picture.stem))
    name = html.escape(picture.name)
    return (
        f"<figure><img alt='{name}' src='data:{_MIME[picture.suffix]};base64,{data}'>"
        f"<figcaption>{caption} <a href='{name}'>{name}</a></figcaption></figure>"
    )


def _repeat(report: Report) -> Iterable[str]:
    commands = report.provenance.repeat_commands()
    if not commands:
        return
    yield "<h2>How to repeat it</h2>"
    yield f"<pre>{html.escape(chr(10).join(commands))}</pre>"
    untracked = report.provenance.launch.get("untracked")
    if untracked:
        names = html.escape(", ".join(untracked[:20]) + (" …" if len(untracked) > 20 else ""))
        yield f"<p class='bad'>Files that were not in git, and are not in the patch: {names}</p>"
    yield from _to_compare(report.provenance.run)


def _to_compare(run: dict[str, Any]) -> Iterable[str]:
    """What to compare a repeated run with."""
    labels = (("seed", "seed"), ("steps", "steps"), ("state hash", "state_hash"))
    facts = [(label, str(run[key])) for label, key in labels if key in run]
    if not facts:
        return
    if run.get("repeatable") is False:
        yield "<p class='bad'>It is not repeatable to the bit; the verdict says who, when, why.</p>"
        return
    yield "<p>It is the same run, to the bit, if these come out again:</p>"
    yield html_table(facts)


def _went_in(provenance: Provenance) -> Iterable[str]:
    launch = provenance.launch
    labels = (
        ("launch file", "launch_file"),
        ("started", "started"),
        ("real-time factor asked for", "real_time_factor"),
        ("ROS_PACKAGE_PATH", "ros_package_path"),
    )
    facts = _facts(launch, labels)
    facts += [(f"{name}:=", str(value)) for name, value in launch.get("args", {}).items()]
    if facts or provenance.parameters or provenance.files:
        yield "<h2>What went in</h2>"
        yield html_table(facts)
    if provenance.files:
        rows = sorted(provenance.files.items())
        yield _folded(f"{len(rows)} files and their SHA-256", html_table(rows))
    if provenance.parameters:
        rows = provenance.flat_parameters()
        yield _folded(f"{len(rows)} parameters", html_table(rows))


def _versions(report: Report) -> Iterable[str]:
    launch = report.provenance.launch
    shown = _facts(launch, (("Trident", "version"), ("commit", "commit")))
    machine = launch.get("machine", {})
    shown += [
        (name, machine[name]) for name in ("debian", "kernel", "cpu", "cores") if name in machine
    ]
    shown += [(f"{name} (of this page)", text) for name, text in report.drawn_with.items()]
    yield "<h2>Versions</h2>"
    yield html_table(shown)
    libraries = launch.get("versions", {})
    if libraries:
        yield _folded(f"{len(libraries)} packages", html_table(sorted(libraries.items())))


def html_table(rows: Iterable[Sequence[str]], header: Sequence[str] = ()) -> str:
    """Rows of texts as a table."""
    head = "<tr>" + "".join(f"<th>{html.escape(cell)}" for cell in header) if header else ""
    body = "".join("<tr>" + "".join(f"<td>{html.escape(cell)}" for cell in row) for row in rows)
    return f"<table>{head}{body}</table>"


def _folded(summary: str, body: str) -> str:
    return f"<details><summary>{html.escape(summary)}</summary>{body}</details>"


def _known(value: float | None) -> str:
    return "" if value is None else f"{value:.3f}"

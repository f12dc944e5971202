# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident latency`: how long the messages of a topic take, next to those of a bare one."""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from trident_eval.core.bridges.latency import LatencyRecord, percentiles_ms
from trident_eval.core.bridges.latency_plots import draw_latencies
from trident_eval.core.errors import EvalError
from trident_eval.core.exit_codes import exit_code_of
from trident_eval.core.tracks import Array
from trident_eval.latency.probe import listen, send_and_receive
from trident_eval.latency.topics import Topic, look_up
from trident_eval.options import add_latency

_BARE_TOPIC = "/trident_latency/bare"
_SIMULATED = (
    "the stamps are simulated times, and so is the time of arrival, from /clock: what is measured"
    " is how much simulated time passes in between, not wall time"
)


def main() -> int:
    """Measures, prints and draws.

    Returns:
        0: measured; 1: messages were lost; 2: nothing could be measured.
    """
    parser = argparse.ArgumentParser(prog="trident latency", description=__doc__)
    add_latency(parser)
    options = parser.parse_args()
    try:
        return _measure(options)
    except EvalError as error:
        print(f"trident latency: {error}", file=sys.stderr)
        return 2


def _measure(options: argparse.Namespace) -> int:
    if options.out and not options.out.parent.is_dir():
        raise EvalError(f"--out {options.out}: its folder does not exist")
    topic = look_up(options.topic)
    with tempfile.TemporaryDirectory(prefix="trident_latency_") as name:
        folder = Path(name)
        title, record = _measure_topic(options, topic, folder)
        _print(title, record)
        bare = _sent(options, folder, _BARE_TOPIC, _BARE_TOPIC)
    _print(f"a bare topic, {options.message} at {options.rate:g} Hz", bare)
    if options.out:
        _draw({title: record.latency_ms, "a bare topic": bare.latency_ms}, options.out)
    return 1 if record.lost else 0


def _draw(latencies: dict[str, Array], out: Path) -> None:
    draw_latencies({title: data for title, data in latencies.items() if len(data)}, "latency", out)
    print(f"written: {out}")


def _measure_topic(
    options: argparse.Namespace, topic: Topic, folder: Path
) -> tuple[str, LatencyRecord]:
    """What is measured depends on who publishes."""
    if options.against:
        echo = look_up(options.against)
        return f"{topic.name} to {echo.name}", _sent(options, folder, topic.name, echo.name)
    if not topic.publishers:
        return f"{topic.name}, published here", _sent(options, folder, topic.name, topic.name)
    if not topic.has_header:
        raise EvalError(
            f"{topic.name}: {topic.type or 'its messages'} has no header, so no stamp to compare;"
            " legal: a topic with one, or --against the topic where an echo comes back"
        )
    if topic.is_simulated:
        print(f"{topic.name}: {_SIMULATED}")
    limit_s = max(5.0, 3.0 * options.count / options.rate)
    record = listen(folder, topic.name, count=options.count, limit_s=limit_s)
    return f"{topic.name}, from its stamps", record


def _sent(options: argparse.Namespace, folder: Path, topic: str, echo: str) -> LatencyRecord:
    return send_and_receive(
        folder,
        topic,
        echo,
        options.message,
        rate=options.rate,
        count=options.count,
        size=options.size,
    )


def _print(title: str, record: LatencyRecord) -> None:
    values = percentiles_ms(record.latency_ms)
    text = ", ".join(f"{name} {value:.3f}" for name, value in values.items())
    print(f"{title}: {len(record.latency_ms)} messages, {record.lost} lost; [ms] {text or '-'}")


if __name__ == "__main__":
    sys.exit(exit_code_of(main))

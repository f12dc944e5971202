# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What crosses between robots by radio, and what is read past it: from a master's lists."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

_STATUS = "/link_status"
_STATUS_TYPE = "trident_msgs/LinkStatusArray"
# Of a topic that has readers and no publisher yet.
_UNKNOWN_TYPE = "*"


@dataclass(frozen=True)
class Graph:
    """Who publishes and reads what.

    Attributes:
        publishers: nodes by topic.
        readers: nodes by topic.
        types: by topic.
        services: their names.
    """

    publishers: Mapping[str, Sequence[str]]
    readers: Mapping[str, Sequence[str]]
    types: Mapping[str, str]
    services: Sequence[str] = ()


@dataclass(frozen=True)
class RelayedTopic:
    """A topic that a robot has from another one by radio.

    Attributes:
        topic: its name.
        kind: its type; "*": nobody has said.
        readers: nodes.
        is_published: False: it is read, and no rule has made it so far.
    """

    topic: str
    kind: str
    readers: Sequence[str]
    is_published: bool


@dataclass(frozen=True)
class PastRadio:
    """A node of one robot that reads a topic of another one as if there were a wire."""

    node: str
    topic: str


def graph_of(
    publishers: Iterable[tuple[str, Iterable[str]]],
    readers: Iterable[tuple[str, Iterable[str]]],
    types: Iterable[tuple[str, str]],
    services: Iterable[tuple[str, Iterable[str]]] = (),
) -> Graph:
    """Arrange what a master answers.

    Args:
        publishers: of getSystemState(), first list: topic and nodes.
        readers: of getSystemState(), second list.
        types: of getTopicTypes(): topic and type.
        services: of getSystemState(), third list.
    """
    return Graph(
        {topic: sorted(nodes) for topic, nodes in publishers},
        {topic: sorted(nodes) for topic, nodes in readers},
        dict(types),
        sorted(name for name, _ in services),
    )


def radios(graph: Graph) -> list[str]:
    """Names of the robots with a radio: their namespaces without the first slash, sorted."""
    return sorted(
        topic[1 : -len(_STATUS)]
        for topic in graph.publishers
        if topic.endswith(_STATUS)
        and len(topic) > len(_STATUS) + 1
        and graph.types.get(topic, _UNKNOWN_TYPE) in (_STATUS_TYPE, _UNKNOWN_TYPE)
    )


def relayed_topics(graph: Graph) -> list[RelayedTopic]:
    """Every topic /B/from/A/T of radios A and B that is published or read, sorted."""
    names = radios(graph)
    heads = tuple(f"/{b}/from/{a}/" for b in names for a in names if a != b)
    return [
        RelayedTopic(
            topic,
            graph.types.get(topic, _UNKNOWN_TYPE),
            graph.readers.get(topic, []),
            topic in graph.publishers,
        )
        for topic in sorted({*graph.publishers, *graph.readers})
        if topic.startswith(heads)
    ]


def called_services(graph: Graph) -> list[str]:
    """Every service /B/to/A/S of radios A and B, sorted."""
    names = radios(graph)
    heads = tuple(f"/{b}/to/{a}/" for b in names for a in names if a != b)
    return [service for service in graph.services if service.startswith(heads)]


def read_past_radio(graph: Graph) -> list[PastRadio]:
    """Subscriptions of a robot's nodes to topics of another robot with a radio, sorted by node.

    What a robot has by radio is below its own namespace, and so is not among them.
    """
    names = radios(graph)
    found = []
    for topic, nodes in graph.readers.items():
        owner = _robot_of(topic, names)
        robots = ((node, _robot_of(node, names)) for node in nodes)
        found += [
            PastRadio(node, topic)
            for node, robot in robots
            if robot is not None and owner is not None and robot != owner
        ]
    return sorted(found, key=lambda past: (past.node, past.topic))


def _robot_of(name: str, robots: Iterable[str]) -> str | None:
    """The robot in whose namespace a node or a topic is; of nested ones the innermost."""
    owners = [robot for robot in robots if name.startswith(f"/{robot}/")]
    return max(owners, key=len, default=None)


def topics_text(graph: Graph) -> str:
    """Radios, what crosses by rules, and what is read past the radio, as lines of text."""
    names, relayed, past = radios(graph), relayed_topics(graph), read_past_radio(graph)
    lines = [f"radios: {', '.join(names) or 'none'}"]
    lines.append(f"relayed topics:{'' if relayed else ' none'}")
    lines += aligned([_relayed_cells(one) for one in relayed])
    services = called_services(graph)
    lines.append(f"services by radio:{'' if services else ' none'}")
    lines += [f"  {service}" for service in services]
    lines.append(f"read past the radio:{'' if past else ' nothing'}")
    lines += aligned([[one.node, f"reads {one.topic}"] for one in past])
    return "\n".join(lines)


def _relayed_cells(one: RelayedTopic) -> list[str]:
    readers = f"read by {', '.join(one.readers)}" if one.readers else "no readers"
    if not one.is_published:
        readers += "; nothing is published: no rule for it, or no message so far"
    return [one.topic, one.kind, readers]


def aligned(rows: Sequence[Sequence[str]], numbers_from: int | None = None) -> list[str]:
    """Rows of equally many cells as indented lines.

    Args:
        rows: of the table.
        numbers_from: the column from which on cells are numbers, and stand on the right.
    """
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    first = len(widths) if numbers_from is None else numbers_from
    return [
        "  "
        + "  ".join(
            cell.ljust(width) if column < first else cell.rjust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Makes Debian's ROS message headers usable from C++20.

Debian 12 generated most of its message headers with an older gencpp, which names allocators
through ``std::allocator<void>::rebind``; C++20 has removed that member. The headers concerned are
copied with each ``typename A::template rebind<T>::other`` written as
``std::allocator_traits<A>::rebind_alloc<T>``, which is the same type: objects compiled against the
originals stay compatible. roscpp's serialization.h is treated likewise.

Usage: modernise_message_headers.py SHARE_DIR INCLUDE_DIR OUTPUT_DIR
"""

import re
import sys
from pathlib import Path

_OLD_HEAD = "typename ContainerAllocator::template rebind<"
_OLD_TAIL = "::other"
_NEW_HEAD = "typename std::allocator_traits<ContainerAllocator>::template rebind_alloc<"


# A copy has no siblings beside it, so they are included by their full names.
_SIBLING = re.compile(r'^#include "([A-Za-z0-9_]+\.h)"', re.MULTILINE)


def _end_of_template_argument(text: str, start: int) -> int:
    """Index of the ``>`` that closes a template argument list whose inside begins at ``start``.

    Raises:
        ValueError: the list does not close.
    """
    depth = 1
    for index in range(start, len(text)):
        depth += {"<": 1, ">": -1}.get(text[index], 0)
        if depth == 0:
            return index
    raise ValueError(f"unclosed template argument list at {text[start : start + 60]!r}")


def modernise(text: str) -> str:
    """``text`` with every use of the removed member replaced, also where uses are nested.

    Raises:
        ValueError: a use is not of the form that gencpp wrote.
    """
    parts: list[str] = []
    position = 0
    while (start := text.find(_OLD_HEAD, position)) >= 0:
        inside = start + len(_OLD_HEAD)
        end = _end_of_template_argument(text, inside)
        if not text.startswith(_OLD_TAIL, end + 1):
            raise ValueError(f"unexpected use of rebind: {text[start : end + 20]!r}")
        parts += [text[position:start], _NEW_HEAD, modernise(text[inside:end]), ">"]
        position = end + 1 + len(_OLD_TAIL)
    return "".join(parts) + text[position:]


def old_headers(share: Path, include: Path) -> list[Path]:
    """Headers of the ROS packages in ``share`` that use the removed member."""
    folders = ["ros", *sorted(manifest.parent.name for manifest in share.glob("*/package.xml"))]
    headers = (header for name in folders for header in sorted((include / name).glob("*.h")))
    return [header for header in headers if _OLD_HEAD in header.read_text(encoding="utf-8")]


def main(share: Path, include: Path, output: Path) -> None:
    """Writes the copies below ``output``; files that are right already keep their time."""
    wanted: set[Path] = set()
    for header in old_headers(share, include):
        target = output / header.relative_to(include)
        wanted.add(target)
        text = modernise(header.read_text(encoding="utf-8"))
        text = _SIBLING.sub(rf"#include <{header.parent.name}/\1>", text)
        if target.is_file() and target.read_text(encoding="utf-8") == text:
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")
    for stale in set(output.rglob("*.h")) - wanted:
        stale.unlink()


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:4]))

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the C headers of the MAVLink dialect with pymavlink's generator.

``generate.py FOLDER`` writes ``FOLDER/trident/mavlink.h`` with all that it includes, and
``FOLDER/trident_message_list.h``, a list of the messages for the preprocessor.
"""

from __future__ import annotations

import contextlib
import io
import re
import shutil
import sys
from pathlib import Path

DIALECT = Path(__file__).with_name("trident.xml")
_INCLUDE = re.compile(r"<include>\s*(\S+?)\s*</include>")
_LIST = "trident_message_list.h"


def copy_definitions(folder: Path) -> Path:
    """Copies the dialect and those of pymavlink that it includes into one folder.

    Returns:
        The dialect's copy.
    """
    import pymavlink

    library = Path(pymavlink.__file__).parent / "dialects" / "v20"
    folder.mkdir(parents=True, exist_ok=True)
    waiting, done = [DIALECT], set[str]()
    while waiting:
        source = waiting.pop()
        done.add(source.name)
        shutil.copyfile(source, folder / source.name)
        names = _INCLUDE.findall(source.read_text(encoding="utf-8"))
        waiting += [library / name for name in names if name not in done]
    return folder / DIALECT.name


def generate(definition: Path, folder: Path) -> str:
    """Writes the C headers of a definition file; returns what the generator printed."""
    from pymavlink.generator import mavgen

    options = mavgen.Opts(
        str(folder), wire_protocol="2.0", language="C", validate=False, strict_units=False
    )
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        mavgen.mavgen(options, [str(definition)])
    return printed.getvalue()


def message_list(folder: Path) -> str:
    """The messages of generated headers as a macro: X(lower-case name, upper-case name)."""
    names = sorted(
        path.stem.removeprefix("mavlink_msg_") for path in folder.glob("*/mavlink_msg_*.h")
    )
    rows = "".join(f" \\\n  X({name}, {name.upper()})" for name in names)
    return f"#pragma once\n\n#define TRIDENT_MAVLINK_MESSAGES(X){rows}\n"


def main(folder: Path) -> None:
    """Writes everything below ``folder``, from nothing."""
    shutil.rmtree(folder, ignore_errors=True)
    printed = generate(copy_definitions(folder / "definitions"), folder)
    if not (folder / "trident" / "mavlink.h").is_file():
        sys.exit(f"generate.py: {DIALECT}: the generator wrote no mavlink.h:\n{printed}")
    (folder / _LIST).write_text(message_list(folder), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a benchmark ran on."""

from __future__ import annotations

import os
import platform
import re
import subprocess
from pathlib import Path
from typing import Any


def parse_cpu_model(cpuinfo: str) -> str:
    """Name of the processor, from the text of /proc/cpuinfo; "unknown" when it has none."""
    found = re.search(r"^model name\s*:\s*(.+)$", cpuinfo, re.MULTILINE)
    return " ".join(found.group(1).split()) if found else "unknown"


def describe_machine() -> dict[str, Any]:
    """Cores that may be used, processor, memory [MB], system and load average."""
    pages = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    return {
        "cores": len(os.sched_getaffinity(0)),
        "cpu_model": parse_cpu_model(Path("/proc/cpuinfo").read_text(encoding="utf-8")),
        "memory_mb": round(pages / 2**20),
        "system": platform.platform(),
        "load_average": list(os.getloadavg()),
    }


def describe_commit(folder: Path) -> str:
    """Commit of the checkout around ``folder``, with "-dirty" when files differ from it."""
    result = subprocess.run(
        ["git", "-C", str(folder), "describe", "--always", "--dirty"],
        capture_output=True,
        text=True,
        check=False,
    )
    return result.stdout.strip() or "unknown"

# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The suites of `./trident bench nav`."""

from __future__ import annotations

import argparse
import importlib

from trident_benchmarks.results import check_folder, new_document, write_document


def measure(options: argparse.Namespace) -> int:
    """Measures the suite that is asked for and prints its table.

    Returns:
        0: measured.

    Raises:
        EvalError: nothing can be measured.
    """
    check_folder(options.out)
    check_folder(options.picture)
    document = new_document()
    suite = importlib.import_module(f"trident_benchmarks.nav.{options.suite}")
    document["rows"] = suite.measure(options)
    write_document(options.out, document)
    return 0

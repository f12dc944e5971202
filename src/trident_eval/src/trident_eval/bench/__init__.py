# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Empty: its modules are in trident_benchmarks; moved_names.py has the new name of each."""

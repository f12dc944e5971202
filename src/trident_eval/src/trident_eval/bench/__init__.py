# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Measures the simulator and prints how: ``python -m trident_eval.bench sim``."""

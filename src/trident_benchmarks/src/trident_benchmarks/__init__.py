# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Benchmarks: what `./trident bench` measures; registry.py lists them."""

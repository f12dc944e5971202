# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""How long messages take: `./trident latency` and the tutorial's latency_test.py."""

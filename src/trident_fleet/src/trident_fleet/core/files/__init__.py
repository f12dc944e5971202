# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Files of positions and settings: MATLAB, text and YAML, read with limits and exact errors."""

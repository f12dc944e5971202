# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A UAV as a base station of the air: where to hover so that radio links are best."""

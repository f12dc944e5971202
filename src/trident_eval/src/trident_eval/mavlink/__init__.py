# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A ground station that flies, drives and sails missions by itself, through MAVLink alone."""

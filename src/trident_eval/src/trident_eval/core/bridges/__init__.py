# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What went through MAVLink, NMEA 0183 and Modbus during a run."""

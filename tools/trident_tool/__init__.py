# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The command line of the workspace: provisioning, building, testing, running.

Standard library only.
"""

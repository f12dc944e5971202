# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from hypothesis import settings

settings.register_profile("trident", deadline=None, derandomize=True)
settings.load_profile("trident")

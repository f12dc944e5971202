# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from hypothesis import settings

# Wall time depends on the machine; examples must not, so that a failure can be had again.
settings.register_profile("trident", deadline=None, derandomize=True)
settings.load_profile("trident")

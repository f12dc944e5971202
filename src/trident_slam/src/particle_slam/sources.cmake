# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
target_sources(trident_slam PRIVATE
  src/particle_slam/proposal.cpp
)

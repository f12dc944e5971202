// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_sim/model_spec.h"

namespace trident::sim {

/// The files of a model's collisions, read before it is put into a world: reading takes as long as
/// hundreds of steps. What is not taken while this object lives is freed. May be made in any
/// thread.
class PreparedMeshes {
 public:
  /// Files that cannot be read are left to World::spawn(), which reports them.
  explicit PreparedMeshes(const ModelSpec& spec);
  ~PreparedMeshes();
  PreparedMeshes(const PreparedMeshes&) = delete;
  PreparedMeshes& operator=(const PreparedMeshes&) = delete;
};

}  // namespace trident::sim

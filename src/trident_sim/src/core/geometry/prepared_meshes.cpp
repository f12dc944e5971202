// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/prepared_meshes.h"

#include <map>
#include <mutex>
#include <tuple>

#include "mesh.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

using Key = std::tuple<std::string, double, double, double>;

/// What is read and not yet taken, with the number of objects that wait for it to be.
struct Store {
  std::mutex mutex;
  // A mesh that two collisions use is read, and taken, twice.
  std::multimap<Key, TriangleMesh> meshes;
  int users = 0;
};

Store& store() {
  static Store one;
  return one;
}

Key key_of(const MeshShape& shape) {
  return {shape.file, shape.scale.x(), shape.scale.y(), shape.scale.z()};
}

void prepare(const MeshShape& shape) {
  try {
    TriangleMesh mesh = read_mesh(shape, MeshDetail::kShape);
    const std::lock_guard<std::mutex> lock(store().mutex);
    store().meshes.emplace(key_of(shape), std::move(mesh));
  } catch (const Error&) {
    return;  // the builder of the collision reads it again, and knows its name
  }
}

}  // namespace

std::optional<TriangleMesh> take_prepared_mesh(const MeshShape& shape) {
  const std::lock_guard<std::mutex> lock(store().mutex);
  const auto found = store().meshes.find(key_of(shape));
  if (found == store().meshes.end()) return std::nullopt;
  TriangleMesh mesh = std::move(found->second);
  store().meshes.erase(found);
  return mesh;
}

PreparedMeshes::PreparedMeshes(const ModelSpec& spec) {
  {
    const std::lock_guard<std::mutex> lock(store().mutex);
    ++store().users;
  }
  for (const LinkSpec& link : spec.links) {
    for (const CollisionSpec& collision : link.collisions) {
      if (const auto* mesh = std::get_if<MeshShape>(&collision.shape)) prepare(*mesh);
    }
  }
}

PreparedMeshes::~PreparedMeshes() {
  const std::lock_guard<std::mutex> lock(store().mutex);
  if (--store().users == 0) store().meshes.clear();
}

}  // namespace trident::sim

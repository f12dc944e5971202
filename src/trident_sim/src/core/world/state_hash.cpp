// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/sha256.h"
#include "trident_sim/comms/radio.h"
#include "trident_sim/sea.h"
#include "trident_sim/world.h"

namespace trident::sim {
namespace {

void add_numbers(const double* first, int count, Sha256& hash) {
  for (int i = 0; i < count; ++i) hash.update_double(first[i]);
}

void add_state(const Model& model, Sha256& hash) {
  for (const auto& body : model.bodies) {
    const SE3& T = body->pose();
    add_numbers(T.p.data(), 3, hash);
    add_numbers(T.R.coeffs().data(), 4, hash);
    add_numbers(body->velocity().data(), 3, hash);
    add_numbers(body->angular_velocity().data(), 3, hash);
  }
  for (const auto& joint : model.joints) {
    if (joint->is_rotor) hash.update_double(joint->rotor_velocity);
  }
}

}  // namespace

/// Only what two runs must have in common: names, poses, velocities, rotors, sea and air. Two equal
/// hashes are the evidence that a run was repeated to the bit.
std::string World::state_hash() const {
  Sha256 hash;
  hash.update_double(static_cast<double>(step_count_));
  for (const auto& [name, model] : models_) {
    hash.update_string(name);
    add_state(*model, hash);
  }
  if (const auto sea = find_sea(*this)) hash.update_string(sea->state_text());
  if (const auto air = find_air(*this)) hash.update_string(air->state_text());
  if (const auto radio = find_radio(*this)) hash.update_string(radio->state_text());
  return hash.hex_digest();
}

}  // namespace trident::sim

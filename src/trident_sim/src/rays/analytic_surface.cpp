// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "analytic_surface.h"

#include <utility>

namespace trident::sim {
namespace {

/// Made by the first who needs it, as registrars run in any order.
AnalyticSurfaceFactory& registered_factory() {
  static AnalyticSurfaceFactory factory;
  return factory;
}

}  // namespace

AnalyticSurfaceRegistrar::AnalyticSurfaceRegistrar(AnalyticSurfaceFactory factory) {
  registered_factory() = std::move(factory);
}

std::shared_ptr<AnalyticSurfaceSource> make_analytic_surface(const World& world) {
  const AnalyticSurfaceFactory& factory = registered_factory();
  return factory ? factory(world) : nullptr;
}

}  // namespace trident::sim

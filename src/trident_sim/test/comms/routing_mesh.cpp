// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "routing_mesh.h"

#include <algorithm>
#include <utility>

namespace trident::sim {

RoutingMesh::RoutingMesh(const std::vector<RouterParams>& params, std::uint64_t seed)
    : params_(params),
      links_(params.size() * params.size()),
      is_on_(params.size(), true),
      dice_(seed, "routing mesh") {
  for (const RouterParams& one : params) routers_.emplace_back(name(routers_.size()), one);
  // Hellos are spread by name and time, so that a seed has to shift the time.
  now_ = kStep * static_cast<std::int64_t>(dice_.below(100));
}

std::string RoutingMesh::name(std::size_t node) {
  return "robot_" + std::string(node < 10 ? "0" : "") + std::to_string(node);
}

void RoutingMesh::set_link(std::size_t a, std::size_t b, const Link& there, const Link& back) {
  links_[a * size() + b] = there;
  links_[b * size() + a] = back;
}

void RoutingMesh::broadcast(std::size_t from, const std::string& bytes) {
  ++hellos_;
  hello_bytes_ += bytes.size();
  for (std::size_t to = 0; to < size(); ++to) {
    if (to == from || dice_.uniform() >= link(from, to).delivery) continue;
    in_flight_.push_back({step_ + dice_.below(max_delay_ + 1), from, to, bytes});
  }
}

void RoutingMesh::step() {
  for (std::size_t i = 0; i < size(); ++i) {
    if (!is_on_[i]) continue;
    if (const auto hello = routers_[i].due_hello(now_)) broadcast(i, *hello);
  }
  const auto later =
      std::stable_partition(in_flight_.begin(), in_flight_.end(),
                            [this](const Delivery& delivery) { return delivery.step <= step_; });
  std::for_each(in_flight_.begin(), later, [this](const Delivery& delivery) {
    if (!is_on_[delivery.to]) return;
    const double rate_bit_s = link(delivery.to, delivery.from).rate_bit_s;
    routers_[delivery.to].hear(delivery.bytes, name(delivery.from), rate_bit_s, now_);
  });
  in_flight_.erase(in_flight_.begin(), later);
  now_ = now_ + kStep;
  ++step_;
}

void RoutingMesh::run(double seconds) {
  const SimTime end = now_ + SimTime::from_seconds(seconds);
  while (now_ < end) step();
}

std::vector<std::size_t> RoutingMesh::next_hops(std::size_t destination) const {
  std::vector<std::size_t> result(size(), size());
  const std::string destination_name = name(destination);
  std::transform(routers_.begin(), routers_.end(), result.begin(), [&](const Router& router) {
    const auto hop = router.next_hop(destination_name);
    if (!hop) return size();
    return static_cast<std::size_t>(std::stoul(hop->substr(hop->find('_') + 1)));
  });
  return result;
}

bool RoutingMesh::is_loop_free() const {
  for (std::size_t destination = 0; destination < size(); ++destination) {
    const std::vector<std::size_t> next = next_hops(destination);
    if (next[destination] != size()) return false;
    for (std::size_t from = 0; from < size(); ++from) {
      std::size_t at = from, hops = 0;
      while (at != size() && hops <= size()) {
        at = next[at];
        ++hops;
      }
      if (at != size()) return false;
    }
  }
  return true;
}

std::optional<std::vector<std::size_t>> RoutingMesh::path(std::size_t from, std::size_t to) const {
  const std::vector<std::size_t> next = next_hops(to);
  std::vector<std::size_t> result{from};
  while (result.back() != to) {
    const std::size_t hop = next[result.back()];
    if (hop == size() || !is_on_[hop] || result.size() > size()) return std::nullopt;
    result.push_back(hop);
  }
  return result;
}

}  // namespace trident::sim

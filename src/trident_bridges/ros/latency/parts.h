// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// The parts of latency_probe: each is the main loop of a process, after ros::init(), and returns
/// its exit code. Throws Error on bad options.
#pragma once

#include <cstdint>

#include "probe_options.h"

namespace trident::bridges {

/// Messages that wait in roscpp for a slow end, rather than being lost by the measurement itself.
inline constexpr std::uint32_t kProbeQueue = 10'000;

/// Publishes numbered messages: number 0 until it has arrived, then 1 ... count.
int run_source(const ProbeOptions& options);
/// Notes when numbered messages arrive, until the source is done.
int run_sink(const ProbeOptions& options);
/// Notes stamps and arrivals of any messages with a header, as times of ros::Time.
int run_listener(const ProbeOptions& options);
/// Publishes what it gets, as plain roscpp does.
int run_relay(const ProbeOptions& options);
/// Sends what it gets to an endpoint, and publishes what comes from there, as bytes.
int run_bridge(const ProbeOptions& options);

}  // namespace trident::bridges

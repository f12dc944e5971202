// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trident::sim {

/// The camera of the plugins' examples (PluginExample::sensor); it looks down at the rotors.
constexpr const char* kExampleCamera = R"(
<sensor name="example" type="camera">
  <pose>0 0 0.5 0 1.2 0</pose>
  <update_rate>50</update_rate>
  <camera>
    <horizontal_fov>1.047</horizontal_fov>
    <image><width>16</width><height>10</height></image>
    <clip><near>0.1</near><far>100</far></clip>
    <noise><type>gaussian</type><mean>0</mean><stddev>0.05</stddev></noise>
  </camera>
</sensor>)";

}  // namespace trident::sim

// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trident::sim {

/// The lidar of the plugins' examples (PluginExample::sensor); it looks down at the rotors.
constexpr const char* kExampleLidar = R"(
<sensor name="example" type="ray">
  <pose>0 0 0.5 0 1.2 0</pose>
  <update_rate>50</update_rate>
  <ray>
    <scan>
      <horizontal>
        <samples>20</samples><resolution>1</resolution>
        <min_angle>-1</min_angle><max_angle>1</max_angle>
      </horizontal>
    </scan>
    <range><min>0.1</min><max>20</max></range>
    <noise><type>gaussian</type><mean>0</mean><stddev>0.01</stddev></noise>
  </ray>
</sensor>)";

}  // namespace trident::sim

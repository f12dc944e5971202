// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "port_binder.h"
#include "trident_sim/samples.h"

namespace trident::sim {

/// "compressed" for pictures, "compressedDepth" for depths: the topic below an image's own.
std::string compressed_name(const ImageSample& image);

/// That topic, as image_transport's plugins publish it (sensor_msgs/CompressedImage), with their
/// parameters below its name, read when the first subscriber comes: `format` (jpeg or png),
/// `jpeg_quality` (80), `png_level`; `depth_max` (10 m), `depth_quantization` (100). `png_level` is
/// 1 by default, as upstream's 9 takes ten times as long. Parameters out of range are an error that
/// is logged, and the default counts.
std::unique_ptr<OutputBinding> bind_compressed(TopicAdvertiser& advertiser,
                                               OutPort<ImageSample>& port);

}  // namespace trident::sim

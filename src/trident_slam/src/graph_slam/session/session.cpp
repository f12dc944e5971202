// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "session.h"

#include <utility>

namespace trident::slam {

void Session::save(BinaryWriter* writer) const {
  graph.save(writer);
  archive.save(writer);
  writer->put_pose(T_map_base);
  writer->put(travelled);
}

void Session::load(BinaryReader* reader) {
  Session read{KeyframeGraph(1, graph.solver()), {}, {}, 0.0};
  read.graph.load(reader);
  read.archive.load(reader);
  for (std::size_t i = 0; i < read.archive.size(); ++i) {
    if (read.archive[i].keyframe >= read.graph.size()) reader->fail();
  }
  read.T_map_base = reader->get_pose();
  read.travelled = reader->get<double>();
  *this = std::move(read);
}

}  // namespace trident::slam

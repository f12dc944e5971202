// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/layer_stack.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/byte_rows.h"
#include "trident_base/error.h"

namespace trident::nav {
namespace {

void require_unique_names(const std::vector<std::unique_ptr<Layer>>& layers) {
  for (std::size_t i = 0; i < layers.size(); ++i) {
    for (std::size_t j = i + 1; j < layers.size(); ++j) {
      if (layers[i]->name() == layers[j]->name()) {
        throw Error("two layers of a costmap are called '" + layers[i]->name() + "'");
      }
    }
  }
}

}  // namespace

LayerStack::LayerStack(std::vector<std::unique_ptr<Layer>> layers, std::uint8_t background)
    : layers_(std::move(layers)), background_(background) {
  require_unique_names(layers_);
  arrange_stages();
}

Layer* LayerStack::find(const std::string& name) const {
  for (const auto& layer : layers_) {
    if (layer->name() == name) return layer.get();
  }
  return nullptr;
}

bool LayerStack::enabled_changed() const {
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    if (enabled_[i] != layers_[i]->is_enabled()) return true;
  }
  return false;
}

void LayerStack::add_to_stages(Layer* layer) {
  if (auto* area = dynamic_cast<AreaLayer*>(layer)) {
    stages_.emplace_back().area = area;
  } else if (auto* cells = dynamic_cast<CellLayer*>(layer)) {
    if (stages_.back().area != nullptr) stages_.emplace_back();
    stages_.back().cells.push_back(cells);
  }
}

void LayerStack::arrange_stages() {
  std::vector<Stage> old;
  std::swap(old, stages_);
  enabled_.clear();
  stages_.emplace_back();  // without layers it spreads the background
  for (const auto& layer : layers_) {
    enabled_.push_back(layer->is_enabled());
    if (layer->is_enabled()) add_to_stages(layer.get());
  }
  for (std::size_t i = 0; i < std::min(stages_.size(), old.size()); ++i) {
    std::swap(stages_[i].output, old[i].output);  // large enough already
  }
  resize_stages();
}

void LayerStack::resize_stages() {
  for (Stage& stage : stages_) {
    stage.output.resize(geometry_.size());
    stage.changed.resize(geometry_.width, geometry_.height);
  }
  is_everything_new_ = true;
}

void LayerStack::resize(const GridGeometry& geometry) {
  geometry_ = geometry;
  for (const auto& layer : layers_) layer->resize(geometry);
  resize_stages();
  before_.resize(geometry.width, geometry.height);
  row_.resize(static_cast<std::size_t>(geometry.width));
}

void LayerStack::update(const CostmapInput& input) {
  if (enabled_changed()) arrange_stages();
  for (const auto& layer : layers_) {
    if (layer->is_enabled()) continue;
    before_.clear();
    layer->update(input, before_);
  }
  for (std::size_t i = 0; i < stages_.size(); ++i) update_stage(i, input);
  is_everything_new_ = false;
}

/// What changed in the layers of a stage or below it.
void LayerStack::collect_changes(std::size_t index, const CostmapInput& input) {
  Stage& stage = stages_[index];
  stage.changed.clear();
  for (CellLayer* layer : stage.cells) layer->update(input, stage.changed);
  if (stage.area != nullptr) stage.area->update(input, stage.changed);
  if (index > 0) stage.changed.insert(stages_[index - 1].changed);
  if (is_everything_new_) stage.changed.insert_all();
}

void LayerStack::update_stage(std::size_t index, const CostmapInput& input) {
  collect_changes(index, input);
  Stage& stage = stages_[index];
  const std::uint8_t* below = index == 0 ? nullptr : stages_[index - 1].output.data();
  if (!stage.changed.empty()) {
    if (stage.area != nullptr) {
      stage.area->process(below, stage.output.data(), stage.changed);
    } else {
      combine(below, stage);
    }
  }
  if (is_everything_new_) stage.changed.insert_all();
}

void LayerStack::combine(const std::uint8_t* below, Stage& stage) {
  before_.clear();
  std::swap(before_, stage.changed);
  before_.for_each_span([&](int y, int x0, int x1) { combine_span(below, y, x0, x1, stage); });
}

void LayerStack::combine_span(const std::uint8_t* below, int y, int x0, int x1, Stage& stage) {
  const std::size_t first = geometry_.index({x0, y});
  const auto count = static_cast<std::size_t>(x1 - x0);
  if (below == nullptr) {
    std::memset(row_.data(), background_, count);
  } else {
    std::memcpy(row_.data(), below + first, count);
  }
  for (const CellLayer* layer : stage.cells) layer->combine(y, x0, x1, row_.data());
  std::uint8_t* output = stage.output.data() + first;
  for (int x = x0; x < x1; x += BlockSet::kCells) {
    const int cells = std::min(BlockSet::kCells, x1 - x);
    if (replace_block(row_.data() + (x - x0), cells, output + (x - x0))) stage.changed.insert(x, y);
  }
}

const std::uint8_t* LayerStack::master() const { return stages_.back().output.data(); }

const BlockSet& LayerStack::changed() const { return stages_.back().changed; }

DistanceSource* LayerStack::top_distances() const {
  return dynamic_cast<DistanceSource*>(stages_.back().area);
}

}  // namespace trident::nav

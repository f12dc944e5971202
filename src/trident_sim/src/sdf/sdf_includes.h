// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <sdf/sdf.hh>
#include <string>
#include <vector>

namespace trident {

/// Where a URI leads; "" when it leads nowhere.
using UriFinder = std::function<std::string(const std::string&)>;

/// A model, actor or light that a world includes by its URI and nothing else.
struct PlainInclude {
  std::string uri;
  sdf::ElementPtr element;
};

/// What `<include>`s bring into the world of `text`, read here because libsdformat clones the whole
/// specification, 40 ms, for each of them. None, so that libsdformat does it all and tells of all
/// errors, unless everything that the world holds of models is included plainly, once and without
/// an error.
std::vector<PlainInclude> read_plain_includes(const std::string& text, const UriFinder& find);

}  // namespace trident

// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sdf/sdf.hh>
#include <string>

namespace trident::sim {

/// An empty document that knows the SDF specification, as sdf::init() makes one, for reading `text`
/// into. sdf::init() takes 40 ms and 10 MB: it parses every file of the specification as often as
/// others include it, <sensor> twelve times. Here a file is parsed once per process and shared.
/// Reading clones the descriptions of all that an element may hold; the big optional ones whose tag
/// `text` does not contain are therefore left out. Thread-safe.
sdf::SDFPtr make_document(const std::string& text);

}  // namespace trident::sim

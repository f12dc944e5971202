// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trident::nav {

/// How a search over cells ended.
enum class SearchResult { kFound, kNoPath, kCanceled };

}  // namespace trident::nav

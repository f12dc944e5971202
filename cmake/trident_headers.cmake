# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0

# Headers of the standard library, Eigen, googletest and roscpp, parsed once per target instead of once per source:
# a build from nothing spends a quarter of its time on them. Headers of our own stay out, so that a change of one builds
# only what includes it; every source still includes what it uses.

# trident_precompile_headers(<target> [<header>...])
function(trident_precompile_headers target)
  set(headers <algorithm> <array> <cmath> <cstdint> <functional> <map> <memory> <optional> <sstream>
              <string> <utility> <variant> <vector> <Eigen/Geometry> ${ARGN})
  target_precompile_headers(${target} PRIVATE ${headers})
endfunction()

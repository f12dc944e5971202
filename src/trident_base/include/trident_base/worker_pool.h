// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace trident {

/// Threads that share the parts of one piece of work. Which thread does which part is left to
/// chance: where every part writes only what is its own, the result does not depend on their
/// number.
class WorkerPool {
 public:
  /// `threads` >= 1, the caller's among them. The others are started when first needed, and sleep
  /// between pieces of work.
  explicit WorkerPool(std::size_t threads = 1);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  std::size_t threads() const { return threads_; }  ///< the caller's among them

  /// work(part, worker) for each part in [0, parts), and comes back when all are done. `worker` is
  /// in [0, threads()) and belongs to one thread at a time: it chooses memory to work in. Rethrows
  /// what the first part, by number, of those that threw has thrown. Not to be called from within
  /// work.
  void share(std::size_t parts,
             const std::function<void(std::size_t part, std::size_t worker)>& work);

 private:
  class Crew;
  std::size_t threads_;
  std::unique_ptr<Crew> crew_;  ///< nullptr: not needed yet
};

}  // namespace trident

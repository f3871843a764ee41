// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "scene/body_definition.h"
#include "state/state_head.h"

namespace nscdd {

/// Reads a state file, in one process. Every function throws Error, a sentence that names the file, when it is not one of this
/// version, as it was written.
class StateReader {
 public:
  explicit StateReader(const std::filesystem::path& path);
  ~StateReader();

  const StateHead& head() const;
  std::uint64_t checksum() const;
  std::int64_t bodies() const;
  /// By row of the file.
  std::vector<std::int64_t> Ids() const;
  std::vector<BodyRole> Roles() const;
  /// Calls `visit` for the bodies [first, last) in the order of the file, with the friction and restitution of their material
  /// in it; holds some ten thousands of them.
  void ForEachBody(std::int64_t first, std::int64_t last, const std::function<void(const BodyDefinition&)>& visit) const;
  /// What the solvers of all ranks saved, by rank.
  std::vector<std::vector<std::byte>> SolverParts() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nscdd

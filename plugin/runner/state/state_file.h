// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "results/rank_group.h"
#include "scene/gravity.h"
#include "scene/scene.h"

namespace nscdd {

/// What a state file says beside its bodies and its solver's state.
struct StateHead {
  std::string program;  ///< version
  std::string plugin;   ///< name and version; its solver wrote the solver's state
  std::string scene;    ///< name
  RunClock clock;
  double dt = 0.0;             ///< [s] of the last step
  double period = 0.0;         ///< [m] 0: not periodic
  double period_origin = 0.0;  ///< [m]
  double mean_radius = 0.0;    ///< [m] of the grains; 0: there are none
  std::vector<Material> materials;
  std::string run;  ///< what `nscdd run --resume` goes on with: text of FormatHead()
};

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

/// Collective. Writes a state file (README.md) to `path`: of each rank its bodies and its solver's state. The head is the same
/// on all ranks, but for `run`, of which rank 0's counts. Throws Error on all ranks when it cannot be written.
void WriteStateFile(const std::filesystem::path& path, const StateHead& head, const std::vector<BodyDefinition>& bodies,
                    std::span<const std::byte> solver_state, const RankGroup& ranks);

/// Bytes before the HDF5 part of a state file (HDF5's user block): mark, version, size and checksum.
inline constexpr std::size_t kSealSize = 512;
inline constexpr std::int64_t kStateVersion = 1;

/// Writes the seal of a state file that is complete but for it. Throws Error when it cannot be written.
void Seal(const std::filesystem::path& path);

/// The checksum in the seal of these bytes. Throws Error, a clause about the file, unless they are those of a state file of
/// this version, as they were written.
std::uint64_t CheckSeal(std::span<const std::byte> bytes);

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tradeoff/contestant.h"
#include "tradeoff/plan.h"

namespace nscdd {

/// Consecutive steps of the scene that are measured.
struct Stretch {
  std::int64_t first = 1;
  std::int64_t count = 0;
  Snapshot before;  ///< some steps earlier; step 0: the scene's own start
};

/// The steps that are measured, spread over the whole scene: all of them, or some stretches of equal length. Where the bodies
/// are before a stretch comes from a scouting run of the plugin, so that every setting, the reference too, begins it alike.
class Course {
 public:
  /// Makes the scouting run, if there must be one: `nscd` at nat 1e-5 (else whatever the reference is made with), for at most
  /// `seconds`. What it does not reach is left out.
  Course(const Plan& plan, double seconds, const StopQuestion& interrupted, const std::function<void(std::int64_t)>& progress);

  const std::vector<Stretch>& stretches() const { return stretches_; }
  std::int64_t steps() const;  ///< measured
  std::int64_t last() const { return stretches_.back().first + stretches_.back().count - 1; }
  /// Leaves the stretch `index` its first `count` steps.
  void Cut(std::size_t index, std::int64_t count) { stretches_[index].count = count; }
  /// "100 of 300 steps, in 5 stretches: 1-20, 61-80, ..."
  std::string Summary() const;

  /// A contestant for the stretch `index`. The plugin's begin at its first step with the impulses of the step before, made by
  /// an accurate solver on the setting's grid; Box2D goes some steps by itself to have its own, and to leave the skin of its
  /// walls.
  std::unique_ptr<Contestant> Enter(std::size_t index, const Setting& setting);
  /// What the plugin's contestants on one subdomain begin the stretch with.
  const Snapshot& StartOf(std::size_t index) { return Start(index, "1x1"); }

 private:
  const Snapshot& Start(std::size_t index, const std::string& grid);
  /// From the snapshot to just before the stretch.
  void Approach(const Stretch& stretch, int substeps, Contestant* contestant) const;
  void Scout(double seconds, const StopQuestion& interrupted, const std::function<void(std::int64_t)>& progress);

  const Plan& plan_;
  std::vector<Stretch> stretches_;
  std::map<std::pair<std::size_t, std::string>, Snapshot> starts_;
};

}  // namespace nscdd

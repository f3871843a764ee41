// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "nscdd/body_table.h"
#include "nscdd/platform_adapter.h"
#include "nscdd/report.h"
#include "nscdd/step_problem.h"
#include "nscdd/vector.h"
#include "scene/platform.h"
#include "scene/scene.h"
#include "tradeoff/plan.h"

namespace nscdd {

/// What a step cost beside seconds, and what its solver says of it.
struct Effort {
  SolveStatus status = SolveStatus::kFixed;
  std::string reason;
  double reported_nat = -1.0;       ///< [-] by the solver itself; < 0: it does not say
  std::int64_t sweeps = 0;          ///< passes over the contacts
  std::int64_t exchanges = 0;       ///< among neighbouring subdomains: interface updates and conjugate gradient iterations
  std::int64_t exchange_bytes = 0;  ///< in them, were every subdomain a rank: each copy of an interface body sends its velocity
};

Effort EffortOf(const SolveReport& report);

/// Bodies of a scene after a step, and what the solver that made it would go on with.
struct Snapshot {
  std::int64_t step = 0;
  BodyTable bodies;  ///< ascending ids
  std::map<ContactKey, Vec2> impulses;
  std::vector<std::byte> state;  ///< of a solver of the plugin, with its partition; empty: none
};

/// Bodies of a scene in a host at the first step, and something that moves them.
class Contestant {
 public:
  virtual ~Contestant() = default;
  virtual PlatformAdapter& adapter() = 0;
  virtual void SetGravity(Vec2 gravity) = 0;
  /// The problem of the next step, linearised where this solver finds its contacts. Box2D does so where the bodies are at the
  /// beginning of the step (theta = 1, whatever `stepping` says): half-way through it the normals of bodies that pass each
  /// other have turned, and its impulses would not balance.
  virtual StepProblem Read(const SteppingOptions& stepping, double dt) = 0;
  /// One step of `dt` [s]: this is what is timed.
  virtual void Step(double dt) = 0;
  virtual Effort LastEffort() const = 0;
  /// Whether the next steps keep their impulses; costs time.
  virtual void KeepImpulses(bool keep) = 0;
  /// Of the last step, by contact key; pairs that are not there had none.
  virtual const std::map<ContactKey, Vec2>& impulses() = 0;
  /// After the step `step`.
  virtual Snapshot Capture(std::int64_t step) = 0;
  /// Puts the bodies where they were, before the first Step(); solvers of the plugin take the state.
  virtual void Put(const Snapshot& snapshot) = 0;
};

/// A solver of the plugin on the platform `adapter`; `stepping`: options that every setting shares.
std::unique_ptr<Contestant> MakePluginContestant(const Scene& scene, const std::string& adapter, const SolverRegistry& registry,
                                                 const Setting& setting);

/// b2World::Step, sleeping off, warm starting on; its adapter() finds contacts as Box2D's own solver does (Box2dSurface).
/// Throws Error unless WhyNotBox2d() is empty.
std::unique_ptr<Contestant> MakeBox2dContestant(const Scene& scene, const Setting& setting, bool continuous = true);

/// Restores poses and velocities of all bodies.
void PutBodies(const BodyTable& bodies, Platform* platform);

/// Empty, or why Box2D's own solver is no comparison here: it has no period, and its lengths suit grains of 0.1 to 10 m.
std::string WhyNotBox2d(const Scene& scene);

}  // namespace nscdd

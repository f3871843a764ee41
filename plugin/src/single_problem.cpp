// SPDX-License-Identifier: Apache-2.0
#include "single_problem.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "guard.h"
#include "nscdd/callback/contact_arrays.h"

namespace nscdd {
namespace {

constexpr const char* kWho = "nscdd_problem";

// `count` elements T out of consecutive doubles.
template <class T>
std::vector<T> CopyArray(const double* source, const char* name, std::size_t count) {
  static_assert(sizeof(T) % sizeof(double) == 0 && std::is_trivially_copyable_v<T>);
  if (source == nullptr && count > 0) throw BadCall(fmt::format("{}: the array {} is null", kWho, name));
  for (std::size_t i = 0; i < count * (sizeof(T) / sizeof(double)); ++i) {
    if (std::isfinite(source[i])) continue;
    throw Error(fmt::format("{}: number {} of {} is {}, must be finite", kWho, i, name, source[i]));
  }
  std::vector<T> target(count);
  if (count > 0) std::memcpy(static_cast<void*>(target.data()), source, count * sizeof(T));
  return target;
}

// Masses are checked by the core; here only prescribed motion is completed: mass +inf, inertia of no matter.
void CopyMasses(const nscdd_problem& source, std::size_t count, ContactProblem* problem) {
  if (count > 0 && (source.mass == nullptr || source.inertia == nullptr)) {
    throw BadCall(fmt::format("{}: mass or inertia is null", kWho));
  }
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  problem->mass.assign(source.mass, source.mass + count);
  problem->inertia.assign(source.inertia, source.inertia + count);
  for (std::size_t i = 0; i < count; ++i) {
    if (problem->mass[i] == kInfinite) problem->inertia[i] = kInfinite;
  }
}

// What the core does not look at before it is used.
void CheckNumbers(const ContactTable& c) {
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (!std::isfinite(c.site[i].x + c.site[i].y)) throw Error(fmt::format("{}: contact {}: site is not finite", kWho, i));
    if (!c.has_arms() || std::isfinite(c.arm_a[i].x + c.arm_a[i].y + c.arm_b[i].x + c.arm_b[i].y)) continue;
    throw Error(fmt::format("{}: contact {}: an arm is not finite", kWho, i));
  }
}

template <class T>
void CheckFinite(const std::vector<T>& values, const char* name) {
  const auto* number = reinterpret_cast<const double*>(values.data());
  for (std::size_t i = 0; i < values.size() * (sizeof(T) / sizeof(double)); ++i) {
    if (std::isfinite(number[i])) continue;
    throw Failure(
        fmt::format("the solution's {} has the number {} at place {}; nothing was written; look at the masses, levers and "
                    "velocities of the problem, whose range exceeds double precision",
                    name, number[i], i));
  }
}

template <class T>
void CopyOut(const std::vector<T>& values, double* target) {
  if (!values.empty()) std::memcpy(target, values.data(), values.size() * sizeof(T));
}

}  // namespace

SingleProblem CopyProblem(const nscdd_problem& source, const PartitionOptions& grid) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::int32_t>::max();
  if (source.body_count > kMost)
    throw Error(fmt::format("{}: {} bodies, at most {} can be handled", kWho, source.body_count, kMost));
  const auto bodies = static_cast<std::size_t>(source.body_count);
  const bool several = grid.nx > 1 || grid.ny > 1;
  SingleProblem single;
  ContactProblem& problem = single.problem;
  CopyMasses(source, bodies, &problem);
  problem.free_velocity = CopyArray<Twist>(source.free_velocity, "free_velocity", bodies);
  problem.impulse = CopyArray<Wrench>(source.impulse, "impulse", bodies);
  if (several && source.contacts.count > 0 && source.contacts.site == nullptr) {
    throw BadCall(fmt::format("{}: contacts.site is null; {}x{} subdomains are placed by it: give it, or set subdomains = 1x1",
                              kWho, grid.nx, grid.ny));
  }
  CopyContacts(source.contacts, bodies, {.keys = false, .sites = several}, fmt::format("{}, contacts", kWho),
               &problem.contacts);
  CheckNumbers(problem.contacts);
  problem.offset = CopyArray<double>(source.offset, "offset", problem.contacts.size());
  if (several) problem.subdomain = SubdomainsOf(problem.contacts.site, grid.nx, grid.ny);
  if (!std::isfinite(source.approach_speed) || source.approach_speed < 0.0) {
    throw Error(fmt::format("{}: approach_speed is {} m/s, must be finite and >= 0", kWho, source.approach_speed));
  }
  problem.approach_speed = source.approach_speed;
  if (source.warm_impulse != nullptr)
    single.warm = CopyArray<Vec2>(source.warm_impulse, "warm_impulse", problem.contacts.size());
  return single;
}

void CopySolution(const ContactSolution& solution, nscdd_solution* target) {
  CheckFinite(solution.velocity, "velocity");
  CheckFinite(solution.impulse, "impulse");
  CheckFinite(solution.relative_velocity, "relative_velocity");
  if (target->velocity != nullptr) CopyOut(solution.velocity, target->velocity);
  if (target->impulse != nullptr) CopyOut(solution.impulse, target->impulse);
  if (target->relative_velocity != nullptr) CopyOut(solution.relative_velocity, target->relative_velocity);
}

}  // namespace nscdd

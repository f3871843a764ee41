// SPDX-License-Identifier: Apache-2.0
// Loads the plugin and solves one problem with both solvers: a disk of 2 kg at rest on a fixed body. plugin_host PLUGIN.so
#include <cmath>
#include <cstdio>
#include <limits>

#include "nscdd/error.h"
#include "nscdd/host/solver_registry.h"

namespace {

constexpr double kMass = 2.0, kRadius = 0.5, kFall = -9.81 * 0.01;  // kg, m, m/s: one step of gravity

nscdd::ContactProblem DiskOnFloor() {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  nscdd::ContactProblem p;
  p.mass = {kInfinite, kMass};
  p.inertia = {kInfinite, 0.5 * kMass * kRadius * kRadius};
  p.free_velocity = {{0.0, 0.0, 0.0}, {0.0, kFall, 0.0}};
  p.impulse = {{0.0, 0.0, 0.0}, {0.0, kMass * kFall, 0.0}};
  p.contacts.a = {0};
  p.contacts.b = {1};
  p.contacts.shape_a = p.contacts.shape_b = {0};
  p.contacts.gap = {0.0};
  p.contacts.normal = {{0.0, 1.0}};
  p.contacts.lever_a = {0.0};
  p.contacts.lever_b = {kRadius};
  p.contacts.site = {{0.0, 0.0}};
  p.contacts.flat = {1};
  p.contacts.friction = {0.3};
  p.contacts.restitution = {0.0};
  p.offset = {0.0};
  return p;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    nscdd::SolverRegistry registry;
    registry.Add(argv[1]);
    for (const char* name : {"nscd", "nscdd"}) {
      nscdd::Solver solver = registry.Create({.solver = name, .options = {}, .host = nullptr, .communicator = {}});
      const nscdd::ContactSolution solution = solver.Solve(DiskOnFloor());
      std::printf("%s: r_n = %.12f N s, v_y = %.12f m/s\n", name, solution.impulse[0].x, solution.velocity[1].vy);
      if (std::abs(solution.impulse[0].x + kMass * kFall) > 1e-9 || std::abs(solution.velocity[1].vy) > 1e-9) return 1;
    }
  } catch (const nscdd::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}

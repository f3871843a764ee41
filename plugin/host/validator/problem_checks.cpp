// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include "nscdd/host/solver.h"
#include "validator/check_list.h"

namespace nscdd {
namespace {

constexpr double kMass = 3.0, kRadius = 0.5, kGravity = 9.81, kTimeStep = 0.01, kFriction = 0.3;
constexpr double kInertia = 0.5 * kMass * kRadius * kRadius;
constexpr double kTolerance =
    1e-6;  // of velocities [m/s] and impulses [N s]: one contact, solved exactly but for the criterion

// One contact of two bodies; the first may have prescribed motion.
ContactProblem OneContact(double mass_a, Twist free_a, Twist free_b, Vec2 normal) {
  const bool wall = std::isinf(mass_a);
  ContactProblem p;
  p.mass = {mass_a, kMass};
  p.inertia = {wall ? mass_a : kInertia, kInertia};
  p.free_velocity = {free_a, free_b};
  p.impulse = {wall ? Wrench{} : Wrench{0.0, -kMass * kGravity * kTimeStep, 0.0}, {0.0, -kMass * kGravity * kTimeStep, 0.0}};
  p.contacts.a = {0};
  p.contacts.b = {1};
  p.contacts.shape_a = {0};
  p.contacts.shape_b = {0};
  p.contacts.gap = {0.0};
  p.contacts.normal = {normal};
  p.contacts.lever_a = {wall ? 0.0 : kRadius};
  p.contacts.lever_b = {kRadius};
  p.contacts.site = {Vec2{0.0, 0.0}};
  p.contacts.flat = {static_cast<std::uint8_t>(wall ? 1 : 0)};
  p.contacts.friction = {kFriction};
  p.contacts.restitution = {0.0};
  p.offset = {0.0};
  return p;
}

void ExpectNear(double found, double wanted, const char* what) {
  Expect(std::abs(found - wanted) <= kTolerance, fmt::format("{} is {}, must be {}", what, found, wanted));
}

ContactSolution SolveSharply(const std::shared_ptr<const PluginLibrary>& library, const std::string& name,
                             const ContactProblem& p) {
  SolverArguments arguments;
  arguments.solver = name;
  const nscdd_solver_info& info = *library->FindSolver(name);
  for (std::uint64_t i = 0; i < info.option_count; ++i) {
    if (std::string(info.options[i].name) == "tolerance") arguments.options = {{"tolerance", "1e-10"}};
  }
  ContactSolution solution = Solver(library, arguments).Solve(p);
  Expect(solution.report.status == SolveStatus::kConverged, fmt::format("it did not converge: {}", solution.report.reason));
  return solution;
}

constexpr double kInfinite = std::numeric_limits<double>::infinity();

void DiskAtRest(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  ForEachSolver(*library, [&](const std::string& name) {
    const auto s = SolveSharply(library, name, OneContact(kInfinite, {}, {0.0, -kGravity * kTimeStep, 0.0}, {0.0, 1.0}));
    ExpectNear(s.velocity[1].vy, 0.0, "vy of a disk at rest on a plane");
    ExpectNear(s.impulse[0].x, kMass * kGravity * kTimeStep, "the normal impulse (its weight times dt)");
    ExpectNear(s.impulse[0].y, 0.0, "the tangential impulse");
    ExpectNear(s.relative_velocity[0].x, 0.0, "the normal relative velocity");
  });
}

// Too fast to stick: r_t = -mu r_n, which slows the disk and turns it.
void SlidingDisk(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  ForEachSolver(*library, [&](const std::string& name) {
    const auto s = SolveSharply(library, name, OneContact(kInfinite, {}, {2.0, -kGravity * kTimeStep, 0.0}, {0.0, 1.0}));
    const double weight = kMass * kGravity * kTimeStep, tangential = -kFriction * weight;
    ExpectNear(s.impulse[0].x, weight, "the normal impulse of a sliding disk");
    ExpectNear(s.impulse[0].y, tangential, "its tangential impulse (-mu r_n)");
    ExpectNear(s.velocity[1].vx, 2.0 + tangential / kMass, "its vx");
    ExpectNear(s.velocity[1].vy, 0.0, "its vy");
    ExpectNear(s.velocity[1].spin, kRadius * tangential / kInertia, "its spin");
  });
}

// Equal masses at speeds 1 and -1: both stop without restitution, and exchange them with b_n = -2 m/s (restitution 1).
void HeadOn(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  ForEachSolver(*library, [&](const std::string& name) {
    ContactProblem p = OneContact(kMass, {1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, {1.0, 0.0});
    p.approach_speed = 2.0;
    const auto plastic = SolveSharply(library, name, p);
    ExpectNear(plastic.velocity[0].vx, 0.0, "vx of the left of two disks after a head-on impact without restitution");
    ExpectNear(plastic.impulse[0].x, kMass, "the impulse of that impact");
    p.offset = {-2.0};
    const auto elastic = SolveSharply(library, name, p);
    ExpectNear(elastic.velocity[0].vx, -1.0, "vx of the left of two disks after an elastic head-on impact");
    ExpectNear(elastic.velocity[1].vx, 1.0, "vx of the right one");
  });
}

void OpenContact(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  ForEachSolver(*library, [&](const std::string& name) {
    ContactProblem p = OneContact(kMass, {-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.0});
    const auto s = SolveSharply(library, name, p);
    ExpectNear(s.impulse[0].x, 0.0, "the impulse of a contact that opens");
    ExpectNear(s.velocity[1].vx, 1.0, "vx of a disk that leaves");
  });
}

}  // namespace

std::vector<Check> ProblemChecks() {
  return {
      {"holds a disk at rest on a plane", DiskAtRest},
      {"slows a sliding disk by Coulomb friction", SlidingDisk},
      {"solves a head-on impact", HeadOn},
      {"leaves an opening contact without impulse", OpenContact},
  };
}

}  // namespace nscdd

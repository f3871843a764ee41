// SPDX-License-Identifier: Apache-2.0
// Momentum of every step: what the free bodies gain is what gravity and walls give, to rounding, for every solver on every
// number of ranks (those of one subdomain on one), converged or not.

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "mpi_test.h"
#include "nscdd/reference/reference_adapter.h"
#include "packing.h"
#include "rows.h"

namespace nscdd::test {
namespace {

constexpr double kDt = 0.01;
constexpr Vec2 kGravity{2.9, -9.4};
constexpr double kTolerance = 1e-13;  ///< of the sum of all impulses

struct Named {
  const char* name;
  AlgorithmOptions options;
  bool one_subdomain = false;
  friend void PrintTo(const Named& solver, std::ostream* out) { *out << solver.name; }
};

std::vector<Named> Solvers() {
  const PartitionOptions grid{3, 2, 1};
  const StoppingOptions loose{.tolerance = 1e-3, .max_iterations = 60};
  FeaOptions fea;
  ReaOptions rea;
  IeaOptions iea;
  const auto prepare = [&](auto* options) {
    options->stopping = loose;
    options->partition = grid;
  };
  prepare(&fea);
  prepare(&rea);
  prepare(&iea);
  FeaOptions fea_cg = fea;
  IeaOptions iea_cg = iea;
  fea_cg.interface.solve = iea_cg.interface.solve = InterfaceSolve::kCg;
  return {{"nscd", NscdOptions{loose, {}}, true},
          {"nscdd", NscddOptions{loose, grid, 1, {}}},
          {"nscdd_plain", NscddOptions{loose, grid, 1, {.method = Acceleration::kNone}}},
          {"fea", fea},
          {"fea_cg", fea_cg},
          {"rea", rea},
          {"iea", iea},
          {"iea_cg", iea_cg},
          {"newton", NewtonOptions{}, true}};
}

/// Sums over the ranks, added in their order.
std::vector<double> Sum(const std::vector<double>& mine, Communicator* communicator) {
  const std::vector<double> all = communicator->AllGather(mine);
  std::vector<double> sum(mine.size());
  for (std::size_t i = 0; i < all.size(); ++i) sum[i % mine.size()] += all[i];
  return sum;
}

/// Largest | sum m (V' - V - dt g) - impulses of walls | of three steps, over the sum of all impulses and loads.
double LargestDefect(const Packing& packing, const AlgorithmOptions& options, Communicator* communicator) {
  reference::World world;
  world.gravity = kGravity;
  if (packing.periodic) world.period = 2.0 * packing.columns;
  const std::vector<reference::Body> all = MakeBodies(packing);
  std::map<std::int64_t, reference::Body> bodies;
  Vec2 momentum{};
  double mass = 0.0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    bodies[all[k].id] = all[k];
    if (static_cast<int>(k) % communicator->size() == communicator->rank()) world.Add(all[k]);
    if (all[k].kind != BodyKind::kFree) continue;
    momentum = momentum + all[k].mass * Linear(all[k].velocity);
    mass += all[k].mass;
  }
  reference::ReferenceAdapter adapter(&world);
  TimeStepper stepper({}, options, &adapter, communicator);
  double largest = 0.0;
  for (int k = 0; k < 3; ++k) {
    stepper.Step(kDt);
    Vec2 after{}, walls{};
    double impulses = 0.0;
    for (const test::BodyRow& b : test::Rows(stepper.bodies())) {
      if (b.kind == BodyKind::kFree) after = after + bodies.at(b.id).mass * Linear(b.velocity);
    }
    for (const test::ContactRow& c : test::Rows(stepper.contacts())) {
      const Vec2 on_b = c.impulse.x * c.normal + c.impulse.y * Vec2{c.normal.y, -c.normal.x};
      impulses += Norm(on_b);
      if (bodies.at(c.key.body_a).kind != BodyKind::kFree) walls = walls + on_b;
      if (bodies.at(c.key.body_b).kind != BodyKind::kFree) walls = walls - on_b;
    }
    const std::vector<double> sum = Sum({after.x, after.y, walls.x, walls.y, impulses}, communicator);
    const Vec2 now{sum[0], sum[1]};
    const double defect = Norm(now - momentum - mass * kDt * kGravity - Vec2{sum[2], sum[3]});
    largest = std::max(largest, sum[4] > 0.0 ? defect / (sum[4] + mass * kDt * Norm(kGravity)) : 1.0);
    momentum = now;
  }
  return largest;
}

using Momentum = MpiTestWithParam<Named>;

TEST_P(Momentum, GainsWhatGravityAndWallsGive) {
  if (GetParam().one_subdomain && communicator.size() > 1) GTEST_SKIP() << GetParam().name << " has one subdomain";
  const std::pair<const char*, Packing> packings[] = {{"disks", {}},
                                                      {"clusters", {.clusters = true}},
                                                      {"turning wall", {.restitution = 0.5, .turning_wall = true}},
                                                      {"periodic", {.periodic = true}},
                                                      {"frictionless", {.friction = 0.0}}};
  for (const auto& [name, packing] : packings) {
    EXPECT_LT(LargestDefect(packing, GetParam().options, &communicator), kTolerance) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, Momentum, testing::ValuesIn(Solvers()), testing::PrintToStringParamName());

}  // namespace
}  // namespace nscdd::test

// SPDX-License-Identifier: Apache-2.0
// A step's problem is stated once: posed from outside by nscdd/step_problem.h it has the step's own solution, bit for bit.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "host.h"
#include "nscdd/contact_problem.h"
#include "nscdd/normal_law.h"
#include "nscdd/step_problem.h"
#include "packing.h"
#include "rows.h"

namespace nscdd {
namespace {

using test::Host;
using test::Packing;

/// What the adapter of `host` says now, as a contact problem.
ContactProblem ProblemOf(Host* host, double dt) {
  BodyTable bodies;
  host->stepper();  // makes the adapter
  host->adapter->ReadBodies(&bodies);
  std::vector<Pose> detection;
  ContactProblem p;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool free = bodies.kind[i] == BodyKind::kFree;
    detection.push_back(Moved(bodies.pose[i], bodies.velocity[i], (1.0 - host->stepping.theta) * dt));
    p.mass.push_back(free ? bodies.mass[i] : std::numeric_limits<double>::infinity());
    p.inertia.push_back(free ? bodies.inertia[i] : std::numeric_limits<double>::infinity());
    p.free_velocity.push_back(FreeVelocity(bodies, i, InverseMassOf(bodies, i), dt));
    p.impulse.push_back({dt * bodies.force[i].fx, dt * bodies.force[i].fy, dt * bodies.force[i].torque});
  }
  host->adapter->DetectContacts({bodies.id, detection}, host->stepping.alert_distance, &p.contacts);
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    const NormalCondition normal = NormalConditionOf(host->stepping, bodies, {}, p.contacts, c, dt);
    p.offset.push_back(normal.offset);
    p.approach_speed = std::max(p.approach_speed, -normal.approach);
  }
  return p;
}

void ExpectSameStep(const Packing& packing) {
  SteppingOptions stepping;
  stepping.alert_distance = 0.1;
  stepping.theta = 0.7;
  stepping.normal_law = NormalLaw::kFeedback;
  NscdOptions options;
  options.stopping.tolerance = 1e-6;
  Host host(stepping, options);
  host.world.gravity = {2.0, -9.0};
  for (const reference::Body& body : test::MakeBodies(packing)) host.world.Add(body);
  const ContactProblem problem = ProblemOf(&host, 0.01);
  const ContactSolution solution = SolveContactProblem(problem, options);
  const StepReport& report = host.Step(0.01);
  EXPECT_GT(report.solve.active, 10);
  EXPECT_EQ(solution.report.iterations, report.solve.iterations);
  EXPECT_EQ(solution.report.residuals.nat, report.solve.residuals.nat);
  const auto bodies = test::Rows(host.stepper().bodies());
  ASSERT_EQ(solution.velocity.size(), bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    EXPECT_EQ(solution.velocity[i].vx, bodies[i].velocity.vx) << "body " << bodies[i].id;
    EXPECT_EQ(solution.velocity[i].vy, bodies[i].velocity.vy) << "body " << bodies[i].id;
    EXPECT_EQ(solution.velocity[i].spin, bodies[i].velocity.spin) << "body " << bodies[i].id;
  }
}

TEST(StepProblem, OfDisksWithFriction) { ExpectSameStep({.restitution = 0.3}); }
TEST(StepProblem, OfDisksWithoutFriction) { ExpectSameStep({.friction = 0.0}); }
TEST(StepProblem, OfClustersOnATurningWall) { ExpectSameStep({.restitution = 0.3, .clusters = true, .turning_wall = true}); }

TEST(ContactStatus, IsToldByTheImpulse) {
  EXPECT_EQ(StatusOf({0.0, 0.0}, 0.5), ContactStatus::kOpen);
  EXPECT_EQ(StatusOf({2.0, 0.9}, 0.5), ContactStatus::kSticking);
  EXPECT_EQ(StatusOf({2.0, -1.0}, 0.5), ContactStatus::kSliding);
  EXPECT_EQ(StatusOf({2.0, 0.0}, 0.0), ContactStatus::kSliding);
  EXPECT_EQ(StatusOf({std::numeric_limits<double>::quiet_NaN(), 0.0}, 0.5), ContactStatus::kOpen);
}

}  // namespace
}  // namespace nscdd

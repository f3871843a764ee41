// SPDX-License-Identifier: Apache-2.0
// A whole time step through the adapter, against closed forms.
#include <cmath>

#include "check.h"
#include "nscdd/communicator.h"
#include "nscdd/time_stepper.h"
#include "scenes.h"

namespace nscdd::conformance {
namespace {

constexpr double kStep = 1.0 / 128.0;  // [s]

void StepOnce(Session* session) {
  NscdOptions options;
  options.stopping.tolerance = 1e-14;
  options.stopping.test_every = 1;
  SerialCommunicator communicator;
  TimeStepper stepper(SteppingOptions{}, options, &session->adapter(), &communicator);
  const StepReport& report = stepper.Step(kStep);
  Require(report.solve.status == SolveStatus::kConverged, "one contact was not solved: {}", report.solve.reason);
  Require(report.solve.contacts == 1, "the step has {} contacts, not 1", report.solve.contacts);
}

void RequireSpeed(double value, double expected, const char* what) {
  Require(std::abs(value - expected) <= 1e-12, "{} is {:.17g}, expected {:.17g}", what, value, expected);
}

/// Two disks meet head-on; speeds after the step are  mean + restitution (mean - speed before).
void HeadOn(double restitution, double radius_a, double radius_b, Trial* trial) {
  Session session = trial->NewSession();
  DiskSpec spec;
  spec.restitution = restitution;
  spec.id = 1;
  spec.radius = radius_a;
  spec.centre = {-radius_a, 0.25};
  spec.velocity = {2.0, 0.0, 0.0};
  const std::int64_t id_a = session.host().AddDisk(spec);
  spec.id = 2;
  spec.radius = radius_b;
  spec.centre = {radius_b, 0.25};
  spec.velocity = {-1.0, 0.0, 0.0};
  const std::int64_t id_b = session.host().AddDisk(spec);
  const BodyTable before = session.Read();
  const std::size_t a = RowOf(before, id_a), b = RowOf(before, id_b);
  StepOnce(&session);
  const BodyTable after = session.Read();
  const double mean = (2.0 * before.mass[a] - before.mass[b]) / (before.mass[a] + before.mass[b]);
  RequireSpeed(after.velocity[a].vx, mean + restitution * (mean - 2.0), "the speed of the left disk after a head-on impact");
  RequireSpeed(after.velocity[b].vx, mean + restitution * (mean + 1.0), "the speed of the right disk after a head-on impact");
  const double half = 0.5 * kStep;
  RequireSpeed(after.pose[a].x, before.pose[a].x + half * (2.0 + after.velocity[a].vx), "the place of the left disk");
}

void HeadOnPair(Trial* trial) {
  HeadOn(0.0, 0.5, 0.5, trial);
  HeadOn(0.5, 0.5, 0.5, trial);
  HeadOn(1.0, 0.5, 0.5, trial);
  HeadOn(0.25, 0.5, 1.0, trial);
}

/// A disk on a floor under gravity (gx, -gy):  r_n = m gy dt,  r_t bounded by friction r_n, or what makes it roll.
void OnFloor(AddFloor add_floor, double friction, Trial* trial) {
  constexpr double kGx = 5.0, kGy = 8.5, kRadius = 1.0;
  Session session = trial->NewSession();
  session.host().SetGravity({kGx, -kGy});
  DiskSpec spec;
  spec.id = 10;
  spec.radius = kRadius;
  spec.centre = {0.0, kRadius};
  spec.friction = friction;
  const std::int64_t disk_id = session.host().AddDisk(spec);
  const auto floor = add_floor(3, friction, &session);
  if (!floor) return;
  const BodyTable before = session.Read();
  const std::size_t disk = RowOf(before, disk_id);
  const double m = before.mass[disk], inertia = before.inertia[disk];
  StepOnce(&session);
  const BodyTable after = session.Read();
  const Twist v = after.velocity[disk];
  const double rolling = m * kGx * kStep / (1.0 + m * kRadius * kRadius / inertia);  // impulse without slip
  const double impulse = std::min(rolling, friction * m * kGy * kStep);
  RequireSpeed(v.vx, kGx * kStep - impulse / m, "the speed of a disk along the floor");
  RequireSpeed(v.vy, 0.0, "the speed of a disk into the floor");
  RequireSpeed(v.spin, -kRadius * impulse / inertia, "the spin of a disk on the floor");
}

void OnEveryFloor(double friction, Trial* trial) {
  for (AddFloor add_floor : {AddHalfPlaneFloor, AddPolylineFloor, AddDiskFloor}) OnFloor(add_floor, friction, trial);
}

void SlidingDisk(Trial* trial) { OnEveryFloor(0.125, trial); }
void RollingDisk(Trial* trial) { OnEveryFloor(0.5, trial); }

}  // namespace

std::vector<Check> ClosedFormChecks() {
  const Fault no_friction =
      SpoilContacts("friction lost", [](const PoseView&, ContactTable* c) { c->friction.assign(c->size(), 0.0); });
  return {
      {"head_on_pair",
       "two disks that meet part as momentum and restitution say",
       HeadOnPair,
       {SpoilContacts("restitution lost", [](const PoseView&, ContactTable* c) { c->restitution.assign(c->size(), 0.0); })}},
      {"sliding_disk", "a disk slides down a floor as Coulomb says", SlidingDisk, {no_friction}},
      {"rolling_disk", "a disk rolls down a floor without slip", RollingDisk, {no_friction}},
  };
}

}  // namespace nscdd::conformance

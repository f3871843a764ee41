// SPDX-License-Identifier: Apache-2.0
// Who owns what: detection leaves the host alone, Commit does not, the host's user may edit; two hosts share nothing.
#include <algorithm>
#include <cmath>
#include <memory>

#include "check.h"
#include "scenes.h"

namespace nscdd::conformance {
namespace {

bool Same(const Pose& p, const Pose& q) { return p.x == q.x && p.y == q.y && p.angle == q.angle; }
bool Same(const Twist& v, const Twist& w) { return v.vx == w.vx && v.vy == w.vy && v.spin == w.spin; }

bool Near(const Pose& p, const Pose& q, double tolerance) {
  return std::abs(p.x - q.x) <= tolerance && std::abs(p.y - q.y) <= tolerance && std::abs(p.angle - q.angle) <= tolerance;
}

void DetectsAtGivenPoses(Trial* trial) {
  Session session = trial->NewSession();
  AddRandomDisks(50, {0.0, 0.0}, 30.0, &session, &trial->random);
  const BodyTable before = session.Read();
  std::vector<BodyState> seen;
  for (const std::int64_t id : before.id) seen.push_back(session.host().Read(id));
  BodyTable elsewhere = before;  // a dense packing, nowhere near the host's
  for (Pose& pose : elsewhere.pose) pose = {Uniform(200.0, 208.0, &trial->random), Uniform(-8.0, 0.0, &trial->random), 1.0};
  RequireAllPairs(elsewhere, session.Detect(elsewhere, 0.125), 0.125);
  RequireUnchanged(before, session.Read(), "DetectContacts");
  for (std::size_t row = 0; row < before.size(); ++row) {
    const BodyState now = session.host().Read(before.id[row]);
    Require(Same(now.pose, seen[row].pose) && Same(now.velocity, seen[row].velocity),
            "DetectContacts moved body {} of the host", before.id[row]);
  }
  RequireAllPairs(before, session.Detect(before, 0.125), 0.125);
}

void CommitVisible(Trial* trial) {
  Session session = trial->NewSession();
  AddRandomDisks(10, {0.0, 0.0}, 6.0, &session, &trial->random);
  BodyTable bodies = session.Read();
  for (std::size_t row = 0; row < bodies.size(); ++row) {
    if (bodies.kind[row] == BodyKind::kPrescribed) continue;
    const double s = 1.0 / 3.0 + static_cast<double>(row);
    bodies.pose[row] = {bodies.pose[row].x + s, bodies.pose[row].y - s, 0.1 * s};
    bodies.velocity[row] = {s, -0.5 * s, 0.25 * s};
  }
  session.Commit(bodies);
  RequireUnchanged(bodies, session.Read(), "reading back after Commit");
  const double tolerance = (1e-14 + session.host().precision()) * 64.0;
  for (std::size_t row = 0; row < bodies.size(); ++row) {
    const BodyState seen = session.host().Read(bodies.id[row]);
    const Twist &v = bodies.velocity[row], &w = seen.velocity;
    Require(Near(bodies.pose[row], seen.pose, tolerance), "the host shows body {} at ({}, {}, {}), not where Commit put it",
            bodies.id[row], seen.pose.x, seen.pose.y, seen.pose.angle);
    Require(std::abs(v.vx - w.vx) + std::abs(v.vy - w.vy) + std::abs(v.spin - w.spin) <= tolerance,
            "the host shows body {} with another velocity than Commit gave it", bodies.id[row]);
  }
}

void HostEditsAdopted(Trial* trial) {
  Session session = trial->NewSession();
  const std::vector<DiskSpec> specs = AddRandomDisks(10, {0.0, 0.0}, 6.0, &session, &trial->random);
  BodyTable bodies = session.Read();
  for (Pose& pose : bodies.pose) pose.x += 1.0 / 3.0;
  session.Commit(bodies);
  session.host().Move(specs[1].id, {-3.5, 7.25, 0.5});
  BodyTable edited = session.Read();
  const std::size_t moved = RowOf(edited, specs[1].id);
  Require(Near(edited.pose[moved], {-3.5, 7.25, 0.5}, 64.0 * (1e-14 + session.host().precision())),
          "body {} is read at ({}, {}, {}), not at (-3.5, 7.25, 0.5) where the host's user put it", specs[1].id,
          edited.pose[moved].x, edited.pose[moved].y, edited.pose[moved].angle);
  bodies.pose[moved] = edited.pose[moved];
  RequireUnchanged(bodies, edited, "an edit of another body");
  session.host().Remove(specs[2].id);
  DiskSpec added;
  added.id = 500;
  added.centre = {-3.5, 8.25};
  added.id = session.host().AddDisk(added);
  edited = session.Read();
  Require(edited.size() == bodies.size(), "after one body was removed and one added, {} are read, not {}", edited.size(),
          bodies.size());
  Require(!std::binary_search(edited.id.begin(), edited.id.end(), specs[2].id) || added.id == specs[2].id,
          "body {} is read, yet the host's user removed it", specs[2].id);
  RowOf(edited, added.id);
  RequireAllPairs(edited, session.Detect(edited, 0.125), 0.125);
}

void TwoInstances(Trial* trial) {
  Session one = trial->NewSession(), two = trial->NewSession();
  AddRandomDisks(20, {0.0, 0.0}, 6.0, &one, &trial->random);
  AddRandomDisks(30, {50.0, 0.0}, 7.0, &two, &trial->random);
  const BodyTable of_one = one.Read(), of_two = two.Read();
  Require(of_one.size() == 20 && of_two.size() == 30, "two worlds of 20 and 30 bodies are read as {} and {}", of_one.size(),
          of_two.size());
  RequireAllPairs(of_one, one.Detect(of_one, 0.125), 0.125);
  RequireAllPairs(of_two, two.Detect(of_two, 0.125), 0.125);
  BodyTable shifted = of_one;
  for (Pose& pose : shifted.pose) pose.y += 3.0;
  one.Commit(shifted);
  RequireUnchanged(of_two, two.Read(), "a Commit to another world");
  RequireUnchanged(shifted, one.Read(), "reading another world");
  RequireAllPairs(shifted, one.Detect(shifted, 0.125), 0.125);
}

Fault DetectsAtOwnPoses() {
  Fault fault;
  fault.name = "detection at the host's own poses";
  fault.detect = [](PlatformAdapter* whole, const PoseView& poses, double alert, ContactTable* contacts) {
    BodyTable own;
    whole->ReadBodies(&own);
    std::vector<Pose> own_poses(poses.pose.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
      own_poses[static_cast<std::size_t>(std::lower_bound(poses.id.begin(), poses.id.end(), own.id[i]) - poses.id.begin())] =
          own.pose[i];
    }
    whole->DetectContacts({poses.id, own_poses}, alert, contacts);
  };
  return fault;
}

Fault DetectionMovesTheHost() {
  Fault fault;
  fault.name = "detection moves the host";
  fault.detect = [](PlatformAdapter* whole, const PoseView& poses, double alert, ContactTable* contacts) {
    const std::vector<Twist> velocity(poses.id.size());
    whole->Commit({poses.id, poses.pose, velocity, {}, {}});
    whole->DetectContacts(poses, alert, contacts);
  };
  return fault;
}

Fault LosesCommits() {
  Fault fault;
  fault.name = "Commit does nothing";
  fault.commit = [](PlatformAdapter*, const StepResult&) {};
  return fault;
}

Fault LosesVelocities() {
  Fault fault;
  fault.name = "Commit forgets velocities";
  fault.commit = [](PlatformAdapter* whole, const StepResult& result) {
    const std::vector<Twist> rest(result.id.size());
    whole->Commit({result.id, result.pose, rest, result.key, result.impulse});
  };
  return fault;
}

Fault KeepsItsOwnCopy() {
  std::size_t reads = 0;
  BodyTable first;
  return SpoilBodies("poses from a copy of its own", [reads, first](BodyTable* bodies) mutable {
    if (reads++ == 0) first = *bodies;
    if (bodies->size() == first.size()) bodies->pose = first.pose;
  });
}

Fault SharesItsState() {
  auto shared = std::make_shared<BodyTable>();
  return SpoilBodies("state that all instances share", [shared](BodyTable* bodies) {
    if (shared->size() == 0) *shared = *bodies;
    *bodies = *shared;
  });
}

}  // namespace

std::vector<Check> HostChecks() {
  return {
      {"detects_at_given_poses",
       "contacts are those at the given poses, and the host stays as it is",
       DetectsAtGivenPoses,
       {DetectsAtOwnPoses(), DetectionMovesTheHost()}},
      {"commit_visible",
       "the host and the next reading show what was committed",
       CommitVisible,
       {LosesCommits(), LosesVelocities()}},
      {"host_edits_adopted", "moved, added and removed bodies of the host's user count", HostEditsAdopted, {KeepsItsOwnCopy()}},
      {"two_instances", "two worlds know nothing of each other", TwoInstances, {SharesItsState()}},
  };
}

}  // namespace nscdd::conformance

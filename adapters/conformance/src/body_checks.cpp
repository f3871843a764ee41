// SPDX-License-Identifier: Apache-2.0
// Who the bodies are: description, ids, mass properties, loads, prescribed motion.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "check.h"
#include "scenes.h"

namespace nscdd::conformance {
namespace {

bool Near(double value, double expected, double relative, double absolute) {
  return std::abs(value - expected) <= relative * std::abs(expected) + absolute;
}

void RequireNear(double value, double expected, double relative, const char* what, std::int64_t id) {
  Require(Near(value, expected, relative, relative), "{} of body {} is {}, expected {}", what, id, value, expected);
}

void Description(Trial* trial) {
  Session session = trial->NewSession();
  const AdapterDescription first = session.adapter().Describe();
  Require(!first.name.empty() && !first.version.empty(), "Describe() gives no name or no version");
  Require(std::none_of(first.name.begin(), first.name.end(), [](unsigned char c) { return std::isupper(c) != 0; }),
          "the name \"{}\" has capitals", first.name);
  Require(first.distributed_bodies == (session.adapter().transport() != nullptr),
          "distributed_bodies is {}, yet transport() is {}", first.distributed_bodies,
          session.adapter().transport() == nullptr ? "null" : "not null");
  Require(first.period == 0.0, "a world without periodicity declares the period {}", first.period);
  AddRandomDisks(3, {0.0, 0.0}, 4.0, &session, &trial->random);
  session.Read();
  const AdapterDescription again = session.adapter().Describe();
  Require(again.name == first.name && again.version == first.version && again.clusters == first.clusters &&
              again.distributed_bodies == first.distributed_bodies && again.prescribed_motion == first.prescribed_motion,
          "Describe() changed after a body was added");
}

void IdsStable(Trial* trial) {
  Session session = trial->NewSession();
  Require(session.Read().size() == 0, "a fresh world has bodies");
  const std::vector<DiskSpec> specs = AddRandomDisks(12, {0.0, 0.0}, 9.0, &session, &trial->random);
  const auto require_same = [&](std::size_t count) {
    const BodyTable bodies = session.Read();
    Require(bodies.size() == count, "ReadBodies gives {} bodies, the world has {}", bodies.size(), count);
    const std::set<std::int64_t> ids(bodies.id.begin(), bodies.id.end());
    Require(ids.size() == count && *ids.begin() >= 0, "ids are repeated or negative");
    for (const DiskSpec& spec : specs) {
      const std::size_t row = RowOf(bodies, spec.id);
      Require(bodies.radius[row] == spec.radius, "body {} has the radius of another one", spec.id);
    }
    return bodies;
  };
  BodyTable bodies = require_same(12);
  for (Pose& pose : bodies.pose) pose.x += 0.125;
  session.Commit(bodies);
  require_same(12);
  DiskSpec late;
  late.id = 5;  // smaller than all of them
  late.centre = {-7.0, 0.0};
  session.host().AddDisk(late);
  require_same(13);
}

void BodiesRoundTrip(Trial* trial) {
  Session session = trial->NewSession();
  const double precision = 1e-14 + 8.0 * session.host().precision();
  for (const DiskSpec& spec : AddRandomDisks(10, {-4.0, 2.0}, 9.0, &session, &trial->random)) {
    const BodyTable bodies = session.Read();
    const std::size_t row = RowOf(bodies, spec.id);
    Require(bodies.kind[row] == spec.kind, "body {} has another kind than it was given", spec.id);
    Require(bodies.radius[row] == spec.radius, "body {} has radius {}, not {}", spec.id, bodies.radius[row], spec.radius);
    Require(bodies.bounding_radius[row] >= spec.radius, "body {} is larger than its bounding radius {}", spec.id,
            bodies.bounding_radius[row]);
    RequireNear(bodies.pose[row].x, spec.centre.x, precision, "x", spec.id);
    RequireNear(bodies.pose[row].y, spec.centre.y, precision, "y", spec.id);
    if (spec.kind == BodyKind::kPrescribed) continue;
    const double mass = std::numbers::pi * spec.radius * spec.radius * spec.density;
    RequireNear(bodies.mass[row], mass, precision, "mass", spec.id);
    RequireNear(bodies.inertia[row], 0.5 * mass * spec.radius * spec.radius, precision, "inertia", spec.id);
  }
  DiskSpec moving;
  moving.id = 1000;
  moving.centre = {20.0, 0.0};
  moving.velocity = {1.5, -0.25, 3.0};
  moving.id = session.host().AddDisk(moving);
  const BodyTable bodies = session.Read();
  const Twist v = bodies.velocity[RowOf(bodies, moving.id)];
  Require(v.vx == 1.5 && v.vy == -0.25 && v.spin == 3.0, "body {} has the velocity ({}, {}, {}), not (1.5, -0.25, 3)",
          moving.id, v.vx, v.vy, v.spin);
}

void ClustersRoundTrip(Trial* trial) {
  Session session = trial->NewSession();
  if (!session.adapter().Describe().clusters) throw CheckSkipped("the adapter does not declare clusters");
  ClusterSpec spec;
  spec.id = 7;
  spec.disks = {{{3.0, 1.0}, 0.5}, {{4.0, 1.0}, 0.75}, {{3.5, 2.0}, 0.25}};
  const std::optional<std::int64_t> id = session.host().AddCluster(spec);
  Require(id.has_value(), "the adapter declares clusters, yet the host adds none");
  double mass = 0.0, inertia = 0.0;
  Vec2 moment;
  for (const auto& member : spec.disks) {
    const double part = std::numbers::pi * member.radius * member.radius;
    mass += part;
    moment = moment + part * member.centre;
  }
  const Vec2 centre = (1.0 / mass) * moment;
  for (const auto& member : spec.disks) {
    const Vec2 arm = member.centre - centre;
    inertia += std::numbers::pi * member.radius * member.radius * (0.5 * member.radius * member.radius + Dot(arm, arm));
  }
  const double precision = 1e-14 + 32.0 * session.host().precision();
  const BodyTable bodies = session.Read();
  const std::size_t row = RowOf(bodies, *id);
  RequireNear(bodies.mass[row], mass, precision, "mass", *id);
  RequireNear(bodies.inertia[row], inertia, 2.0 * precision, "inertia about the centre of mass", *id);
  RequireNear(bodies.pose[row].x, centre.x, precision, "x of the centre of mass", *id);
  RequireNear(bodies.pose[row].y, centre.y, precision, "y of the centre of mass", *id);
  RequireNear(bodies.radius[row], 0.75, precision, "radius of the largest disk", *id);
  for (const auto& member : spec.disks) {
    const double extent = Norm(member.centre - centre) + member.radius;
    Require(bodies.bounding_radius[row] >= extent * (1.0 - precision),
            "a disk of body {} reaches {} m, beyond the bounding radius {}", *id, extent, bodies.bounding_radius[row]);
  }
}

void Loads(Trial* trial) {
  Session session = trial->NewSession();
  session.host().SetGravity({1.5, -9.75});
  const std::vector<DiskSpec> specs = AddRandomDisks(6, {0.0, 0.0}, 9.0, &session, &trial->random);
  const auto require_gravity = [&](Vec2 g) {
    const BodyTable bodies = session.Read();
    for (const DiskSpec& spec : specs) {
      const std::size_t row = RowOf(bodies, spec.id);
      if (spec.kind == BodyKind::kPrescribed) continue;
      const double m = bodies.mass[row], precision = 1e-14 + 8.0 * session.host().precision();
      RequireNear(bodies.force[row].fx, m * g.x, precision, "force x", spec.id);
      RequireNear(bodies.force[row].fy, m * g.y, precision, "force y", spec.id);
      Require(bodies.force[row].torque == 0.0, "gravity turns body {}", spec.id);
    }
  };
  require_gravity({1.5, -9.75});
  session.host().SetGravity({0.0, -2.0});
  require_gravity({0.0, -2.0});
}

void PrescribedMotion(Trial* trial) {
  Session session = trial->NewSession();
  if (!session.adapter().Describe().prescribed_motion) throw CheckSkipped("the adapter does not declare prescribed motion");
  DiskSpec spec;
  spec.id = 4;
  spec.kind = BodyKind::kPrescribed;
  spec.velocity = {0.5, -1.0, 2.0};
  const std::int64_t id = session.host().AddDisk(spec);
  session.host().SetGravity({0.0, -8.0});
  for (int step = 0; step < 3; ++step) {
    BodyTable bodies = session.Read();
    const std::size_t row = RowOf(bodies, id);
    const Twist v = bodies.velocity[row];
    Require(bodies.kind[row] == BodyKind::kPrescribed, "body {} is not prescribed", id);
    Require(v.vx == 0.5 && v.vy == -1.0 && v.spin == 2.0, "prescribed body {} has the velocity ({}, {}, {}), not (0.5, -1, 2)",
            id, v.vx, v.vy, v.spin);
    bodies.pose[row] = {0.125 * (step + 1), -0.25 * (step + 1), 0.5 * (step + 1)};
    session.Commit(bodies);
    const Pose q = session.Read().pose[row];
    Require(q.x == 0.125 * (step + 1) && q.angle == 0.5 * (step + 1), "prescribed body {} did not take its committed pose", id);
  }
}

Fault RenumberAfterFirstRead() {
  int reads = 0;
  return SpoilBodies("ids change from read to read", [reads](BodyTable* bodies) mutable {
    if (++reads > 2) std::rotate(bodies->radius.begin(), bodies->radius.begin() + 1, bodies->radius.end());
  });
}

Fault WrongName() {
  Fault fault;
  fault.name = "no name";
  fault.describe = [](const PlatformAdapter& whole) {
    AdapterDescription description = whole.Describe();
    description.name.clear();
    return description;
  };
  return fault;
}

Fault FalseCapability() {
  Fault fault;
  fault.name = "declares the opposite of what transport() says";
  fault.describe = [](const PlatformAdapter& whole) {
    AdapterDescription description = whole.Describe();
    description.distributed_bodies = !description.distributed_bodies;
    return description;
  };
  return fault;
}

void ShiftAll(std::vector<double>* column, double factor) {
  for (double& value : *column) value *= factor;
}

}  // namespace

std::vector<Check> BodyChecks() {
  return {
      {"description", "name, version and capabilities are there and constant", Description, {WrongName(), FalseCapability()}},
      {"ids_stable",
       "ids are unique and keep their bodies",
       IdsStable,
       {RenumberAfterFirstRead(), SpoilBodies("one id twice",
                                              [](BodyTable* b) {
                                                if (b->size() > 1) b->id[1] = b->id[0];
                                              })}},
      {"bodies_round_trip",
       "mass, inertia, radius, pose and velocity are those that were given",
       BodiesRoundTrip,
       {SpoilBodies("mass of a square", [](BodyTable* b) { ShiftAll(&b->mass, 4.0 / std::numbers::pi); }),
        SpoilBodies("inertia of a hoop", [](BodyTable* b) { ShiftAll(&b->inertia, 2.0); }),
        SpoilBodies("velocity lost", [](BodyTable* b) { b->velocity.assign(b->size(), {}); })}},
      {"clusters_round_trip",
       "a cluster has its mass, its centre of mass and its inertia about it",
       ClustersRoundTrip,
       {SpoilBodies("inertia about another point", [](BodyTable* b) { b->inertia[0] += b->mass[0] * 0.01; }),
        SpoilBodies("centre of the first disk",
                    [](BodyTable* b) {
                      b->pose[0] = {3.0, 1.0, 0.0};
                    })}},
      {"loads",
       "gravity is in the external loads of free bodies",
       Loads,
       {SpoilBodies("no loads", [](BodyTable* b) { b->force.assign(b->size(), {}); })}},
      {"prescribed_motion",
       "a prescribed body keeps its velocity and takes its committed poses",
       PrescribedMotion,
       {SpoilBodies("walls at rest", [](BodyTable* b) { b->velocity.assign(b->size(), {}); })}},
  };
}

}  // namespace nscdd::conformance

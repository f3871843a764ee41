// SPDX-License-Identifier: Apache-2.0
#include "nscdd/reference/reference_adapter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "body_bytes.h"
#include "contact_detector.h"
#include "nscdd/error.h"

namespace nscdd::reference {
namespace {

double LargestRadius(const Body& body) {
  double radius = 0.0;
  for (const Disk& disk : body.disks) radius = std::max(radius, disk.radius);
  return radius;
}

double BoundingRadius(const Body& body) {
  if (!body.half_planes.empty()) return std::numeric_limits<double>::infinity();
  double radius = 0.0;
  for (const Disk& disk : body.disks) radius = std::max(radius, Norm(disk.centre) + disk.radius);
  for (const Segment& s : body.segments) radius = std::max({radius, Norm(s.a), Norm(s.b)});
  return radius;
}

void CheckResult(const World& world, const StepResult& result) {
  if (result.pose.size() != result.id.size() || result.velocity.size() != result.id.size() ||
      result.impulse.size() != result.key.size()) {
    throw Error(
        fmt::format("Commit got {} ids, {} poses, {} velocities, {} keys and {} impulses: columns must have one length each.",
                    result.id.size(), result.pose.size(), result.velocity.size(), result.key.size(), result.impulse.size()));
  }
  for (std::size_t i = 0; i < result.id.size(); ++i) {
    const Pose& q = result.pose[i];
    const Twist& v = result.velocity[i];
    if (world.Find(result.id[i]) == nullptr) {
      throw Error(fmt::format("Commit names body {}, which the reference world does not hold.", result.id[i]));
    }
    if (!std::isfinite(q.x + q.y + q.angle) || !std::isfinite(v.vx + v.vy + v.spin)) {
      throw Error(
          fmt::format("Commit of body {} at ({}, {}, {}) with velocity ({}, {}, {}) is refused: numbers must be finite.",
                      result.id[i], q.x, q.y, q.angle, v.vx, v.vy, v.spin));
    }
  }
}

}  // namespace

class ReferenceAdapter::Transport final : public BodyTransport {
 public:
  explicit Transport(World* world) : world_(world) {}

  void Pack(std::int64_t id, std::vector<std::byte>* bytes) override {
    const Body* body = world_->Find(id);
    if (body == nullptr) throw Error(fmt::format("Body {} cannot be packed: the reference world does not hold it.", id));
    AppendBytes(*body, bytes);
  }

  void Insert(std::int64_t id, std::span<const std::byte> bytes) override {
    Body body = BodyFromBytes(bytes);
    if (body.id != id) {
      throw Error(fmt::format("Body {} cannot be inserted from the bytes of body {}: pass its own.", id, body.id));
    }
    world_->Add(std::move(body));
  }

  void Remove(std::int64_t id) override { world_->Remove(id); }

 private:
  World* world_;
};

ReferenceAdapter::ReferenceAdapter(World* world)
    : world_(world), transport_(std::make_unique<Transport>(world)), detector_(std::make_unique<ContactDetector>()) {
  if (!(world->period >= 0.0 && std::isfinite(world->period) && std::isfinite(world->period_origin))) {
    throw Error(fmt::format("The reference world's period {} from {} is refused: give a finite length >= 0 in metres.",
                            world->period, world->period_origin));
  }
}

ReferenceAdapter::~ReferenceAdapter() = default;

AdapterDescription ReferenceAdapter::Describe() const {
  return {.name = "reference",
          .version = "1",
          .distributed_bodies = true,
          .prescribed_motion = true,
          .clusters = true,
          .period = world_->period,
          .period_origin = world_->period_origin};
}

void ReferenceAdapter::ReadBodies(BodyTable* bodies) {
  for (const Body& body : world_->bodies()) Validate(body);
  bodies->Resize(world_->size());
  std::size_t row = 0;
  for (const Body& body : world_->bodies()) {
    const double mass = body.kind == BodyKind::kFree ? body.mass : 0.0;
    bodies->id[row] = body.id;
    bodies->kind[row] = body.kind;
    bodies->mass[row] = body.mass;
    bodies->inertia[row] = body.inertia;
    bodies->radius[row] = LargestRadius(body);
    bodies->bounding_radius[row] = BoundingRadius(body);
    bodies->pose[row] = body.pose;
    bodies->velocity[row] = body.velocity;
    bodies->force[row] = {body.force.fx + mass * world_->gravity.x, body.force.fy + mass * world_->gravity.y,
                          body.force.torque};
    ++row;
  }
}

void ReferenceAdapter::DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) {
  detector_->Detect(*world_, poses, alert, contacts);
}

void ReferenceAdapter::SweepContacts(const MotionView& motion, ContactTable* contacts) {
  detector_->Sweep(*world_, motion, contacts);
}

void ReferenceAdapter::Commit(const StepResult& result) {
  CheckResult(*world_, result);
  for (std::size_t i = 0; i < result.id.size(); ++i) {
    Body* body = world_->Find(result.id[i]);
    body->pose = result.pose[i];
    body->velocity = result.velocity[i];
  }
}

BodyTransport* ReferenceAdapter::transport() { return transport_.get(); }

}  // namespace nscdd::reference

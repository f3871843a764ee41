// SPDX-License-Identifier: Apache-2.0
#include "nscdd/box2d/box2d_adapter.h"

#include <box2d/box2d.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "body_bytes.h"
#include "body_store.h"
#include "contact_finder.h"
#include "host_world.h"
#include "nscdd/error.h"
#include "pair_filter.h"

namespace nscdd::box2d {
namespace {

void CheckOptions(const b2World* world, const Box2dOptions& options) {
  if (world == nullptr) throw Error("A Box2dAdapter was made without a b2World: pass the address of yours.");
  if (!(options.metres_per_unit > 0.0 && std::isfinite(options.metres_per_unit))) {
    throw Error(fmt::format("Box2dOptions::metres_per_unit = {} is refused: give a finite length > 0 in metres.",
                            options.metres_per_unit));
  }
  if (!(options.period >= 0.0 && std::isfinite(options.period) && std::isfinite(options.period_origin))) {
    throw Error(fmt::format("Box2dOptions::period = {} from {} is refused: give a finite length >= 0 in metres.",
                            options.period, options.period_origin));
  }
  if (options.period > 0.0 && std::abs(options.period_origin) > 1e9 * options.period) {
    throw Error(
        fmt::format("Box2dOptions::period = {} from {} is refused: rounding swallows the period there, begin it nearer to 0.",
                    options.period, options.period_origin));
  }
}

}  // namespace

class Box2dAdapter::Impl final : public BodyTransport {
 public:
  Impl(b2World* b2world, Box2dOptions given)
      : options(std::move(given)),
        world(b2world),
        host(world, options.metres_per_unit),
        store(world, options.metres_per_unit),
        finder(&store, options.period, options.period_origin) {}

  std::int32_t SlotOf(std::int64_t id, const char* task) const {
    const std::int32_t slot = store.SlotOf(id);
    if (slot < 0) throw Error(fmt::format("{} names body {}, which the b2World does not hold.", task, id));
    return slot;
  }

  /// For the user, who may have destroyed the body a moment ago.
  std::int32_t LivingSlotOf(std::int64_t id, const char* task) {
    store.DropDestroyedIfAny();
    return SlotOf(id, task);
  }

  void Pack(std::int64_t id, std::vector<std::byte>* bytes) override {
    const std::int32_t slot = SlotOf(id, "Pack");
    if (store.record(slot).body->GetJointList() != nullptr) {
      throw Error(
          fmt::format("Body {} has a joint, which cannot go with it to another rank: start one rank, or filter the pair by "
                      "groups (b2Filter::groupIndex).",
                      id));
    }
    AppendBytes(*store.record(slot).body, id, store.ExactOf(slot), store.record(slot).added_load, bytes);
  }

  void Insert(std::int64_t id, std::span<const std::byte> bytes) override {
    host.CheckUnlocked();
    if (store.SlotOf(id) >= 0) throw Error(fmt::format("Body {} cannot be inserted: the b2World holds it already.", id));
    const InsertedBody inserted = MakeBody(bytes, id, world);
    try {
      store.Add(inserted.body, id, inserted.exact);
    } catch (const Error&) {
      world->DestroyBody(inserted.body);
      throw;
    }
    store.record(store.SlotOf(id)).added_load = inserted.added_load;
    has_added_load = true;
  }

  void Remove(std::int64_t id) override {
    host.CheckUnlocked();
    const std::int32_t slot = SlotOf(id, "Remove");
    b2Body* body = store.record(slot).body;
    store.Forget(slot);
    world->DestroyBody(body);
  }

  double Wrapped(double x) const {
    if (options.period == 0.0) return x;
    const double wraps = std::floor((x - options.period_origin) / options.period);
    return wraps == 0.0 ? x : x - wraps * options.period;
  }

  void FillRow(std::size_t row, BodyRecord* record, BodyTable* bodies) const {
    if (record->kind == BodyKind::kFree) record->pose.x = Wrapped(record->pose.x);
    bodies->id[row] = record->id;
    bodies->kind[row] = record->kind;
    bodies->mass[row] = record->mass;
    bodies->inertia[row] = record->inertia;
    bodies->radius[row] = record->radius;
    bodies->bounding_radius[row] = record->bounding_radius;
    bodies->pose[row] = record->pose;
    bodies->velocity[row] = record->velocity;
    bodies->force[row] = record->force;
  }

  /// Also finds the slots of the result's bodies; ids and rows both ascend.
  void CheckResult(const StepResult& result) {
    if (result.pose.size() != result.id.size() || result.velocity.size() != result.id.size() ||
        result.impulse.size() != result.key.size()) {
      throw Error(
          fmt::format("Commit got {} ids, {} poses, {} velocities, {} keys and {} impulses: columns must have one length each.",
                      result.id.size(), result.pose.size(), result.velocity.size(), result.key.size(), result.impulse.size()));
    }
    slots.resize(result.id.size());
    const auto& rows = store.Rows();
    auto row = rows.begin();
    for (std::size_t i = 0; i < result.id.size(); ++i) {
      while (row != rows.end() && row->id < result.id[i]) ++row;
      slots[i] = row != rows.end() && row->id == result.id[i] ? row->slot : SlotOf(result.id[i], "Commit");
      const Pose& q = result.pose[i];
      const Twist& v = result.velocity[i];
      if (std::isfinite(q.x + q.y + q.angle) && std::isfinite(v.vx + v.vy + v.spin)) continue;
      throw Error(
          fmt::format("Commit of body {} at ({}, {}, {}) with velocity ({}, {}, {}) is refused: numbers must be finite.",
                      result.id[i], q.x, q.y, q.angle, v.vx, v.vy, v.spin));
    }
  }

  void CommitBody(std::int32_t slot, Pose pose, const Twist& velocity) {
    const BodyRecord& record = store.record(slot);
    if (record.kind == BodyKind::kFree) pose.x = Wrapped(pose.x);
    const HostMirror before = record.seen;
    store.SetPose(slot, pose);
    store.SetVelocity(slot, velocity);
    const b2Vec2 moved = record.seen.position - before.position;
    double path = moved.Length();
    if (record.seen.angle != before.angle && !record.is_round) {
      const double reach = record.bounding_radius / options.metres_per_unit;
      path += std::abs(record.seen.angle - before.angle) * std::min(reach, 1e3);  // half-planes have no end
    }
    host.AddPath(path, record.shape_count);
  }

  void ClearLoads() {
    if (store.has_native_load() && world->GetAutoClearForces()) world->ClearForces();
    if (!has_added_load) return;
    for (std::size_t slot = 0; slot < store.slot_count(); ++slot) store.record(static_cast<std::int32_t>(slot)).added_load = {};
    has_added_load = false;
  }

  b2Fixture* FixtureOf(std::int64_t body, std::int32_t shape) const {
    const std::int32_t slot = store.SlotOf(body);
    if (slot < 0 || shape < 0 || shape >= store.record(slot).shape_count) {
      throw Error(fmt::format("Commit names shape {} of body {}, which the b2World does not hold.", shape, body));
    }
    return store.shape(store.record(slot).first_shape + shape).fixture;
  }

  void TellImpulses(const StepResult& result) const {
    for (std::size_t i = 0; i < result.key.size(); ++i) {
      const ContactKey& key = result.key[i];
      if (!(result.impulse[i].x > 0.0)) continue;
      options.impulse_listener(
          {key, FixtureOf(key.body_a, key.shape_a), FixtureOf(key.body_b, key.shape_b), result.impulse[i]});
    }
  }

  Box2dOptions options;
  b2World* world;
  HostWorld host;
  BodyStore store;
  PairFilter filter;
  ContactFinder finder;
  bool has_added_load = false;
  std::vector<std::int32_t> slots;  // scratch of Commit
};

Box2dAdapter::Box2dAdapter(b2World* world, Box2dOptions options) {
  CheckOptions(world, options);
  impl_ = std::make_unique<Impl>(world, std::move(options));
}

Box2dAdapter::~Box2dAdapter() = default;

AdapterDescription Box2dAdapter::Describe() const {
  return {.name = "box2d",
          .version = "2.4.1",
          .distributed_bodies = true,
          .prescribed_motion = true,
          .clusters = true,
          .period = impl_->options.period,
          .period_origin = impl_->options.period_origin};
}

void Box2dAdapter::ReadBodies(BodyTable* bodies) {
  impl_->host.CheckUnlocked();
  BodyStore& store = impl_->store;
  store.Sync();
  impl_->filter.Read(impl_->world, store, impl_->options.joints_only_filter);
  store.Refresh(impl_->host.ReadGravity());
  const auto& rows = store.Rows();
  bodies->Resize(rows.size());
  for (std::size_t row = 0; row < rows.size(); ++row) impl_->FillRow(row, &store.record(rows[row].slot), bodies);
}

void Box2dAdapter::DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) {
  impl_->finder.Detect(poses, alert, impl_->filter, contacts);
}

void Box2dAdapter::SweepContacts(const MotionView& motion, ContactTable* contacts) {
  impl_->finder.Sweep(motion, impl_->filter, contacts);
}

void Box2dAdapter::Commit(const StepResult& result) {
  impl_->host.CheckUnlocked();
  impl_->CheckResult(result);
  for (std::size_t i = 0; i < result.id.size(); ++i) {
    impl_->CommitBody(impl_->slots[i], result.pose[i], result.velocity[i]);
  }
  impl_->ClearLoads();
  impl_->host.ForgetMovesIfMany();
  if (impl_->options.impulse_listener) impl_->TellImpulses(result);
}

BodyTransport* Box2dAdapter::transport() { return impl_.get(); }

void Box2dAdapter::Assign(b2Body* body, std::int64_t id, const ExactBody& exact) {
  impl_->host.CheckUnlocked();
  BodyStore& store = impl_->store;
  if (body == nullptr || body->GetWorld() != impl_->world) {
    throw Error(fmt::format("Assign of id {} got a body that is not of the adapter's b2World.", id));
  }
  if (id < 0) throw Error(fmt::format("Assign got the id {}: ids must not be negative.", id));
  if (store.SlotOf(body) >= 0 || store.SlotOf(id) >= 0) store.DropDestroyed();  // one of them may be gone by now
  if (store.SlotOf(body) >= 0) {
    throw Error(
        fmt::format("Assign of id {} comes too late: the body has id {} already. Assign ids before the first ReadBodies that "
                    "sees the body.",
                    id, store.record(store.SlotOf(body)).id));
  }
  if (store.SlotOf(id) >= 0) throw Error(fmt::format("Assign got the id {}, which another body has: ids must be unique.", id));
  store.Add(body, id, exact);
}

b2Body* Box2dAdapter::Find(std::int64_t id) const {
  impl_->store.DropDestroyedIfAny();
  const std::int32_t slot = impl_->store.SlotOf(id);
  return slot < 0 ? nullptr : impl_->store.record(slot).body;
}

std::optional<std::int64_t> Box2dAdapter::IdOf(const b2Body* body) const {
  impl_->store.DropDestroyedIfAny();
  const std::int32_t slot = impl_->store.SlotOf(body);
  return slot < 0 ? std::nullopt : std::optional(impl_->store.record(slot).id);
}

void Box2dAdapter::SetPose(std::int64_t id, const Pose& pose) {
  impl_->host.CheckUnlocked();
  impl_->store.SetPose(impl_->LivingSlotOf(id, "SetPose"), pose);
}

void Box2dAdapter::SetVelocity(std::int64_t id, const Twist& velocity) {
  impl_->host.CheckUnlocked();
  const std::int32_t slot = impl_->LivingSlotOf(id, "SetVelocity");
  if (impl_->store.record(slot).body->GetType() == b2_staticBody) {
    throw Error(fmt::format("Box2D body {} is static and cannot have a velocity: make it kinematic.", id));
  }
  impl_->store.SetVelocity(slot, velocity);
}

void Box2dAdapter::SetGravity(Vec2 gravity) { impl_->host.SetGravity(gravity); }

void Box2dAdapter::AddLoad(std::int64_t id, const Wrench& load) {
  Wrench& sum = impl_->store.record(impl_->LivingSlotOf(id, "AddLoad")).added_load;
  sum = {sum.fx + load.fx, sum.fy + load.fy, sum.torque + load.torque};
  impl_->has_added_load = true;
}

void Box2dAdapter::RefreshWorldContacts() {
  impl_->host.CheckUnlocked();
  impl_->host.RefreshContacts();
}

}  // namespace nscdd::box2d

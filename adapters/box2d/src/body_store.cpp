// SPDX-License-Identifier: Apache-2.0
#include "body_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "nscdd/error.h"

namespace nscdd::box2d {

std::int32_t BodyStore::SlotOf(std::int64_t id) const {
  const auto found = slot_of_id_.find(id);
  return found == slot_of_id_.end() ? -1 : found->second;
}

std::int32_t BodyStore::SlotOf(const b2Body* body) const {
  const auto found = slot_of_body_.find(body);
  return found == slot_of_body_.end() ? -1 : found->second;
}

bool BodyStore::IsUnchanged() const {
  // Box2D lists the newest body first.
  return !is_order_stale_ && walk_.size() == order_.size() &&
         std::equal(walk_.rbegin(), walk_.rend(), order_.begin(), [](const b2Body* a, const Walked& b) { return a == b.body; });
}

bool BodyStore::WalkWorld() {
  walk_.clear();
  walked_count_ = world_->GetBodyCount();
  walked_newest_ = world_->GetBodyList();
  for (b2Body* body = world_->GetBodyList(); body != nullptr; body = body->GetNext()) walk_.push_back(body);
  if (IsUnchanged()) return false;
  std::reverse(walk_.begin(), walk_.end());
  return true;
}

void BodyStore::Sync() {
  if (!WalkWorld()) return;
  ForgetLost();
  for (std::size_t i = order_.size(); i < walk_.size(); ++i) {
    const std::int32_t slot = SlotOf(walk_[i]);
    order_.push_back({walk_[i], slot >= 0 ? slot : NewSlot(walk_[i], next_id_)});
  }
  unwalked_.clear();
  is_order_stale_ = false;
  Rows();
  unused_slots_.insert(unused_slots_.end(), forgotten_slots_.begin(), forgotten_slots_.end());
  forgotten_slots_.clear();
}

void BodyStore::DropDestroyed() {
  if (!WalkWorld()) return;
  ForgetLost();
  is_order_stale_ = true;
}

/// Survivors keep their order in the world's list and new bodies follow them; an address that comes out of order is a new body
/// in old memory. (Undetected: the newest bodies destroyed and as many made at the same addresses; they inherit the ids.)
void BodyStore::ForgetLost() {
  std::vector<Walked> order;
  std::vector<std::int32_t> lost;
  order.reserve(walk_.size());
  auto known = order_.begin();
  for (b2Body* body : walk_) {
    for (; known != order_.end() && record(known->slot).body != body; ++known) lost.push_back(known->slot);
    if (known == order_.end()) break;
    order.push_back(*known++);
  }
  for (; known != order_.end(); ++known) lost.push_back(known->slot);
  order_ = std::move(order);
  if (!unwalked_.empty()) {
    std::unordered_set<const b2Body*> fresh(walk_.begin() + static_cast<std::ptrdiff_t>(order_.size()), walk_.end());
    std::erase_if(unwalked_, [&](std::int32_t slot) {
      const bool is_lost = !fresh.contains(record(slot).body);
      if (is_lost) lost.push_back(slot);
      return is_lost;
    });
  }
  for (const std::int32_t slot : lost) {
    if (record(slot).body != nullptr) Forget(slot);
  }
}

std::int32_t BodyStore::NewSlot(b2Body* body, std::int64_t id) {
  if (id == std::numeric_limits<std::int64_t>::max()) {
    throw Error(
        "A Box2D body cannot have the id 2^63 - 1: the adapter numbers further bodies from the largest id on; give smaller "
        "ids.");
  }
  auto slot = static_cast<std::int32_t>(records_.size());
  if (unused_slots_.empty()) {
    records_.emplace_back();
  } else {
    slot = unused_slots_.back();
    unused_slots_.pop_back();
    record(slot) = BodyRecord{};
  }
  record(slot).body = body;
  record(slot).id = id;
  slot_of_id_[id] = slot;
  slot_of_body_[body] = slot;
  next_id_ = std::max(next_id_, id + 1);
  return slot;
}

void BodyStore::Add(b2Body* body, std::int64_t id, const ExactBody& exact) {
  CheckFixtures(*body, id);
  std::vector<ShapeDraft> drafts = DraftShapes(*body, scale_);
  ApplyExact(exact.shapes, id, &drafts);
  BodyRecord known;
  known.body = body;
  known.id = id;
  AdoptEdits(&known, true);
  known.pose = exact.pose.value_or(known.pose);
  known.velocity = exact.velocity.value_or(known.velocity);
  known.mass = exact.mass.value_or(known.mass);
  known.inertia = exact.inertia.value_or(known.inertia);
  CheckFinite(known);
  const Twist& v = known.velocity;
  if (body->GetType() == b2_staticBody && (v.vx != 0.0 || v.vy != 0.0 || v.spin != 0.0)) {
    throw Error(fmt::format("Box2D body {} is static and cannot have a velocity: make it kinematic.", id));
  }

  WriteMass(known.mass, known.inertia, scale_, body);
  WritePose(known.pose, scale_, body);
  WriteVelocity(known.velocity, scale_, body);
  known.seen = ReadMirror(*body);
  const std::int32_t slot = NewSlot(body, id);
  record(slot) = known;
  StoreShapes(slot, std::move(drafts));
  const Wrench native = NativeLoad(*body, scale_);
  has_native_load_ = has_native_load_ || native.fx != 0.0 || native.fy != 0.0 || native.torque != 0.0;
  unwalked_.push_back(slot);
  is_order_stale_ = true;
}

void BodyStore::Forget(std::int32_t slot) {
  BodyRecord& r = record(slot);
  ReleaseShapes(&r);
  slot_of_id_.erase(r.id);
  const auto by_body = slot_of_body_.find(r.body);
  if (by_body != slot_of_body_.end() && by_body->second == slot) slot_of_body_.erase(by_body);
  r.body = nullptr;
  r.id = -1;
  r.is_enabled = false;
  forgotten_slots_.push_back(slot);
  is_order_stale_ = true;
  are_rows_stale_ = true;
}

const std::vector<BodyStore::Row>& BodyStore::Rows() {
  if (!are_rows_stale_) return rows_;
  const auto is_gone = [this](const Row& row) {
    BodyRecord& r = record(row.slot);
    const bool gone = r.body == nullptr || r.id != row.id || !r.is_enabled;
    if (gone && r.id == row.id) r.is_listed = false;
    return gone;
  };
  std::erase_if(rows_, is_gone);
  std::erase_if(new_rows_, is_gone);
  const auto by_id = [](const Row& a, const Row& b) { return a.id < b.id; };
  std::sort(new_rows_.begin(), new_rows_.end(), by_id);
  const auto old_size = static_cast<std::ptrdiff_t>(rows_.size());
  rows_.insert(rows_.end(), new_rows_.begin(), new_rows_.end());
  std::inplace_merge(rows_.begin(), rows_.begin() + old_size, rows_.end(), by_id);
  new_rows_.clear();
  are_rows_stale_ = false;
  return rows_;
}

void BodyStore::StoreShapes(std::int32_t slot, std::vector<ShapeDraft> drafts) {
  BodyRecord& r = record(slot);
  ReleaseShapes(&r);
  r.kind = KindOf(*r.body);
  r.is_enabled = r.body->IsEnabled();
  r.shape_count = static_cast<std::int32_t>(drafts.size());
  r.first_shape = AllocateShapes(r.shape_count);
  r.radius = r.bounding_radius = 0.0;
  auto index = static_cast<std::size_t>(r.first_shape);
  for (ShapeDraft& draft : drafts) {
    Shape& shape = shapes_[index] = draft.shape;
    shape.body = slot;
    double reach = Norm(shape.centre) + shape.radius;
    for (const Vec2 point : draft.wall.points) reach = std::max(reach, Norm(point));
    if (shape.kind == ShapeKind::kHalfPlane) reach = std::numeric_limits<double>::infinity();
    if (shape.kind != ShapeKind::kNone) r.bounding_radius = std::max(r.bounding_radius, reach);
    if (shape.kind == ShapeKind::kDisk) r.radius = std::max(r.radius, shape.radius);
    if (!draft.wall.normals.empty()) shape.wall = StoreWall(std::move(draft.wall));
    CountDisk(shapes_[index], r.kind, 1);
    changed_shapes_.push_back(static_cast<std::int32_t>(index++));
  }
  const Shape* only = r.shape_count == 1 ? &shapes_[static_cast<std::size_t>(r.first_shape)] : nullptr;
  r.is_round = only != nullptr && only->wall < 0 && only->centre.x == 0.0 && only->centre.y == 0.0;
  r.fingerprint = FingerprintOf(*r.body);
  if (r.is_enabled && !r.is_listed) {
    r.is_listed = true;
    new_rows_.push_back({r.id, slot});
  }
  are_rows_stale_ = true;
}

void BodyStore::ReleaseShapes(BodyRecord* r) {
  if (r->shape_count == 0) return;
  for (std::int32_t i = r->first_shape; i < r->first_shape + r->shape_count; ++i) {
    Shape& shape = shapes_[static_cast<std::size_t>(i)];
    CountDisk(shape, r->kind, -1);
    if (shape.wall >= 0) unused_walls_.push_back(shape.wall);
    shape = Shape{};
    changed_shapes_.push_back(i);
  }
  unused_ranges_[r->shape_count].push_back(r->first_shape);
  r->shape_count = 0;
}

std::int32_t BodyStore::AllocateShapes(std::int32_t count) {
  auto& ranges = unused_ranges_[count];
  auto first = static_cast<std::int32_t>(shapes_.size());
  if (ranges.empty()) {
    shapes_.resize(shapes_.size() + static_cast<std::size_t>(count));
  } else {
    first = ranges.back();
    ranges.pop_back();
  }
  return first;
}

std::int32_t BodyStore::StoreWall(Wall wall) {
  if (unused_walls_.empty()) {
    walls_.push_back(std::move(wall));
    return static_cast<std::int32_t>(walls_.size()) - 1;
  }
  const std::int32_t index = unused_walls_.back();
  unused_walls_.pop_back();
  walls_[static_cast<std::size_t>(index)] = std::move(wall);
  return index;
}

void BodyStore::CountDisk(const Shape& shape, BodyKind kind, int sign) {
  if (shape.kind != ShapeKind::kDisk || kind != BodyKind::kFree) return;
  radius_sum_ += sign * shape.radius;
  disk_count_ += sign;
}

ExactBody BodyStore::ExactOf(std::int32_t slot) const {
  const BodyRecord& r = record(slot);
  ExactBody exact{r.pose, r.velocity, r.mass, r.inertia, {}};
  for (std::int32_t i = r.first_shape; i < r.first_shape + r.shape_count; ++i) {
    exact.shapes.push_back(box2d::ExactOf(shape(i), shape(i).wall >= 0 ? &wall(shape(i).wall) : nullptr));
  }
  return exact;
}

}  // namespace nscdd::box2d

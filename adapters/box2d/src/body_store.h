// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "host_body.h"
#include "nscdd/box2d/exact_body.h"
#include "shape_builder.h"

namespace nscdd::box2d {

/// The double-precision master of one b2Body.
struct BodyRecord {
  b2Body* body = nullptr;  // null: the slot is unused
  std::int64_t id = -1;
  Pose pose;
  Twist velocity;
  double mass = 0.0;
  double inertia = 0.0;
  double radius = 0.0;
  double bounding_radius = 0.0;
  Wrench force;       // as of the last Refresh: gravity, Box2D's own load and added_load
  Wrench added_load;  // by AddLoad, for one step
  HostMirror seen;    // the floats when master and mirror last agreed
  std::uint64_t fingerprint = 0;
  std::int32_t first_shape = 0;
  std::int32_t shape_count = 0;
  BodyKind kind = BodyKind::kFree;
  bool is_round = false;  // one centred disk: looks the same at every angle
  bool is_enabled = false;
  bool is_listed = false;  // has a row, or is about to get one
};

/// The bodies of a b2World under their ids, and their shapes. Slots and shape indices are stable while a body lives and are
/// used again afterwards; rows are in ascending order of id.
class BodyStore {
 public:
  struct Row {
    std::int64_t id;
    std::int32_t slot;
  };

  BodyStore(b2World* world, double scale) : world_(world), scale_(scale) {}

  /// Meets the bodies that the user has made or destroyed since last time.
  void Sync();
  /// The destroyed ones only: no body gets an id.
  void DropDestroyed();
  /// The same where the world's list may have changed since it was walked last: another length, or another newest body.
  void DropDestroyedIfAny() {
    if (world_->GetBodyCount() != walked_count_ || world_->GetBodyList() != walked_newest_) DropDestroyed();
  }
  /// Adopts the user's edits of all bodies and gathers their loads; `gravity` [m/s^2]. Throws Error on what is not modelled.
  void Refresh(Vec2 gravity);
  /// Registers a body under an id and writes what is known exactly into it. Throws Error, and then did nothing.
  void Add(b2Body* body, std::int64_t id, const ExactBody& exact);
  /// Forgets the body; it may be dead already.
  void Forget(std::int32_t slot);

  void SetPose(std::int32_t slot, const Pose& pose);
  void SetVelocity(std::int32_t slot, const Twist& velocity);
  ExactBody ExactOf(std::int32_t slot) const;

  std::int32_t SlotOf(std::int64_t id) const;     ///< -1: none
  std::int32_t SlotOf(const b2Body* body) const;  ///< -1: none
  /// Enabled bodies in ascending order of id.
  const std::vector<Row>& Rows();

  BodyRecord& record(std::int32_t slot) { return records_[static_cast<std::size_t>(slot)]; }
  const BodyRecord& record(std::int32_t slot) const { return records_[static_cast<std::size_t>(slot)]; }
  const Shape& shape(std::int32_t index) const { return shapes_[static_cast<std::size_t>(index)]; }
  const Wall& wall(std::int32_t index) const { return walls_[static_cast<std::size_t>(index)]; }
  std::size_t slot_count() const { return records_.size(); }
  std::size_t shape_count() const { return shapes_.size(); }
  double scale() const { return scale_; }
  bool has_native_load() const { return has_native_load_; }
  /// Mean radius of the disks of free bodies [m], up to rounding; 0 without any.
  double mean_radius() const { return disk_count_ > 0 ? radius_sum_ / static_cast<double>(disk_count_) : 0.0; }

  /// Indices of shapes that were released or made since ClearChanges().
  std::span<const std::int32_t> changed_shapes() const { return changed_shapes_; }
  void ClearChanges() { changed_shapes_.clear(); }

 private:
  struct Walked {
    b2Body* body;
    std::int32_t slot;
  };

  bool IsUnchanged() const;
  bool WalkWorld();
  void ForgetLost();
  std::int32_t NewSlot(b2Body* body, std::int64_t id);
  void RefreshBody(std::int32_t slot, Vec2 gravity);
  void AdoptEdits(BodyRecord* record, bool all) const;
  void CheckFinite(const BodyRecord& record) const;
  void StoreShapes(std::int32_t slot, std::vector<ShapeDraft> drafts);
  void ReleaseShapes(BodyRecord* record);
  std::int32_t AllocateShapes(std::int32_t count);
  std::int32_t StoreWall(Wall wall);
  void CountDisk(const Shape& shape, BodyKind kind, int sign);

  b2World* world_;
  double scale_;
  std::vector<BodyRecord> records_;
  std::vector<std::int32_t> unused_slots_;
  std::vector<std::int32_t> forgotten_slots_;  // unused from the next Sync on, because order_ and rows_ still name them
  std::unordered_map<std::int64_t, std::int32_t> slot_of_id_;
  std::unordered_map<const b2Body*, std::int32_t> slot_of_body_;
  std::int64_t next_id_ = 0;

  std::vector<b2Body*> walk_;      // scratch: the world's list
  std::int32_t walked_count_ = 0;  // what DropDestroyedIfAny() compares with
  const b2Body* walked_newest_ = nullptr;
  std::vector<Walked> order_;           // the world's list at the last Sync, oldest first
  std::vector<std::int32_t> unwalked_;  // slots that Add made since
  bool is_order_stale_ = false;

  std::vector<Row> rows_;
  std::vector<Row> new_rows_;
  bool are_rows_stale_ = false;

  std::vector<Shape> shapes_;
  std::vector<Wall> walls_;
  std::unordered_map<std::int32_t, std::vector<std::int32_t>> unused_ranges_;  // of shapes, by length
  std::vector<std::int32_t> unused_walls_;
  std::vector<std::int32_t> changed_shapes_;
  double radius_sum_ = 0.0;
  std::int64_t disk_count_ = 0;
  bool has_native_load_ = false;
};

}  // namespace nscdd::box2d

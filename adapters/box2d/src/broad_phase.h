// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <box2d/box2d.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "nscdd/vector.h"

namespace nscdd::box2d {

/// Box [m], in coordinates wrapped into the period where the body is free.
struct Box {
  double lower_x, lower_y, upper_x, upper_y;
};

/// Two shapes whose fat boxes overlap when `one` is shifted by `shift` periods.
struct Overlap {
  std::int32_t one;
  std::int32_t other;
  std::int32_t shift;
};

/// Proposes pairs with Box2D's dynamic trees: one of the shapes of free bodies, one of all others, which never ask each other
/// (walls beside walls cost nothing). Trees keep fat boxes, so that a shape is looked at again only when it leaves its own.
///
/// Lengths in the trees are in units of the mean disk radius from the middle of the domain, whatever the world's units, since
/// Box2D fattens by an absolute 0.1; boxes are rounded outwards to float.
class BroadPhase {
 public:
  /// Side of the box of a half-plane, in units: beyond any shape, and Box2D can still add it up.
  static constexpr double kFar = 1e14;

  /// Forgets all shapes and starts new trees.
  void Restart(Vec2 origin, double unit, double period, double period_origin);
  bool has_started() const { return free_ != nullptr; }
  Vec2 origin() const { return origin_; }
  double unit() const { return unit_; }

  /// Makes room for shapes [0, count).
  void Resize(std::size_t count);
  void Remove(std::int32_t shape);
  /// Puts the shape where it is; cheap when it is still inside of its fat box.
  void Update(std::int32_t shape, bool is_free, const Box& box) {
    const b2AABB& fat = fat_[static_cast<std::size_t>(shape)];
    const double inverse = 1.0 / unit_;
    const Box b{(box.lower_x - origin_.x) * inverse, (box.lower_y - origin_.y) * inverse, (box.upper_x - origin_.x) * inverse,
                (box.upper_y - origin_.y) * inverse};
    if (b.lower_x >= fat.lowerBound.x && b.lower_y >= fat.lowerBound.y && b.upper_x <= fat.upperBound.x &&
        b.upper_y <= fat.upperBound.y) {
      return;
    }
    Place(shape, is_free, b);
  }

  /// True if the shape was placed or removed since the last FinishUpdate().
  bool IsTouched(std::int32_t shape) const { return touched_[static_cast<std::size_t>(shape)] != 0; }
  bool is_any_touched() const { return !touched_shapes_.empty(); }
  /// All overlaps with at least one touched shape, each once, in no particular order.
  std::span<const Overlap> FindOverlaps();
  void FinishUpdate();

 private:
  struct Proxy {
    std::int32_t id = -1;
    bool is_free = false;
  };

  void Place(std::int32_t shape, bool is_free, const Box& box);
  void Touch(std::int32_t shape);
  void AskFree(std::int32_t shape);
  void AskWall(std::int32_t shape);
  void Query(const b2DynamicTree& tree, std::int32_t shape, bool partner_is_wall, std::int32_t shift);

  Vec2 origin_;
  double unit_ = 1.0;
  double period_ = 0.0;  // in tree units, as the next two
  double period_begin_ = 0.0;
  double widest_ = 0.0;       // width of the widest fat box of a free shape
  double walls_begin_ = 0.0;  // extent in x of fat boxes of walls shorter than a period
  double walls_end_ = 0.0;
  std::unique_ptr<b2DynamicTree> free_;
  std::unique_ptr<b2DynamicTree> walls_;
  std::vector<Proxy> proxies_;
  std::vector<b2AABB> fat_;
  std::vector<std::uint8_t> touched_;
  std::vector<std::int32_t> touched_shapes_;
  std::vector<Overlap> overlaps_;
};

}  // namespace nscdd::box2d

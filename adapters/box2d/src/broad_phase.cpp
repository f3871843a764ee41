// SPDX-License-Identifier: Apache-2.0
#include "broad_phase.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nscdd::box2d {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

float Down(double x) { return std::nextafter(static_cast<float>(x), -kInfinity); }
float Up(double x) { return std::nextafter(static_cast<float>(x), kInfinity); }

bool IsEverywhere(const b2AABB& box) { return box.upperBound.x > 0.5 * BroadPhase::kFar; }

b2AABB RoundOutwards(const Box& box) {
  b2AABB rounded;
  rounded.lowerBound.Set(Down(box.lower_x), Down(box.lower_y));
  rounded.upperBound.Set(Up(box.upper_x), Up(box.upper_y));
  return rounded;
}

/// Contains nothing, so that the first Update() places the shape.
b2AABB Nowhere() {
  b2AABB box;
  box.lowerBound.Set(kInfinity, kInfinity);
  box.upperBound.Set(-kInfinity, -kInfinity);
  return box;
}

void* ToUserData(std::int32_t shape) { return reinterpret_cast<void*>(static_cast<std::intptr_t>(shape)); }
std::int32_t FromUserData(const void* data) { return static_cast<std::int32_t>(reinterpret_cast<std::intptr_t>(data)); }

}  // namespace

void BroadPhase::Restart(Vec2 origin, double unit, double period, double period_origin) {
  origin_ = origin;
  unit_ = unit;
  period_ = period / unit;
  period_begin_ = (period_origin - origin.x) / unit;
  widest_ = 0.0;
  walls_begin_ = std::numeric_limits<double>::infinity();
  walls_end_ = -walls_begin_;
  free_ = std::make_unique<b2DynamicTree>();
  walls_ = std::make_unique<b2DynamicTree>();
  proxies_.clear();
  fat_.clear();
  touched_.clear();
  touched_shapes_.clear();
}

void BroadPhase::Resize(std::size_t count) {
  proxies_.resize(count);
  fat_.resize(count, Nowhere());
  touched_.resize(count);
}

void BroadPhase::Touch(std::int32_t shape) {
  std::uint8_t& touched = touched_[static_cast<std::size_t>(shape)];
  if (touched == 0) touched_shapes_.push_back(shape);
  touched = 1;
}

void BroadPhase::Remove(std::int32_t shape) {
  Proxy& proxy = proxies_[static_cast<std::size_t>(shape)];
  if (proxy.id < 0) return;
  (proxy.is_free ? *free_ : *walls_).DestroyProxy(proxy.id);
  proxy.id = -1;
  fat_[static_cast<std::size_t>(shape)] = Nowhere();
  Touch(shape);
}

void BroadPhase::Place(std::int32_t shape, bool is_free, const Box& box) {
  Proxy& proxy = proxies_[static_cast<std::size_t>(shape)];
  b2DynamicTree& tree = is_free ? *free_ : *walls_;
  const b2AABB rounded = RoundOutwards(box);
  if (proxy.id < 0) {
    proxy = {tree.CreateProxy(rounded, ToUserData(shape)), is_free};
  } else {
    tree.MoveProxy(proxy.id, rounded, {0.0f, 0.0f});
  }
  const b2AABB& fat = fat_[static_cast<std::size_t>(shape)] = tree.GetFatAABB(proxy.id);
  const double width = static_cast<double>(fat.upperBound.x) - fat.lowerBound.x;
  if (is_free) {
    widest_ = std::max(widest_, width);
  } else if (!IsEverywhere(fat)) {
    walls_begin_ = std::min<double>(walls_begin_, fat.lowerBound.x);
    walls_end_ = std::max<double>(walls_end_, fat.upperBound.x);
  }
  Touch(shape);
}

std::span<const Overlap> BroadPhase::FindOverlaps() {
  overlaps_.clear();
  for (const std::int32_t shape : touched_shapes_) {
    const Proxy& proxy = proxies_[static_cast<std::size_t>(shape)];
    if (proxy.id < 0) continue;
    proxy.is_free ? AskFree(shape) : AskWall(shape);
  }
  return overlaps_;
}

void BroadPhase::FinishUpdate() {
  for (const std::int32_t shape : touched_shapes_) touched_[static_cast<std::size_t>(shape)] = 0;
  touched_shapes_.clear();
}

void BroadPhase::AskFree(std::int32_t shape) {
  Query(*free_, shape, false, 0);
  Query(*walls_, shape, true, 0);
  if (period_ == 0.0) return;
  const b2AABB& fat = fat_[static_cast<std::size_t>(shape)];
  // Centres are in the period, so boxes stick out of it by their width at most.
  if (fat.lowerBound.x <= period_begin_ + widest_) Query(*free_, shape, false, 1);
  if (fat.upperBound.x >= period_begin_ + period_ - widest_) Query(*free_, shape, false, -1);
  if (!(walls_begin_ <= walls_end_)) return;
  const auto first = static_cast<std::int32_t>(std::floor((walls_begin_ - fat.upperBound.x) / period_));
  const auto last = static_cast<std::int32_t>(std::ceil((walls_end_ - fat.lowerBound.x) / period_));
  for (std::int32_t shift = first; shift <= last; ++shift) {
    if (shift != 0) Query(*walls_, shape, true, shift);
  }
}

void BroadPhase::AskWall(std::int32_t shape) {
  Query(*free_, shape, false, 0);
  const b2AABB& fat = fat_[static_cast<std::size_t>(shape)];
  if (period_ == 0.0 || IsEverywhere(fat)) return;
  const auto first = static_cast<std::int32_t>(std::floor((period_begin_ - widest_ - fat.upperBound.x) / period_));
  const auto last = static_cast<std::int32_t>(std::ceil((period_begin_ + period_ + widest_ - fat.lowerBound.x) / period_));
  for (std::int32_t shift = first; shift <= last; ++shift) {
    if (shift != 0) Query(*free_, shape, false, shift);
  }
}

void BroadPhase::Query(const b2DynamicTree& tree, std::int32_t shape, bool partner_is_wall, std::int32_t shift) {
  struct Callback {
    bool QueryCallback(std::int32_t proxy) {
      const std::int32_t other = FromUserData(tree.GetUserData(proxy));
      // Between shapes of free bodies both ask when both are touched, and a touched free shape has asked a touched wall.
      const bool is_twice = !partner_is_wall && self->IsTouched(other) && (!asker_is_free || other <= shape);
      const bool is_everywhere = partner_is_wall && IsEverywhere(self->fat_[static_cast<std::size_t>(other)]);
      if (!is_twice && !(shift != 0 && is_everywhere)) self->overlaps_.push_back({shape, other, shift});
      return true;
    }
    BroadPhase* self;
    const b2DynamicTree& tree;
    std::int32_t shape, shift;
    bool asker_is_free, partner_is_wall;
  };
  b2AABB box = fat_[static_cast<std::size_t>(shape)];
  if (shift != 0) {
    box.lowerBound.x = Down(box.lowerBound.x + shift * period_);
    box.upperBound.x = Up(box.upperBound.x + shift * period_);
  }
  Callback callback{this, tree, shape, shift, proxies_[static_cast<std::size_t>(shape)].is_free, partner_is_wall};
  tree.Query(&callback, box);
}

}  // namespace nscdd::box2d

// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/box2d_surface.h"

#include <algorithm>
#include <vector>

namespace nscdd {
namespace {

/// Leaves the rows with a gap up to `alert`, in order.
void KeepWithin(double alert, ContactTable* t) {
  const std::vector<double> gap = t->gap;
  const auto keep = [&](auto* column) {
    if (column->empty()) return;  // optional
    std::size_t kept = 0;
    for (std::size_t c = 0; c < gap.size(); ++c) {
      if (gap[c] <= alert) (*column)[kept++] = (*column)[c];
    }
    column->resize(kept);
  };
  for (auto* column : {&t->a, &t->b, &t->shape_a, &t->shape_b, &t->image}) keep(column);
  for (auto* column : {&t->gap, &t->lever_a, &t->lever_b, &t->friction, &t->restitution}) keep(column);
  for (auto* column : {&t->normal, &t->arm_a, &t->arm_b, &t->site}) keep(column);
  keep(&t->flat);
}

}  // namespace

Box2dSurface::Box2dSurface(PlatformAdapter* adapter, std::map<ShapeName, double> skins)
    : adapter_(adapter), skins_(std::move(skins)) {
  for (const auto& [shape, skin] : skins_) thickest_ = std::max(thickest_, skin);
}

double Box2dSurface::SkinOf(std::int64_t id, std::int32_t shape) const {
  const auto at = skins_.find({id, shape});
  return at == skins_.end() ? 0.0 : at->second;
}

void Box2dSurface::DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) {
  adapter_->DetectContacts(poses, alert + thickest_, contacts);
  ContactTable& t = *contacts;
  for (std::size_t c = 0; c < t.size(); ++c) {
    const double a = SkinOf(poses.id[t.a[c]], t.shape_a[c]), b = SkinOf(poses.id[t.b[c]], t.shape_b[c]);
    if (a + b == 0.0) continue;
    const double drawn = t.gap[c];
    t.gap[c] -= a + b;
    // The wall's lever was 0, the disk's r + drawn.
    const double half = 0.5 * t.gap[c];
    t.lever_a[c] = a > 0.0 ? a + half : t.lever_a[c] - drawn + half;
    t.lever_b[c] = b > 0.0 ? b + half : t.lever_b[c] - drawn + half;
  }
  KeepWithin(alert, contacts);
}

}  // namespace nscdd

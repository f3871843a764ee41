// SPDX-License-Identifier: Apache-2.0
#include "stepping/contact_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nscdd/error.h"

namespace nscdd {
namespace {

template <class... Arguments>
[[noreturn]] void Refuse(const AdapterDescription& adapter, const char* function, fmt::format_string<Arguments...> text,
                         Arguments&&... arguments) {
  throw Error(
      fmt::format("adapter '{}', {}: {}", adapter.name, function, fmt::format(text, std::forward<Arguments>(arguments)...)));
}

bool IsFinite(const Pose& q) { return std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.angle); }
bool IsFinite(const Twist& v) { return std::isfinite(v.vx) && std::isfinite(v.vy) && std::isfinite(v.spin); }
bool IsFinite(const Wrench& f) { return std::isfinite(f.fx) && std::isfinite(f.fy) && std::isfinite(f.torque); }
bool IsPositive(double x) { return std::isfinite(x) && x > 0.0; }

}  // namespace

void CheckPeriod(const AdapterDescription& adapter) {
  if (std::abs(adapter.period_origin) <= 1e9 * adapter.period || adapter.period == 0.0) return;
  Refuse(adapter, "Describe", "the period of {} m begins at {} m, where rounding swallows it; begin it nearer to 0",
         adapter.period, adapter.period_origin);
}

void CheckBodies(const BodyTable& t, const AdapterDescription& adapter) {
  const auto refuse = [&](std::size_t i, const char* what) { Refuse(adapter, "ReadBodies", "body {} has {}", t.id[i], what); };
  const std::size_t n = t.size();
  if (t.kind.size() != n || t.mass.size() != n || t.inertia.size() != n || t.radius.size() != n ||
      t.bounding_radius.size() != n || t.pose.size() != n || t.velocity.size() != n || t.force.size() != n) {
    Refuse(adapter, "ReadBodies", "the columns of the body table differ in length ({} ids); give every body one entry in each",
           n);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (t.id[i] < 0) refuse(i, "a negative id; ids are 0 or more");
    if (!IsFinite(t.pose[i])) refuse(i, "a position or angle that is not finite");
    if (!IsFinite(t.velocity[i])) refuse(i, "a velocity or spin that is not finite");
    if (!(t.radius[i] >= 0.0) || !std::isfinite(t.radius[i]) || !(t.bounding_radius[i] >= t.radius[i])) {
      refuse(i, "a radius that is negative or not finite, or a bounding radius below it");
    }
    // Of prescribed bodies mass, inertia and load are not read.
    if (t.kind[i] != BodyKind::kFree) {
      const Twist& v = t.velocity[i];
      if (!adapter.prescribed_motion && (v.vx != 0.0 || v.vy != 0.0 || v.spin != 0.0)) {
        refuse(i, "a prescribed velocity, but the adapter does not declare prescribed_motion");
      }
      continue;
    }
    if (!IsPositive(t.mass[i])) refuse(i, "a mass that is not positive and finite");
    if (!IsPositive(t.inertia[i])) refuse(i, "an inertia that is not positive and finite");
    if (!IsFinite(t.force[i])) refuse(i, "a force or torque that is not finite");
    if (!std::isfinite(t.bounding_radius[i])) refuse(i, "an infinite bounding radius; only prescribed bodies may");
  }
}

void CheckDrift(const BodyTable& t, double half, const AdapterDescription& adapter) {
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (IsFinite(Moved(t.pose[i], t.velocity[i], half))) continue;
    Refuse(adapter, "ReadBodies", "body {} moves beyond the largest number within {} s; reduce the time step or its velocity",
           t.id[i], half);
  }
}

void CheckMotion(const BodyTable& bodies, std::span<const Twist> motion) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (IsFinite(motion[i])) continue;
    throw Error(fmt::format("the loads make a velocity of body {} that is not finite; nothing was written back", bodies.id[i]));
  }
}

void CheckContacts(const ContactTable& t, const BodyTable& bodies, std::span<const double> reach, const char* function,
                   const AdapterDescription& adapter) {
  const std::size_t n = t.size();
  if (t.a.size() != n || t.b.size() != n || t.shape_a.size() != n || t.shape_b.size() != n || t.normal.size() != n ||
      t.lever_a.size() != n || t.lever_b.size() != n || t.site.size() != n || t.flat.size() != n || t.friction.size() != n ||
      t.restitution.size() != n || t.arm_a.size() != t.arm_b.size() || (t.has_arms() && t.arm_a.size() != n) ||
      (t.has_images() && t.image.size() != n) || (t.has_moments() && t.moment.size() != n)) {
    Refuse(adapter, function, "the columns of the contact table differ in length ({} gaps)", n);
  }
  const auto rows = static_cast<std::int32_t>(bodies.size());
  ContactKey previous;
  for (std::size_t c = 0; c < n; ++c) {
    const std::int32_t a = t.a[c], b = t.b[c];
    if (a < 0 || a >= rows || b < 0 || b >= rows) {
      Refuse(adapter, function, "contact {} refers to rows {} and {} of {} poses", c, a, b, rows);
    }
    const ContactKey key = KeyOf(t, c, bodies.id);
    // From here on bodies have names.
    const auto refuse = [&](const char* what) {
      Refuse(adapter, function, "the contact of bodies {} and {} {}", key.body_a, key.body_b, what);
    };
    if (key.body_a >= key.body_b) refuse("has A and B the wrong way round; the id of A must be the smaller one");
    if (c > 0 && key == previous) refuse("is there twice with the same shapes and image");
    if (c > 0 && key < previous) refuse("is out of order; contacts must be sorted by key");
    if (bodies.kind[a] != BodyKind::kFree && bodies.kind[b] != BodyKind::kFree) refuse("joins two prescribed bodies");
    if (!(std::abs(Dot(t.normal[c], t.normal[c]) - 1.0) < 2e-9)) refuse("has a normal that is not a unit vector");
    const double alert = reach[a] + reach[b];
    if (!std::isfinite(t.gap[c]) || t.gap[c] > alert + 1e-9 * std::max(1.0, alert))
      refuse("has a gap that is not finite or above the alert distance");
    if (!(t.MomentOf(c) >= 0.0 && t.MomentOf(c) <= 1.0)) refuse("has a moment outside [0, 1]");
    if (!std::isfinite(t.lever_a[c]) || !std::isfinite(t.lever_b[c])) refuse("has a lever that is not finite");
    if (!std::isfinite(t.site[c].x) || !std::isfinite(t.site[c].y)) refuse("has a site that is not finite");
    if (!std::isfinite(t.friction[c]) || t.friction[c] < 0.0) refuse("has a friction that is negative or not finite");
    if (!(t.restitution[c] >= 0.0 && t.restitution[c] <= 1.0)) refuse("has a restitution outside [0, 1]");
    if (t.has_arms()) {
      const Vec2 p = t.arm_a[c], q = t.arm_b[c];
      if (!std::isfinite(p.x + p.y + q.x + q.y)) refuse("has an arm that is not finite");
      const bool free_arm = (bodies.kind[a] == BodyKind::kFree && (p.x != 0.0 || p.y != 0.0)) ||
                            (bodies.kind[b] == BodyKind::kFree && (q.x != 0.0 || q.y != 0.0));
      if (free_arm && !adapter.clusters) refuse("has an arm on a free body, but the adapter does not declare clusters");
    }
    previous = key;
  }
}

}  // namespace nscdd

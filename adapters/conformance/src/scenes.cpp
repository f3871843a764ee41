// SPDX-License-Identifier: Apache-2.0
#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "contact_columns.h"

namespace nscdd::conformance {
namespace {

bool Same(const Pose& p, const Pose& q) { return p.x == q.x && p.y == q.y && p.angle == q.angle; }
bool Same(const Twist& v, const Twist& w) { return v.vx == w.vx && v.vy == w.vy && v.spin == w.spin; }

}  // namespace

double Uniform(double low, double high, std::mt19937_64* random) {
  return low + (high - low) * (static_cast<double>((*random)() >> 11) * 0x1p-53);
}

double Dyadic(double low, double high, std::mt19937_64* random) {
  return std::floor(1024.0 * Uniform(low, high, random)) / 1024.0;
}

std::vector<DiskSpec> AddRandomDisks(int count, Vec2 corner, double side, Session* session, std::mt19937_64* random) {
  std::vector<DiskSpec> specs;
  for (int i = 0; i < count; ++i) {
    DiskSpec spec;
    spec.id = 10 + 3 * i;
    spec.kind = i % 5 == 4 ? BodyKind::kPrescribed : BodyKind::kFree;
    spec.centre = corner + Vec2{Dyadic(0.0, side, random), Dyadic(0.0, side, random)};
    spec.radius = Dyadic(0.25, 1.0, random);
    spec.id = session->host().AddDisk(spec);
    specs.push_back(spec);
  }
  return specs;
}

double DiskGap(const BodyTable& bodies, std::size_t a, std::size_t b, double shift) {
  const Vec2 d{bodies.pose[b].x + shift - bodies.pose[a].x, bodies.pose[b].y - bodies.pose[a].y};
  return Norm(d) - bodies.radius[a] - bodies.radius[b];
}

double CoordinateScale(const BodyTable& bodies) {
  double scale = 1.0;
  for (const Pose& pose : bodies.pose) scale = std::max({scale, std::abs(pose.x), std::abs(pose.y)});
  return scale;
}

void RequireAllPairs(const BodyTable& bodies, const ContactTable& contacts, double alert, double period) {
  std::set<ContactKey> found;
  for (std::size_t i = 0; i < contacts.size(); ++i) found.insert(KeyOf(contacts, bodies.id, i));
  const double rounding = 1e-12 * (CoordinateScale(bodies) + period);
  const int images = period > 0.0 ? 3 : 0;
  std::size_t expected = 0;
  for (std::size_t a = 0; a < bodies.size(); ++a) {
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      if (bodies.kind[a] == BodyKind::kPrescribed && bodies.kind[b] == BodyKind::kPrescribed) continue;
      for (int image = -images; image <= images; ++image) {
        const double gap = DiskGap(bodies, a, b, image * period);
        const auto key = found.lower_bound({bodies.id[a], bodies.id[b], INT32_MIN, INT32_MIN, INT32_MIN});
        const bool is_there = std::any_of(key, found.end(), [&](const ContactKey& k) {
          return k.body_a == bodies.id[a] && k.body_b == bodies.id[b] && k.image == image;
        });
        Require(is_there || gap > alert - rounding, "bodies {} and {} (image {}) have the gap {} <= {} and no contact",
                bodies.id[a], bodies.id[b], image, gap, alert);
        Require(!is_there || gap <= alert + rounding, "bodies {} and {} (image {}) have a contact at the gap {} > {}",
                bodies.id[a], bodies.id[b], image, gap, alert);
        expected += is_there ? 1 : 0;
      }
    }
  }
  Require(expected == contacts.size(), "{} contacts are between other bodies than a free disk and a disk, or repeated",
          contacts.size() - expected);
}

void RequireUnchanged(const BodyTable& before, const BodyTable& after, const char* what) {
  Require(before.id == after.id, "{} changed which bodies there are", what);
  for (std::size_t row = 0; row < before.size(); ++row) {
    Require(Same(before.pose[row], after.pose[row]) && Same(before.velocity[row], after.velocity[row]),
            "{} changed the pose or the velocity of body {}", what, before.id[row]);
  }
}

std::optional<std::int64_t> AddHalfPlaneFloor(std::int64_t id, double friction, Session* session) {
  return session->host().AddHalfPlane({id, {0.0, 0.0}, {0.0, 1.0}, friction, 0.0});
}

std::optional<std::int64_t> AddPolylineFloor(std::int64_t id, double friction, Session* session) {
  // Free side to the left: from left to right.
  return session->host().AddPolyline({id, {{-16.0, 0.0}, {-2.0, 0.0}, {16.0, 0.0}}, friction, 0.0});
}

std::optional<std::int64_t> AddDiskFloor(std::int64_t id, double friction, Session* session) {
  DiskSpec spec;
  spec.id = id;
  spec.kind = BodyKind::kPrescribed;
  spec.centre = {0.0, -1.0};
  spec.radius = 1.0;
  spec.friction = friction;
  return session->host().AddDisk(spec);
}

}  // namespace nscdd::conformance

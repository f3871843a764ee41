// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nscdd/vector.h"

namespace nscdd {

/// Names a contact from step to step. body_a < body_b; shapes are numbered by the platform, stable as long as the body
/// lives; `image` k says that body B is seen at x_B + k * period (0 without periodicity).
struct ContactKey {
  std::int64_t body_a = 0;
  std::int64_t body_b = 0;
  std::int32_t shape_a = 0;
  std::int32_t shape_b = 0;
  std::int32_t image = 0;

  auto operator<=>(const ContactKey&) const = default;
};

/// What a contact does, told by its impulse.
enum class ContactStatus : std::uint8_t {
  kOpen = 0,      ///< r_n = 0
  kSticking = 1,  ///< |r_t| < mu r_n, so v_t = 0
  kSliding = 2,   ///< |r_t| = mu r_n; a contact without friction that carries an impulse slides
};

/// The status that (r_n, r_t) says; "active" is every other than open. An impulse that is not a number opens.
inline ContactStatus StatusOf(Vec2 impulse, double friction) {
  if (!(impulse.x > 0.0)) return ContactStatus::kOpen;
  return std::abs(impulse.y) < friction * impulse.x ? ContactStatus::kSticking : ContactStatus::kSliding;
}

/// Candidate contacts at one configuration, or on the bodies' way through a step, as a structure of arrays with one entry per
/// contact.
///
/// Conventions; this is their only statement.
/// - Frame: `normal` n is a unit vector from body A to body B, t = (n_y, -n_x); (t, n) is direct.
/// - Impulse r = (r_n, r_t) [N s] acts on B, -r on A; r_n >= 0 is compression.
/// - Relative velocity v = velocity of B minus velocity of A at the contact, in (n, t) [m/s]; v_n > 0 opens.
/// - gap > 0 when apart, < 0 when the shapes overlap [m].
/// - The impulse acts on A at  c_A + arm_a + lever_a n  and on B at  c_B + arm_b - lever_b n  (c: centres of mass; c_B is
///   shifted by `image` periods). `arm` leads from the centre of mass to the centre of the disk in contact (to the wall's
///   surface or corner, for other shapes); `lever` leads from there to the point along the normal. Hence
///       v_n = n . (V_B - V_A) + (arm_b x n) w_B - (arm_a x n) w_A
///       v_t = t . (V_B - V_A) + (arm_b x t + lever_b) w_B - (arm_a x t - lever_a) w_A
/// - Two disks meet half-way in the gap: lever = radius + gap / 2, so lever_a + lever_b is the distance of their centres
///   and the friction pair has no net moment. A disk and any other wall meet on the wall's surface: disk's lever =
///   radius + gap, wall's lever = 0.
struct ContactTable {
  std::vector<std::int32_t> a;        ///< row of body A in the table of poses that was given to DetectContacts
  std::vector<std::int32_t> b;        ///< row of body B; id[a] < id[b]
  std::vector<std::int32_t> shape_a;  ///< shape in contact of A, see ContactKey
  std::vector<std::int32_t> shape_b;
  std::vector<std::int32_t> image;  ///< empty when the platform is not periodic
  std::vector<double> gap;
  std::vector<Vec2> normal;
  std::vector<double> lever_a;
  std::vector<double> lever_b;
  std::vector<Vec2> arm_a;  ///< both arms empty when all of them are zero
  std::vector<Vec2> arm_b;
  std::vector<Vec2>
      site;  ///< [m] decides the subdomain: mid-point of the two disk centres, else the point on the wall
             ///< (the disk's centre, as B is seen, where that is deeper than its radius behind the wall, or out of reach)
  std::vector<std::uint8_t> flat;  ///< 1: one side is flat here (half-plane, inside of a segment), 0: disks or a corner
  std::vector<double> moment;  ///< part of the step, in [0, 1], that has gone where gap, normal, levers and arms are taken; the
                               ///< site always is at its beginning. Empty when all are zero
  std::vector<double> friction;     ///< Coulomb coefficient >= 0
  std::vector<double> restitution;  ///< Newton coefficient in [0, 1]

  std::size_t size() const { return gap.size(); }
  bool has_arms() const { return !arm_a.empty(); }
  bool has_images() const { return !image.empty(); }
  bool has_moments() const { return !moment.empty(); }
  double MomentOf(std::size_t contact) const { return moment.empty() ? 0.0 : moment[contact]; }

  template <class Function>
  void ForEachColumn(Function&& f) {
    f(a);
    f(b);
    f(shape_a);
    f(shape_b);
    f(image);
    f(gap);
    f(normal);
    f(lever_a);
    f(lever_b);
    f(arm_a);
    f(arm_b);
    f(site);
    f(flat);
    f(moment);
    f(friction);
    f(restitution);
  }

  /// Empties the table and keeps its memory.
  void Clear() {
    ForEachColumn([](auto& column) { column.clear(); });
  }
};

/// Key of row `contact`; `body_id` are the ids of the table of bodies that a and b refer to.
inline ContactKey KeyOf(const ContactTable& t, std::size_t contact, std::span<const std::int64_t> body_id) {
  return {body_id[t.a[contact]], body_id[t.b[contact]], t.shape_a[contact], t.shape_b[contact],
          t.has_images() ? t.image[contact] : 0};
}

}  // namespace nscdd

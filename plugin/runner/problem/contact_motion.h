// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "nscdd/contact_table.h"
#include "nscdd/vector.h"

namespace nscdd {

/// Rows of H^T of one contact, written down from ContactTable's definition:
///     v_n = n . (V_B - V_A) + turn_nb w_B - turn_na w_A,   v_t = t . (V_B - V_A) + turn_tb w_B - turn_ta w_A
class ContactMotion {
 public:
  ContactMotion(const ContactTable& table, std::size_t c) : n_(table.normal[c]), t_{n_.y, -n_.x} {
    turn_ta_ = -table.lever_a[c];
    turn_tb_ = table.lever_b[c];
    if (!table.has_arms()) return;
    turn_na_ = Cross(table.arm_a[c], n_);
    turn_nb_ = Cross(table.arm_b[c], n_);
    turn_ta_ += Cross(table.arm_a[c], t_);
    turn_tb_ += Cross(table.arm_b[c], t_);
  }

  /// (v_n, v_t) [m/s].
  Vec2 Velocity(const Twist& a, const Twist& b) const {
    const Vec2 d = Linear(b) - Linear(a);
    return {Dot(n_, d) + turn_nb_ * b.spin - turn_na_ * a.spin, Dot(t_, d) + turn_tb_ * b.spin - turn_ta_ * a.spin};
  }

  /// Adds H r to the impulses on the two bodies [N s, N m s].
  void Apply(Vec2 r, Wrench* a, Wrench* b) const {
    const Vec2 p = r.x * n_ + r.y * t_;
    *a = {a->fx - p.x, a->fy - p.y, a->torque - turn_na_ * r.x - turn_ta_ * r.y};
    *b = {b->fx + p.x, b->fy + p.y, b->torque + turn_nb_ * r.x + turn_tb_ * r.y};
  }

  /// (W_nn, W_tt) [1/kg] from the inverse masses and inertias.
  Vec2 Delassus(double inverse_mass, double inverse_inertia_a, double inverse_inertia_b) const {
    return {inverse_mass + inverse_inertia_a * turn_na_ * turn_na_ + inverse_inertia_b * turn_nb_ * turn_nb_,
            inverse_mass + inverse_inertia_a * turn_ta_ * turn_ta_ + inverse_inertia_b * turn_tb_ * turn_tb_};
  }

 private:
  Vec2 n_, t_;
  double turn_na_ = 0.0, turn_nb_ = 0.0, turn_ta_ = 0.0, turn_tb_ = 0.0;  // [m]
};

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace nscdd {

/// Plane vector [m], [m/s] or a unit direction, as the user says.
struct Vec2 {
  double x = 0.0;
  double y = 0.0;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
constexpr double Dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// a x b, the out-of-plane component; positive when b is counter-clockwise of a.
constexpr double Cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
/// Of lengths and speeds, whose squares neither overflow nor vanish: no std::hypot.
inline double Norm(Vec2 a) { return std::sqrt(a.x * a.x + a.y * a.y); }
/// `a` turned counter-clockwise by `angle` [rad].
inline Vec2 Rotate(double angle, Vec2 a) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * a.x - s * a.y, s * a.x + c * a.y};
}

/// Configuration of a body: centre of mass [m] and angle [rad], counter-clockwise positive.
struct Pose {
  double x = 0.0;
  double y = 0.0;
  double angle = 0.0;
};

/// Velocity of a body: of the centre of mass [m/s] and spin [rad/s].
struct Twist {
  double vx = 0.0;
  double vy = 0.0;
  double spin = 0.0;
};

/// External load on a body: force at the centre of mass [N] and torque [N m].
struct Wrench {
  double fx = 0.0;
  double fy = 0.0;
  double torque = 0.0;
};

/// The pose after `dt` [s] at constant velocity.
constexpr Pose Moved(const Pose& q, const Twist& v, double dt) {
  return {q.x + dt * v.vx, q.y + dt * v.vy, q.angle + dt * v.spin};
}

constexpr Vec2 Centre(const Pose& q) { return {q.x, q.y}; }
constexpr Vec2 Linear(const Twist& v) { return {v.vx, v.vy}; }

}  // namespace nscdd

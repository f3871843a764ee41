// SPDX-License-Identifier: Apache-2.0
#include "scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nscdd::contact_law {

std::int64_t Scene::Add(const Grain& grain) {
  double mass = 0.0, inertia = 0.0;
  for (const Circle& disk : grain.disks) {
    const double m = std::numbers::pi * disk.radius * disk.radius;
    mass += m;
    inertia += m * (0.5 * disk.radius * disk.radius + Dot(disk.centre, disk.centre));
  }
  Build(next_id_, grain, mass, inertia);
  grains_[next_id_] = grain;
  before_[next_id_] = after_[next_id_] = grain.pose;
  velocity_[next_id_] = grain.velocity;
  return next_id_++;
}

std::int64_t Scene::Add(const Wall& wall) {
  Build(next_id_, wall);
  walls_[next_id_] = wall;
  before_[next_id_] = after_[next_id_] = wall.pose;
  velocity_[next_id_] = wall.velocity;
  return next_id_++;
}

const StepReport& Scene::Step(double dt) {
  if (!stepper_) stepper_.emplace(stepping_, algorithm_, adapter(), &communicator_);
  before_ = after_;
  report_ = &stepper_->Step(dt);
  const BodyResults& bodies = stepper_->bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    after_[bodies.id[i]] = bodies.pose[i];
    velocity_[bodies.id[i]] = bodies.velocity[i];
  }
  return *report_;
}

void ReferenceScene::Build(std::int64_t id, const Grain& grain, double mass, double inertia) {
  reference::Body body;
  body.id = id;
  body.mass = mass;
  body.inertia = inertia;
  body.pose = grain.pose;
  body.velocity = grain.velocity;
  for (const Circle& disk : grain.disks) body.disks.push_back({disk.centre, disk.radius});
  body.friction = grain.material.friction;
  body.restitution = grain.material.restitution;
  world_.Add(body);
}

void ReferenceScene::Build(std::int64_t id, const Wall& wall) {
  reference::Body body = reference::MakeWall(id, wall.pose);
  body.velocity = wall.velocity;
  for (const Circle& disk : wall.disks) body.disks.push_back({disk.centre, disk.radius});
  for (const Line& line : wall.lines) body.segments.push_back({line.a, line.b});
  for (const Plane& plane : wall.planes) body.half_planes.push_back({plane.normal, plane.offset});
  body.friction = wall.material.friction;
  body.restitution = wall.material.restitution;
  world_.Add(body);
}

b2Body* Box2dScene::MakeBody(b2BodyType type, const Pose& pose, const Twist& velocity) {
  b2BodyDef def;
  def.type = type;
  def.position = Units(Centre(pose));
  def.angle = static_cast<float>(pose.angle);
  def.linearVelocity = Units(Linear(velocity));
  def.angularVelocity = static_cast<float>(velocity.spin);
  return world_.CreateBody(&def);
}

template <class Geometry>
void Box2dScene::AddShape(const b2Shape& shape, const Geometry& geometry, const Material& material, b2Body* body,
                          box2d::ExactBody* exact) {
  b2FixtureDef fixture;
  fixture.shape = &shape;
  fixture.density = 1.0F;
  fixture.friction = static_cast<float>(material.friction);
  fixture.restitution = static_cast<float>(material.restitution);
  body->CreateFixture(&fixture);
  exact->shapes.push_back({geometry, material.friction, material.restitution});
}

void Box2dScene::AddCircles(const std::vector<Circle>& circles, const Material& material, b2Body* body,
                            box2d::ExactBody* exact) {
  for (const Circle& disk : circles) {
    b2CircleShape circle;
    circle.m_p = Units(disk.centre);
    circle.m_radius = static_cast<float>(disk.radius / unit_);
    AddShape(circle, box2d::DiskGeometry{disk.centre, disk.radius}, material, body, exact);
  }
}

void Box2dScene::Build(std::int64_t id, const Grain& grain, double mass, double inertia) {
  b2Body* body = MakeBody(b2_dynamicBody, grain.pose, grain.velocity);
  box2d::ExactBody exact{grain.pose, grain.velocity, mass, inertia, {}};
  AddCircles(grain.disks, grain.material, body, &exact);
  const b2MassData data{static_cast<float>(mass), {0.0F, 0.0F}, static_cast<float>(inertia / (unit_ * unit_))};
  body->SetMassData(&data);
  adapter_.Assign(body, id, exact);
}

void Box2dScene::Build(std::int64_t id, const Wall& wall) {
  const bool moves = wall.velocity.vx != 0.0 || wall.velocity.vy != 0.0 || wall.velocity.spin != 0.0;
  b2Body* body = MakeBody(moves ? b2_kinematicBody : b2_staticBody, wall.pose, wall.velocity);
  box2d::ExactBody exact;
  exact.pose = wall.pose;
  if (moves) exact.velocity = wall.velocity;
  AddCircles(wall.disks, wall.material, body, &exact);
  for (const Line& line : wall.lines) {
    b2EdgeShape edge;
    edge.SetTwoSided(Units(line.a), Units(line.b));
    AddShape(edge, box2d::SegmentGeometry{line.a, line.b}, wall.material, body, &exact);
  }
  for (const Plane& plane : wall.planes) {
    const Vec2 along{plane.normal.y, -plane.normal.x}, foot = plane.offset * plane.normal;
    const double half = 1e5 * unit_;
    b2EdgeShape edge;
    edge.SetTwoSided(Units(foot - half * along), Units(foot + half * along));
    AddShape(edge, box2d::HalfPlaneGeometry{plane.normal, plane.offset}, wall.material, body, &exact);
  }
  for (const Polygon& polygon : wall.polygons) {
    std::vector<b2Vec2> vertices;
    for (const Vec2 vertex : polygon.vertices) vertices.push_back(Units(vertex));
    b2PolygonShape shape;
    shape.Set(vertices.data(), static_cast<int>(vertices.size()));
    AddShape(shape, box2d::PolygonGeometry{polygon.vertices}, wall.material, body, &exact);
  }
  adapter_.Assign(body, id, exact);
}

namespace {

/// Pieces into which a way is cut where somebody turns: then it is curved.
constexpr int kPieces = 64;

/// The way of a point of `grain` in the frame of another body, both from their poses before to those after the step.
template <class Shape>
void JudgeShape(const Circle& disk, const Pose (&grain)[2], const Pose (&other)[2], const Shape& shape, double size,
                const std::string& names, Verdict* verdict) {
  const bool curved = grain[0].angle != grain[1].angle || other[0].angle != other[1].angle;
  const int pieces = curved ? kPieces : 1;
  const auto at = [&](int k) {
    const double t = static_cast<double>(k) / pieces;
    return InFrameOf(Between(other[0], other[1], t), InWorld(Between(grain[0], grain[1], t), disk.centre));
  };
  const double overlap = disk.radius - Distance(at(pieces), shape);
  verdict->depth = std::max(verdict->depth, overlap / size);
  for (int k = 0; k < pieces && verdict->passed.empty(); ++k) {
    if (Passes(at(k), at(k + 1), shape)) verdict->passed = names;
  }
}

}  // namespace

Verdict Judge(const Scene& scene) {
  Verdict verdict;
  const double period = scene.period();
  // Centres are wrapped: a body moves by less than half a period in a step.
  const auto poses = [&](std::int64_t id, Pose(&pair)[2]) {
    pair[0] = scene.before().at(id);
    pair[1] = scene.after().at(id);
    if (period > 0.0) pair[1].x += period * std::round((pair[0].x - pair[1].x) / period);
  };
  // Calls judge() with the other body where it is, and with its images.
  const auto for_images = [&](Pose(&other)[2], const auto& judge) {
    if (period == 0.0) return judge();
    for (Pose& q : other) q.x -= 3.0 * period;
    for (int k = -2; k <= 2; ++k) {
      for (Pose& q : other) q.x += period;
      judge();
    }
  };
  for (const auto& [id, grain] : scene.grains()) {
    Pose own[2];
    poses(id, own);
    verdict.largest_turn = std::max(verdict.largest_turn, std::abs(own[1].angle - own[0].angle));
    for (const Circle& disk : grain.disks) {
      for (const auto& [wall_id, wall] : scene.walls()) {
        Pose other[2];
        poses(wall_id, other);
        const std::string names = fmt::format("body {} through wall {}", id, wall_id);
        const auto judge = [&](const auto& shape) { JudgeShape(disk, own, other, shape, disk.radius, names, &verdict); };
        for_images(other, [&] {
          for (const Line& line : wall.lines) judge(line);
          for (const Plane& plane : wall.planes) judge(plane);
          for (const Polygon& polygon : wall.polygons) judge(polygon);
          for (const Circle& circle : wall.disks) {
            JudgeShape(disk, own, other, circle, std::min(disk.radius, circle.radius), names, &verdict);
          }
        });
      }
      for (const auto& [other_id, other_grain] : scene.grains()) {
        if (other_id <= id) continue;
        Pose other[2];
        poses(other_id, other);
        const std::string names = fmt::format("body {} through body {}", id, other_id);
        for_images(other, [&] {
          for (const Circle& circle : other_grain.disks) {
            // Here a centre that comes within half of the sum of the radii has passed.
            const Circle core{circle.centre, 0.5 * (circle.radius + disk.radius)};
            const Circle point{disk.centre, 0.5 * (circle.radius + disk.radius)};
            JudgeShape(point, own, other, core, std::min(disk.radius, circle.radius), names, &verdict);
          }
        });
      }
    }
  }
  return verdict;
}

}  // namespace nscdd::contact_law

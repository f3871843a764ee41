// SPDX-License-Identifier: Apache-2.0
#include "scene/read_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace nscdd {
namespace {

constexpr double kMostShapes = 1e6;  // of a wall
constexpr std::size_t kMostShapesInAll = 3'000'000;

/// Corners of the wall's line: `points` (with `closed`), or the polygon of `count` corners on `circle`.
struct Line {
  std::vector<Vec2> corners;
  bool closed = false;

  std::size_t legs() const { return closed ? corners.size() : corners.size() - 1; }
  Vec2 end(std::size_t leg) const { return corners[(leg + 1) % corners.size()]; }
};

Line ReadPoints(TableReader* entry) {
  Line line;
  for (const auto& row : entry->Rows("points", 2, "[x, y] [m]", 2)) line.corners.push_back({row[0], row[1]});
  line.closed = entry->Flag("closed", false);
  for (std::size_t leg = 0; leg < line.legs(); ++leg) {
    const double length = Norm(line.end(leg) - line.corners[leg]);
    if (!(length > 0.0 && std::isfinite(length))) {
      entry->Refuse("points", fmt::format("has twice ({}, {}), one behind the other; give different points",
                                          line.corners[leg].x, line.corners[leg].y));
    }
  }
  return line;
}

/// `circle = [x, y, radius]`.
struct Circle {
  Vec2 centre;
  double radius = 0.0;
};

Circle ReadCircle(TableReader* entry) {
  const std::vector<double> numbers = entry->List("circle", 3, "[x, y, radius] [m]");
  if (!(numbers[2] > 0.0))
    entry->Refuse("circle", fmt::format("has radius {}; give [x, y, radius] with radius > 0 [m]", numbers[2]));
  return {{numbers[0], numbers[1]}, numbers[2]};
}

Line Polygon(const Circle& circle, std::int64_t corners) {
  Line line;
  line.closed = true;
  for (std::int64_t k = 0; k < corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
    line.corners.push_back(
        {circle.centre.x + circle.radius * std::cos(angle), circle.centre.y + circle.radius * std::sin(angle)});
  }
  return line;
}

/// Whole number of intervals of about `spacing` in `length`, at least `least`.
std::int64_t Intervals(TableReader* entry, double length, double spacing, double least) {
  const double count = std::max(least, std::round(length / spacing));
  if (count > kMostShapes) entry->Refuse("spacing", fmt::format("puts {} disks on the wall; give a larger one [m]", count));
  return static_cast<std::int64_t>(count);
}

void ReadSegments(TableReader* entry, Wall* wall) {
  const bool round = entry->Has("circle");
  const Line line = round ? Polygon(ReadCircle(entry), entry->Integer("sides", 3, {}, static_cast<std::int64_t>(kMostShapes)))
                          : ReadPoints(entry);
  for (std::size_t leg = 0; leg < line.legs(); ++leg) wall->segments.push_back({line.corners[leg], line.end(leg)});
}

void ReadWallDisks(TableReader* entry, Wall* wall) {
  const double radius = entry->Number("radius", Bound::kPositive, "[m]");
  const double spacing = entry->Number("spacing", Bound::kPositive, "[m]", 2.0 * radius);
  wall->one_body = entry->Flag("one_body", true);
  if (entry->Has("circle")) {
    const Circle circle = ReadCircle(entry);
    const auto count = Intervals(entry, 2.0 * std::numbers::pi * circle.radius, spacing, 3.0);
    for (const Vec2 corner : Polygon(circle, count).corners) wall->disks.push_back({corner, radius});
    return;
  }
  const Line line = ReadPoints(entry);
  for (std::size_t leg = 0; leg < line.legs(); ++leg) {
    const Vec2 begin = line.corners[leg], step = line.end(leg) - begin;
    const auto intervals = Intervals(entry, Norm(step), spacing, 1.0);
    if (static_cast<double>(wall->disks.size()) + static_cast<double>(intervals) > kMostShapes) {
      entry->Refuse("spacing", fmt::format("puts more than {} disks on the wall; give a larger one [m]", kMostShapes));
    }
    for (std::int64_t i = 0; i < intervals; ++i) {
      wall->disks.push_back({begin + (static_cast<double>(i) / static_cast<double>(intervals)) * step, radius});
    }
  }
  if (!line.closed) wall->disks.push_back({line.corners.back(), radius});
}

void ReadHalfPlane(TableReader* entry, const Scene& scene, Wall* wall) {
  const Vec2 point = entry->Vector("point", "[m]");
  const Vec2 normal = entry->Vector("normal", "", Vec2{0.0, 1.0});
  const double length = Norm(normal);
  if (!std::isnormal(length))
    entry->Refuse("normal", fmt::format("is [{}, {}]; give a direction of some length", normal.x, normal.y));
  if (scene.periodic && normal.x != 0.0) {
    entry->Refuse("normal",
                  fmt::format("is [{}, {}] in a scene that is periodic in x; give [0, 1] or [0, -1]", normal.x, normal.y));
  }
  const Vec2 unit{normal.x / length, normal.y / length};
  wall->half_planes.push_back({unit, Dot(unit, point)});
  wall->centre = point;
}

/// Middle of the box around the shapes.
Vec2 Middle(const Wall& wall) {
  std::vector<Vec2> points;
  for (const reference::Disk& disk : wall.disks) points.push_back(disk.centre);
  for (const reference::Segment& segment : wall.segments) points.insert(points.end(), {segment.a, segment.b});
  const auto [left, right] = std::minmax_element(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
  const auto [low, high] = std::minmax_element(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.y < b.y; });
  return {0.5 * (left->x + right->x), 0.5 * (low->y + high->y)};
}

BodySource ReadWall(TableReader* entry, const Scene& scene) {
  BodySource source = ReadSource(entry, scene);
  source.kind = BodyKind::kPrescribed;
  Wall wall;
  const std::string type = entry->Choice("type", {"segments", "half_plane", "disks"});
  if (type == "segments") ReadSegments(entry, &wall);
  if (type == "disks") ReadWallDisks(entry, &wall);
  if (type == "half_plane") ReadHalfPlane(entry, scene, &wall);
  if (type != "half_plane") wall.centre = Middle(wall);
  wall.centre = entry->Vector("centre", "[m]", wall.centre);
  if (!wall.one_body && source.velocity.spin != 0.0) {
    entry->Refuse("spin",
                  "would turn each disk about itself, as one_body = false makes it a body of its own; leave one of them out");
  }
  source.count = wall.one_body ? 1 : static_cast<std::int64_t>(wall.disks.size());
  if (entry->Has("id")) {
    if (!wall.one_body) entry->Refuse("id", "names one body but one_body = false makes several; leave the id out");
    source.id = entry->Integer("id", 0);
  }
  source.what = std::move(wall);
  return source;
}

}  // namespace

void ReadWalls(TableReader* root, Scene* scene) {
  std::size_t shapes = 0;
  for (TableReader& entry : root->Tables("walls")) {
    scene->bodies.push_back(ReadWall(&entry, *scene));
    entry.Finish();
    const auto& wall = std::get<Wall>(scene->bodies.back().what);
    shapes += wall.disks.size() + wall.segments.size();
    if (shapes > kMostShapesInAll) {
      entry.Refuse("type", fmt::format("and the walls before it have more than {} shapes; give fewer", kMostShapesInAll));
    }
  }
}

}  // namespace nscdd

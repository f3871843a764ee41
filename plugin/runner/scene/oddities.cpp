// SPDX-License-Identifier: Apache-2.0
#include "scene/read_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "scene/body_stream.h"

namespace nscdd {
namespace {

constexpr std::int64_t kMostBodies = 10'000'000;
// Metres written as millimetres, or the other way round, are off by 1000; packings, their walls and their mixtures of sizes
// keep well below these ratios.
constexpr double kUnlikelyRatio = 300.0;
constexpr double kUnlikelyDensity = 1e-5;  // of the area; (1/1000)^2 of a packing
constexpr std::int64_t kFewBodies = 10;    // one disk may well roll down a long way

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What was met along one direction: between which coordinates, and the bodies at the ends.
struct Span {
  double low = kInfinity, high = -kInfinity;
  std::int64_t lowest = -1, highest = -1;

  void Add(double from, double to, std::int64_t id) {
    if (from < low) low = from, lowest = id;
    if (to > high) high = to, highest = id;
  }
  double length() const { return std::max(0.0, high - low); }
};

struct Box {
  Span x, y;
  double side() const { return std::max(x.length(), y.length()); }
};

/// One pass over the bodies. `down` is the unit direction of gravity, `across` is `down` turned by a quarter.
struct Survey {
  Vec2 down, across;
  std::int64_t free = 0;
  double radii = 0.0, disk_area = 0.0;
  double smallest = kInfinity, largest = 0.0;  // radius of a free disk
  Box centres, walls;                          // in x and y
  // Near end of each free body along gravity, both of its ends across it; all that walls reach.
  Span along_near, across_upper, across_lower, wall_down, wall_across;
  bool any_wall = false;
  bool is_floored = false;  // a half-plane catches whatever falls

  void AddFree(const BodyDefinition& body) {
    ++free;
    const Vec2 c = Centre(body.pose);
    double reach = 0.0;
    for (const reference::Disk& disk : body.disks) {
      reach = std::max(reach, Norm(disk.centre) + disk.radius);
      smallest = std::min(smallest, disk.radius);
      largest = std::max(largest, disk.radius);
      disk_area += std::numbers::pi * disk.radius * disk.radius;
    }
    radii += reach;
    centres.x.Add(c.x, c.x, body.id);
    centres.y.Add(c.y, c.y, body.id);
    const double along = Dot(down, c), side = Dot(across, c);
    along_near.Add(along - reach, along - reach, body.id);
    across_upper.Add(side + reach, side + reach, body.id);
    across_lower.Add(side - reach, side - reach, body.id);
  }

  void AddWallPoint(Vec2 p, double radius, std::int64_t id) {
    walls.x.Add(p.x - radius, p.x + radius, id);
    walls.y.Add(p.y - radius, p.y + radius, id);
    wall_down.Add(Dot(down, p) - radius, Dot(down, p) + radius, id);
    wall_across.Add(Dot(across, p) - radius, Dot(across, p) + radius, id);
  }

  void AddWall(const BodyDefinition& body) {
    any_wall = true;
    const auto at = [&](Vec2 p) { return Centre(body.pose) + Rotate(body.pose.angle, p); };
    for (const reference::Disk& disk : body.disks) AddWallPoint(at(disk.centre), disk.radius, body.id);
    for (const reference::Segment& s : body.segments) {
      AddWallPoint(at(s.a), 0.0, body.id);
      AddWallPoint(at(s.b), 0.0, body.id);
    }
    for (const reference::HalfPlane& plane : body.half_planes) {
      if (Dot(Rotate(body.pose.angle, plane.normal), down) < -1e-9) is_floored = true;
    }
  }
};

Survey SurveyOf(const Scene& scene, Vec2 gravity) {
  Survey survey;
  const double g = Norm(gravity);
  survey.down = g > 0.0 ? Vec2{gravity.x / g, gravity.y / g} : Vec2{0.0, -1.0};
  survey.across = {-survey.down.y, survey.down.x};
  ForEachBody(scene, 0, 1, [&](const BodyDefinition& body) {
    if (body.kind == BodyKind::kFree) {
      survey.AddFree(body);
    } else {
      survey.AddWall(body);
    }
  });
  return survey;
}

class Judge {
 public:
  explicit Judge(const Scene& scene) : scene_(scene), gravity_(GravityAt(scene.gravity, 1, scene.time.dt)) {}

  std::vector<std::string> Sentences() {
    JudgeAngles();
    JudgeDirection();
    if (CountBodies(scene_) <= kMostBodies) {
      const Survey survey = SurveyOf(scene_, gravity_);
      JudgeFall(survey);
      JudgeUnits(survey);
    }
    return std::move(sentences_);
  }

 private:
  template <class... Arguments>
  void Say(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    sentences_.push_back(scene_.file.string() + ": " + fmt::format(text, std::forward<Arguments>(arguments)...));
  }

  void JudgeAngle(const char* key, double angle) {
    Say("'gravity.{}' is {}, more than a whole turn; angles are in radians ({} degrees are {:.4f}).", key, angle, angle,
        angle * std::numbers::pi / 180.0);
  }

  void JudgeAngles() {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    if (const auto* constant = std::get_if<ConstantGravity>(&scene_.gravity)) {
      if (std::abs(constant->angle) > kTurn) JudgeAngle("angle", constant->angle);
    } else if (const auto* rotating = std::get_if<RotatingGravity>(&scene_.gravity)) {
      // Several turns are a drum; then they are multiples of pi rather than round numbers.
      const auto degrees = [](double angle) { return std::abs(angle) > kTurn && std::fmod(angle, 0.5) == 0.0; };
      if (degrees(rotating->from_angle)) JudgeAngle("from_angle", rotating->from_angle);
      if (degrees(rotating->to_angle)) JudgeAngle("to_angle", rotating->to_angle);
    }
  }

  void JudgeDirection() {
    if (gravity_.y > std::abs(gravity_.x)) {
      Say("gravity is [{:.4g}, {:.4g}] m/s^2 at the first step, upwards (y points up); was [{:.4g}, {:.4g}] meant?", gravity_.x,
          gravity_.y, gravity_.x, -gravity_.y);
    }
  }

  void JudgeFall(const Survey& s) {
    if (Norm(gravity_) == 0.0 || s.is_floored) return;
    if (!s.any_wall) {
      Say("gravity acts, and there is no wall nor any other prescribed body: all bodies fall for ever.");
      return;
    }
    const auto lost = [&](std::int64_t id, const char* where) {
      Say("body {} lies {} all walls in the direction of gravity, and will fall for ever; look at its position, and at the "
          "walls.",
          id, where);
    };
    if (s.along_near.high > s.wall_down.high) return lost(s.along_near.highest, "beyond");
    if (scene_.periodic) return;  // the walls' images are everywhere
    if (s.across_upper.low < s.wall_across.low) return lost(s.across_upper.lowest, "beside");
    if (s.across_lower.high > s.wall_across.high) lost(s.across_lower.highest, "beside");
  }

  void JudgeUnits(const Survey& s) {
    const double mean = s.radii / static_cast<double>(s.free);
    const double side = s.centres.side();
    const double area = (s.centres.x.length() + 2.0 * mean) * (s.centres.y.length() + 2.0 * mean);
    const bool many = s.free >= kFewBodies;
    if (s.free > 1 && side < 0.1 * mean) {
      Say("the centres of all {} free bodies lie within {:.3g} m, their mean radius is {:.3g} m; are both in metres?", s.free,
          side, mean);
    } else if (s.free > 1 && s.disk_area < kUnlikelyDensity * area) {
      Say("the free bodies (mean radius {:.3g} m) fill {:.1e} of the area over which they lie ({:.3g} m wide); are radii and "
          "positions both in metres?",
          mean, s.disk_area / area, side);
    } else if (many && s.walls.side() > kUnlikelyRatio * (side + 2.0 * mean)) {
      Say("the walls reach over {:.3g} m, the free bodies over {:.3g} m; are both in metres?", s.walls.side(),
          side + 2.0 * mean);
    }
    if (s.largest > kUnlikelyRatio * s.smallest) {
      Say("radii go from {:.3g} m to {:.3g} m; are all of them in metres?", s.smallest, s.largest);
    }
  }

  const Scene& scene_;
  Vec2 gravity_;
  std::vector<std::string> sentences_;
};

}  // namespace

void NoteOddities(Scene* scene) {
  const std::vector<std::string> sentences = Judge(*scene).Sentences();
  scene->notes.sentences.insert(scene->notes.sentences.end(), sentences.begin(), sentences.end());
}

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#include "small_packing.h"

#include <cmath>
#include <random>

#include "nscdd/reference/reference_adapter.h"
#include "nscdd/time_stepper.h"
#include "packing.h"
#include "problem/problem_file.h"

namespace nscdd::test {
namespace {

constexpr double kDt = 0.01;

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double Between(double low, double high) { return low + (high - low) * (random_() / 4294967296.0); }
  int Count(int low, int high) { return low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1)); }

 private:
  std::mt19937 random_;
};

reference::Body Grain(std::int64_t id, Vec2 centre, bool equal, bool clusters, Draw* draw) {
  const double radius = equal ? 1.0 : draw->Between(0.5, 1.5), density = equal ? 1.0 : draw->Between(1.0, 10.0);
  const double angle = draw->Between(0.0, 6.283185307179586);
  if (!clusters || draw->Count(0, 2) > 0) return reference::MakeDisk(id, centre, radius, density);
  const Vec2 half = 0.4 * radius * Vec2{std::cos(angle), std::sin(angle)};
  const reference::Disk pair[2] = {{centre - half, 0.6 * radius}, {centre + half, 0.5 * radius}};
  return reference::MakeCluster(id, pair, density);
}

/// A box, or a hopper whose walls lean outwards.
reference::Body Box(double half, double lean) {
  const double top = 200.0;
  reference::Body box = reference::MakeWall(0);
  box.segments = {
      {{-half - lean * top, top}, {-half, 0.0}}, {{-half, 0.0}, {half, 0.0}}, {{half, 0.0}, {half + lean * top, top}}};
  return box;
}

/// Grains that fall into a box or hopper and lie there.
void Fill(bool equal, bool clusters, Draw* draw, reference::World* world) {
  const int grains = draw->Count(2, 40), columns = draw->Count(1, 6);
  const double friction = draw->Between(0.0, 1.0), pitch = equal ? 2.1 : 3.1;
  world->Add(Box(0.5 * pitch * columns, draw->Count(0, 1) * draw->Between(0.0, 0.5))).friction = friction;
  for (int k = 0; k < grains; ++k) {
    const Vec2 centre{pitch * (k % columns + 0.5 - 0.5 * columns) + draw->Between(-0.1, 0.1), 1.6 + pitch * (k / columns)};
    world->Add(Grain(1 + k, centre, equal, clusters, draw)).friction = friction;
  }
}

/// A lattice between two walls, jammed by overlaps from the beginning.
void Jam(bool clusters, Draw* draw, reference::World* world) {
  Packing packing{.columns = draw->Count(2, 8), .friction = draw->Between(0.0, 1.0), .clusters = clusters};
  packing.rows = draw->Count(1, 40 / packing.columns);
  for (const reference::Body& body : MakeBodies(packing)) world->Add(body);
}

}  // namespace

ContactProblem SmallPacking(unsigned seed) {
  Draw draw(seed);
  const bool jammed = seed % 3 == 0, equal = seed % 3 == 1, clusters = seed % 4 == 0;
  const double tilt = draw.Between(-0.4, 0.4);
  reference::World world;
  world.gravity = {9.81 * std::sin(tilt), -9.81 * std::cos(tilt)};
  if (jammed) {
    Jam(clusters, &draw, &world);
  } else {
    Fill(equal, clusters, &draw, &world);
  }
  reference::ReferenceAdapter adapter(&world);
  StepRecorder recorder(&adapter);
  const SteppingOptions stepping;
  SerialCommunicator serial;
  TimeStepper stepper(stepping, NscdOptions{}, &recorder, &serial);
  for (int steps = jammed ? draw.Count(1, 30) : draw.Count(5, 300); steps > 0; --steps) stepper.Step(kDt);
  return recorder.Problem(stepping, kDt).problem;
}

}  // namespace nscdd::test

// SPDX-License-Identifier: Apache-2.0
// When shapes meet on their way (nscdd/sweep.h), against sampled ways.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "nscdd/contact_advance.h"
#include "nscdd/reference/reference_adapter.h"
#include "nscdd/sweep.h"

namespace nscdd {
namespace {

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec2 Vector(double size) { return {(*this)(-size, size), (*this)(-size, size)}; }

 private:
  std::mt19937_64 random_;
};

struct Closest {
  Vec2 normal;
  double distance;
};

Closest OfPoint(Vec2 x) {
  const double distance = Norm(x);
  return {distance > 0.0 ? (1.0 / distance) * x : Vec2{0.0, 1.0}, distance};
}

/// Of the segment from (-1, 0) to (1, 0).
Closest OfSegment(Vec2 x) { return OfPoint(x - Vec2{std::clamp(x.x, -1.0, 1.0), 0.0}); }

/// The moment must be that of the first touch of the sampled way, or that at which it is closest.
template <class Of>
void Check(const SweptDisk& way, double moment, Of of) {
  const auto gap = [&](double t) { return of(way.At(t)).distance - way.radius; };
  ASSERT_GE(moment, 0.0);
  ASSERT_LE(moment, 1.0);
  if (gap(0.0) <= 0.0) return;
  if (moment == 1.0 && way.Curvature() > 2e-4 * way.radius) return;  // taken at its end
  double least = gap(moment);
  for (int k = 0; k <= 2000; ++k) {
    const double t = k / 2000.0, g = gap(t);
    if (least > 1e-8) {
      // On a way that turns the gap may have several minima: any will do that gets no impulse (below).
      if (way.Curvature() == 0.0) {
        ASSERT_GE(g, least - 1e-7 * way.radius) << "closer at " << t << " than at " << moment;
      }
    } else if (t < moment) {
      ASSERT_GE(g, -1e-8 * way.radius) << "touches at " << t << ", before " << moment;
    }
  }
  ASSERT_GE(least, -1e-8 * way.radius);
  // A way that does not touch satisfies gap + (1 - t) gap' >= 0: it gets no impulse.
  const double rate = Dot(of(way.At(moment)).normal, way.Rate(moment));
  if (least > 1e-8) ASSERT_GE(least + (1.0 - moment) * rate, -1e-7);
}

TEST(Sweep, DisksMeetOrPass) {
  Numbers number(1);
  int touching = 0;
  for (int i = 0; i < 2000; ++i) {
    const SweptDisk way{number.Vector(3.0), number.Vector(6.0), {}, {}, 0.0, 0.0, 0.0, number(0.1, 1.5)};
    const double moment = DiskMeeting(way.from, way.move, way.radius);
    Check(way, moment, OfPoint);
    touching += moment > 0.0 && Norm(way.At(moment)) < way.radius * (1.0 + 1e-9);
  }
  EXPECT_GT(touching, 200);
}

TEST(Sweep, StraightWaysToASegment) {
  Numbers number(2);
  for (int i = 0; i < 1000; ++i) {
    const SweptDisk way{number.Vector(4.0), number.Vector(8.0), {}, {}, 0.0, 0.0, 0.0, number(0.05, 1.0)};
    Check(way, ShapeMeeting(way, OfSegment), OfSegment);
  }
}

TEST(Sweep, ClustersAndWallsThatTurn) {
  Numbers number(3);
  for (int i = 0; i < 1000; ++i) {
    SweptDisk way{number.Vector(4.0), number.Vector(8.0), {}, number.Vector(1.0), 0.0, number(-1.0, 1.0), 0.0,
                  number(0.05, 1.0)};
    if (i % 2 == 0) way.shape_turn = number(-1.0, 1.0);
    Check(way, ShapeMeeting(way, OfSegment), OfSegment);
    way.arm_a = number.Vector(1.0);
    way.turn_a = number(-1.0, 1.0);
    way.shape_turn = 0.0;
    Check(way, ShapeMeeting(way, OfPoint), OfPoint);
  }
}

TEST(Sweep, AClosedContactIsTakenWhereItBegins) {
  EXPECT_EQ(DiskMeeting({1.0, 0.0}, {-1.0, 0.0}, 1.0), 0.0);
  EXPECT_EQ(DiskMeeting({1.0 + 1e-10, 0.0}, {-1.0, 0.0}, 1.0), 0.0);
  EXPECT_GT(DiskMeeting({1.0 + 1e-8, 0.0}, {-1.0, 0.0}, 1.0), 0.0);
  const SweptDisk way{{0.0, 0.5}, {1.0, -0.4}, {}, {}, 0.0, 0.0, 0.0, 0.5};
  EXPECT_EQ(ShapeMeeting(way, OfSegment), 0.0);
}

TEST(Sweep, AWallOnTheOtherSideIsNotReached) {
  // From below, through the segment and far beyond: it touches from below.
  const SweptDisk way{{0.1, -3.0}, {0.0, 100.0}, {}, {}, 0.0, 0.0, 0.0, 0.5};
  const double moment = ShapeMeeting(way, OfSegment);
  EXPECT_NEAR(moment, 0.025, 1e-12);
  EXPECT_NEAR(OfSegment(way.At(moment)).normal.y, -1.0, 1e-12);
}

/// An adapter from before SweepContacts().
class OlderAdapter final : public PlatformAdapter {
 public:
  explicit OlderAdapter(reference::World* world) : whole_(world) {}
  AdapterDescription Describe() const override { return whole_.Describe(); }
  void ReadBodies(BodyTable* bodies) override { whole_.ReadBodies(bodies); }
  void DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) override {
    whole_.DetectContacts(poses, alert, contacts);
  }
  void Commit(const StepResult& result) override { whole_.Commit(result); }
  BodyTransport* transport() override { return nullptr; }

 private:
  reference::ReferenceAdapter whole_;
};

reference::World CrowdedWorld(Numbers* number) {
  reference::World world;
  for (int i = 0; i < 30; ++i) {
    const Vec2 at = number->Vector(6.0);
    const reference::Disk two[2] = {{at, 0.4}, {at + number->Vector(0.4), 0.3}};
    world.Add(i % 3 == 0 ? reference::MakeCluster(i, two, 1.0) : reference::MakeDisk(i, at, 0.4, 1.0));
  }
  reference::Body floor = reference::MakeWall(40, {0.0, -7.0, 0.3});
  floor.half_planes.push_back({{0.0, 1.0}, 0.0});
  world.Add(floor);
  return world;
}

// Disks, clusters and half-planes, whose ways an adapter need not know.
TEST(OlderAdapters, AreTakenToTheSameMeetings) {
  Numbers number(4);
  reference::World world = CrowdedWorld(&number);
  reference::ReferenceAdapter adapter(&world);
  OlderAdapter older(&world);
  BodyTable bodies;
  adapter.ReadBodies(&bodies);
  std::vector<Twist> velocity;
  std::vector<double> reach;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Vec2 v = number.Vector(4.0);
    velocity.push_back({v.x, v.y, bodies.id[i] == 40 ? 0.0 : number(-1.0, 1.0)});
    reach.push_back(number(3.0, 6.0));
  }
  const MotionView motion{bodies.id, bodies.pose, velocity, reach, 1.0};
  ContactTable right, found;
  adapter.SweepContacts(motion, &right);
  older.SweepContacts(motion, &found);
  ASSERT_EQ(found.size(), right.size());
  ASSERT_GT(right.size(), 200u);
  int meetings = 0;
  for (std::size_t c = 0; c < right.size(); ++c) {
    ASSERT_EQ(KeyOf(found, c, bodies.id), KeyOf(right, c, bodies.id));
    ASSERT_NEAR(found.moment[c], right.moment[c], 1e-7);
    ASSERT_NEAR(found.gap[c], right.gap[c], 1e-7);
    ASSERT_NEAR(Norm(found.normal[c] - right.normal[c]), 0.0, 1e-6);
    ASSERT_NEAR(found.lever_a[c], right.lever_a[c], 1e-6);
    ASSERT_NEAR(found.lever_b[c], right.lever_b[c], 1e-6);
    ASSERT_NEAR(Norm(found.arm_a[c] - right.arm_a[c]), 0.0, 1e-6);
    ASSERT_NEAR(Norm(found.arm_b[c] - right.arm_b[c]), 0.0, 1e-6);
    meetings += right.moment[c] > 0.0 && right.gap[c] < 1e-6;
  }
  EXPECT_GT(meetings, 10);
}

}  // namespace
}  // namespace nscdd

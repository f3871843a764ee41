// SPDX-License-Identifier: Apache-2.0
// State files: what is written is read back bit for bit; what was not written so is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "nscdd/error.h"
#include "scene_files.h"
#include "state/state_file.h"

namespace nscdd {
namespace {

StateHead SampleHead() {
  StateHead head;
  head.program = "1.2.3";
  head.plugin = "nscdd 1.2.3";
  head.scene = "sample";
  head.clock = {120, 1.2000000000000002, 20, 0.2};
  head.dt = 0.01;
  head.period = 60.0;
  head.period_origin = -1.5;
  head.mean_radius = 0.7;
  head.materials = {{"light", 1.0, 0.3, 0.0}, {"heavy", 7.0, 0.6, 0.25}};
  head.run = "{\"a\": 1}";
  return head;
}

std::vector<BodyDefinition> SampleBodies() {
  std::vector<BodyDefinition> bodies;
  BodyDefinition wall{reference::MakeWall(4, {1.0, 2.0, 0.5})};
  wall.segments = {{{-1, 0}, {0, 1}}, {{0, 1}, {2, 1}}};
  wall.half_planes = {{{0, 1}, -3.0}};
  wall.disks = {{{0.1, 0.2}, 0.3}};
  wall.velocity = {0.5, -0.25, 0.125};
  wall.role = BodyRole::kWall;
  bodies.push_back(wall);
  bodies.push_back({reference::MakeDisk(7, {0.1, 1.0 / 3.0}, 0.4, 1.0)});
  bodies.push_back({reference::MakeDisk(2, {5.0, 5.0}, 0.9, 7.0), BodyRole::kDisk, 1});
  bodies.back().velocity = {1e-300, -2.0, 1e300};
  const reference::Disk pair[] = {{{-0.5, 0}, 0.5}, {{0.5, 0}, 0.6}};
  bodies.push_back({reference::MakeCluster(1'000'000'000'000, pair, 7.0), BodyRole::kCluster, 1});
  bodies.push_back({reference::MakeWall(5, {})});
  return bodies;
}

std::vector<std::byte> SampleState() { return std::vector<std::byte>(1000, std::byte{0x5a}); }

std::vector<BodyDefinition> BodiesIn(const StateReader& state, std::int64_t first, std::int64_t last) {
  std::vector<BodyDefinition> bodies;
  state.ForEachBody(first, last, [&](const BodyDefinition& body) { bodies.push_back(body); });
  return bodies;
}

void ExpectSame(const BodyDefinition& a, const BodyDefinition& b, const std::vector<Material>& materials) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.role, b.role);
  EXPECT_EQ(a.material, b.material);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.inertia, b.inertia);
  EXPECT_TRUE(a.pose.x == b.pose.x && a.pose.y == b.pose.y && a.pose.angle == b.pose.angle);
  EXPECT_TRUE(a.velocity.vx == b.velocity.vx && a.velocity.vy == b.velocity.vy && a.velocity.spin == b.velocity.spin);
  EXPECT_EQ(b.friction, materials[static_cast<std::size_t>(a.material)].friction);
  EXPECT_EQ(b.restitution, materials[static_cast<std::size_t>(a.material)].restitution);
  ASSERT_EQ(a.disks.size(), b.disks.size());
  ASSERT_EQ(a.segments.size(), b.segments.size());
  ASSERT_EQ(a.half_planes.size(), b.half_planes.size());
  for (std::size_t k = 0; k < a.disks.size(); ++k) {
    EXPECT_TRUE(a.disks[k].centre.x == b.disks[k].centre.x && a.disks[k].centre.y == b.disks[k].centre.y);
    EXPECT_EQ(a.disks[k].radius, b.disks[k].radius);
  }
  for (std::size_t k = 0; k < a.segments.size(); ++k) {
    EXPECT_TRUE(a.segments[k].a.x == b.segments[k].a.x && a.segments[k].a.y == b.segments[k].a.y);
    EXPECT_TRUE(a.segments[k].b.x == b.segments[k].b.x && a.segments[k].b.y == b.segments[k].b.y);
  }
  for (std::size_t k = 0; k < a.half_planes.size(); ++k) {
    EXPECT_TRUE(a.half_planes[k].normal.x == b.half_planes[k].normal.x &&
                a.half_planes[k].normal.y == b.half_planes[k].normal.y);
    EXPECT_EQ(a.half_planes[k].offset, b.half_planes[k].offset);
  }
}

std::string RefusalOf(const std::filesystem::path& file) {
  try {
    const StateReader state(file);
    BodiesIn(state, 0, state.bodies());
    state.SolverParts();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find(file.filename().string() + " cannot be used as a state: "), std::string::npos)
        << e.what();
    return e.what();
  }
  return "";
}

TEST(StateFile, IsReadBackBitForBit) {
  const TestFolder folder;
  const auto file = folder.path() / "state.h5";
  const StateHead head = SampleHead();
  const std::vector<BodyDefinition> bodies = SampleBodies();
  WriteStateFile(file, head, bodies, SampleState(), RankGroup());
  const StateReader state(file);
  EXPECT_EQ(state.head().program, head.program);
  EXPECT_EQ(state.head().plugin, head.plugin);
  EXPECT_EQ(state.head().scene, head.scene);
  EXPECT_EQ(state.head().clock.step, head.clock.step);
  EXPECT_EQ(state.head().clock.time, head.clock.time);
  EXPECT_EQ(state.head().clock.even_since, head.clock.even_since);
  EXPECT_EQ(state.head().clock.even_time, head.clock.even_time);
  EXPECT_EQ(state.head().dt, head.dt);
  EXPECT_EQ(state.head().period, head.period);
  EXPECT_EQ(state.head().period_origin, head.period_origin);
  EXPECT_EQ(state.head().mean_radius, head.mean_radius);
  EXPECT_EQ(state.head().run, head.run);
  ASSERT_EQ(state.head().materials.size(), 2u);
  EXPECT_EQ(state.head().materials[1].name, "heavy");
  EXPECT_EQ(state.head().materials[1].density, 7.0);
  EXPECT_EQ(state.Ids(), (std::vector<std::int64_t>{4, 7, 2, 1'000'000'000'000, 5}));
  EXPECT_EQ(state.Roles(),
            (std::vector<BodyRole>{BodyRole::kWall, BodyRole::kDisk, BodyRole::kDisk, BodyRole::kCluster, BodyRole::kDisk}));
  EXPECT_EQ(state.SolverParts(), std::vector<std::vector<std::byte>>{SampleState()});
  for (std::int64_t first = 0; first <= 5; ++first) {
    for (std::int64_t last = first; last <= 5; ++last) {
      const auto read = BodiesIn(state, first, last);
      ASSERT_EQ(std::ssize(read), last - first);
      for (std::size_t i = 0; i < read.size(); ++i)
        ExpectSame(bodies[static_cast<std::size_t>(first) + i], read[i], head.materials);
    }
  }
}

TEST(StateFile, WithoutBodiesAndState) {
  const TestFolder folder;
  const auto file = folder.path() / "state.h5";
  WriteStateFile(file, SampleHead(), {}, {}, RankGroup());
  const StateReader state(file);
  EXPECT_EQ(state.bodies(), 0);
  EXPECT_TRUE(state.Ids().empty());
  ASSERT_EQ(state.SolverParts().size(), 1u);
  EXPECT_TRUE(state.SolverParts()[0].empty());
}

/// No byte may change unseen, and HDF5 never meets one that has.
TEST(StateFile, DamageIsRefused) {
  const TestFolder folder;
  const auto file = folder.path() / "state.h5";
  WriteStateFile(file, SampleHead(), SampleBodies(), SampleState(), RankGroup());
  ASSERT_EQ(RefusalOf(file), "");
  std::ifstream stream(file, std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t at = 0; at < good.size(); at += at < 32 ? 1 : 97) {
    if (at >= 32 && at < kSealSize) continue;  // nothing stands there
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    EXPECT_NE(RefusalOf(folder.Write("bad.h5", bad)), "") << "byte " << at;
  }
  for (std::size_t size = 0; size < good.size(); size += size < 600 ? 1 : 501) {
    EXPECT_NE(RefusalOf(folder.Write("bad.h5", good.substr(0, size))), "") << size << " bytes";
  }
  EXPECT_NE(RefusalOf(folder.Write("bad.h5", good + '\0')), "");
  std::string newer = good;
  newer[8] = 2;
  EXPECT_NE(RefusalOf(folder.Write("bad.h5", newer)).find("format version 2; this program reads 1"), std::string::npos);
}

/// Well sealed, and yet no state of anything.
TEST(StateFile, NonsenseIsRefused) {
  const TestFolder folder;
  const auto file = folder.path() / "state.h5";
  const auto refusal = [&](auto edit) {
    StateHead head = SampleHead();
    std::vector<BodyDefinition> bodies = SampleBodies();
    edit(&head, &bodies);
    WriteStateFile(file, head, bodies, SampleState(), RankGroup());
    return RefusalOf(file);
  };
  using Bodies = std::vector<BodyDefinition>;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal([](StateHead*, Bodies*) {}), "");
  EXPECT_NE(refusal([](StateHead*, Bodies* b) { (*b)[2].material = 2; }).find("material 2"), std::string::npos);
  EXPECT_NE(refusal([](StateHead*, Bodies* b) { (*b)[2].material = -1; }), "");
  EXPECT_NE(refusal([](StateHead*, Bodies* b) { (*b)[2].kind = static_cast<BodyKind>(2); }).find("kind 2"), std::string::npos);
  EXPECT_NE(refusal([](StateHead*, Bodies* b) { (*b)[2].role = static_cast<BodyRole>(3); }).find("role"), std::string::npos);
  EXPECT_NE(refusal([](StateHead*, Bodies* b) { (*b)[1].mass = 0.0; }).find("mass"), std::string::npos);
  EXPECT_NE(refusal([](StateHead*, Bodies* b) { (*b)[1].pose.y = kNan; }), "");
  EXPECT_NE(refusal([](StateHead*, Bodies* b) { (*b)[1].id = -4; }), "");
  EXPECT_NE(refusal([](StateHead*, Bodies* b) { (*b)[0].segments[0].b = (*b)[0].segments[0].a; }), "");
  EXPECT_NE(refusal([](StateHead* h, Bodies*) { h->dt = 0.0; }).find("clock"), std::string::npos);
  EXPECT_NE(refusal([](StateHead* h, Bodies*) { h->clock.even_since = 121; }), "");
  EXPECT_NE(refusal([](StateHead* h, Bodies*) { h->clock.time = kNan; }), "");
  EXPECT_NE(refusal([](StateHead* h, Bodies*) { h->materials[1].friction = -1.0; }).find("heavy"), std::string::npos);
  EXPECT_NE(refusal([](StateHead* h, Bodies*) { h->materials.clear(); }), "");
}

TEST(StateFile, OtherHdf5FilesAreRefused) {
  const TestFolder folder;
  EXPECT_NE(RefusalOf(folder.Write("results.h5", "\x89HDF\r\n\x1a\n")).find("no state file of nscdd"), std::string::npos);
  std::string sealed(1000, 'x');  // sealed, but not HDF5
  const auto file = folder.Write("sealed.h5", sealed);
  Seal(file);
  try {
    const StateReader state(file);
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("sealed.h5"), std::string::npos);
  }
}

}  // namespace
}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "nscdd/error.h"
#include "scene/body_stream.h"
#include "scene/platform.h"
#include "scene/read_scene.h"
#include "scene_files.h"

namespace nscdd {
namespace {

std::unique_ptr<Platform> Fill(const std::string& name, const Scene& scene) {
  std::unique_ptr<Platform> platform = MakePlatform(name, scene);
  platform->SetGravity({0.5, -9.81});
  ForEachBody(scene, 0, 1, [&](const BodyDefinition& body) { platform->Add(body); });
  return platform;
}

/// Rows of `bodies` in ascending order of id.
std::vector<std::size_t> ById(const BodyTable& bodies) {
  std::vector<std::size_t> rows(bodies.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return bodies.id[a] < bodies.id[b]; });
  return rows;
}

ContactTable Detect(Platform* platform, const BodyTable& bodies, double alert) {
  std::vector<std::int64_t> id;
  std::vector<Pose> pose;
  for (const std::size_t row : ById(bodies)) {
    id.push_back(bodies.id[row]);
    pose.push_back(bodies.pose[row]);
  }
  ContactTable contacts;
  platform->adapter().DetectContacts({id, pose}, alert, &contacts);
  return contacts;
}

void ExpectSameBodies(const BodyTable& a, const BodyTable& b) {
  ASSERT_EQ(a.size(), b.size());
  const std::vector<std::size_t> rows_a = ById(a), rows_b = ById(b);
  for (std::size_t k = 0; k < rows_a.size(); ++k) {
    const std::size_t i = rows_a[k], j = rows_b[k];
    ASSERT_EQ(a.id[i], b.id[j]);
    EXPECT_EQ(a.kind[i], b.kind[j]);
    EXPECT_EQ(a.pose[i].x, b.pose[j].x);
    EXPECT_EQ(a.pose[i].y, b.pose[j].y);
    EXPECT_EQ(a.pose[i].angle, b.pose[j].angle);
    EXPECT_EQ(a.velocity[i].spin, b.velocity[j].spin);
    if (a.kind[i] == BodyKind::kPrescribed) continue;
    EXPECT_EQ(a.mass[i], b.mass[j]);
    EXPECT_EQ(a.inertia[i], b.inertia[j]);
    EXPECT_NEAR(a.force[i].fx, b.force[j].fx, 1e-13 * a.mass[i]);
    EXPECT_NEAR(a.force[i].fy, b.force[j].fy, 1e-13 * a.mass[i] * 9.81);
  }
}

class ScenePlatforms : public testing::TestWithParam<std::string> {};

TEST_P(ScenePlatforms, HoldTheSameBodiesAndFindTheSameContacts) {
  const Scene scene = ReadSceneFile(SampleScenes() / (GetParam() + ".toml"));
  const auto reference = Fill("reference", scene), box2d = Fill("box2d", scene);
  BodyTable bodies_a, bodies_b;
  reference->adapter().ReadBodies(&bodies_a);
  box2d->adapter().ReadBodies(&bodies_b);
  ExpectSameBodies(bodies_a, bodies_b);
  const ContactTable a = Detect(reference.get(), bodies_a, 0.3), b = Detect(box2d.get(), bodies_b, 0.3);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.a, b.a);
  EXPECT_EQ(a.b, b.b);
  EXPECT_EQ(a.shape_a, b.shape_a);
  EXPECT_EQ(a.shape_b, b.shape_b);
  EXPECT_EQ(a.image, b.image);
  EXPECT_EQ(a.friction, b.friction);
  EXPECT_EQ(a.restitution, b.restitution);
  for (std::size_t c = 0; c < a.size(); ++c) {
    EXPECT_NEAR(a.gap[c], b.gap[c], 1e-12) << c;
    EXPECT_NEAR(Norm(a.normal[c] - b.normal[c]), 0.0, 1e-12) << c;
    EXPECT_NEAR(a.lever_a[c], b.lever_a[c], 1e-12) << c;
    EXPECT_NEAR(a.lever_b[c], b.lever_b[c], 1e-12) << c;
    EXPECT_NEAR(Norm(a.site[c] - b.site[c]), 0.0, 1e-11) << c;
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, ScenePlatforms,
                         testing::Values("two_disks", "column", "pyramid", "incline_roll", "rotating_box_730",
                                         "sloped_flow_750", "drum", "clusters", "box_10k"),
                         [](const auto& test) { return test.param; });

TEST(ScenePlatform, PackedScenesHaveContactsFromTheFirstStep) {
  for (const std::string name : {"rotating_box_730", "sloped_flow_750", "box_10k"}) {
    const Scene scene = ReadSceneFile(SampleScenes() / (name + ".toml"));
    const auto platform = Fill("reference", scene);
    BodyTable bodies;
    platform->adapter().ReadBodies(&bodies);
    const ContactTable contacts = Detect(platform.get(), bodies, 0.1);
    EXPECT_GT(contacts.size(), 2 * static_cast<std::size_t>(CountBodies(scene)) - 100) << name;
    EXPECT_GT(*std::min_element(contacts.gap.begin(), contacts.gap.end()), -2e-4) << name << " has deep overlaps";
  }
}

TEST(ScenePlatform, TheUserChangesVelocitiesOnBoth) {
  const Scene scene = ReadSceneFile(SampleScenes() / "drum.toml");
  for (const std::string name : {"reference", "box2d"}) {
    const auto platform = Fill(name, scene);
    platform->SetVelocity(0, {0.1, -0.2, 0.3});
    BodyTable bodies;
    platform->adapter().ReadBodies(&bodies);
    const std::size_t wall = ById(bodies)[0];
    EXPECT_EQ(bodies.velocity[wall].vx, 0.1) << name;
    EXPECT_EQ(bodies.velocity[wall].vy, -0.2) << name;
    EXPECT_EQ(bodies.velocity[wall].spin, 0.3) << name;
    EXPECT_THROW(platform->SetVelocity(123456, {}), Error) << name;
  }
}

TEST(ScenePlatform, UnknownNamesAreRefusedWithTheNearest) {
  const Scene scene = ReadSceneFile(SampleScenes() / "column.toml");
  try {
    MakePlatform("box3d", scene);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'box2d'?"), std::string::npos) << error.what();
  }
}

TEST(ScenePlatform, MillimetreGrainsKeepTheirDigitsOnBox2d) {
  const TestFolder folder;
  const Scene scene = ReadSceneFile(folder.Write("mm.toml", R"([time]
dt = 1e-4
steps = 1
[[walls]]
type = "half_plane"
point = [0, 0]
[[lattices]]
count = 20
x = [0, 0.02]
bottom = -1e-5
radius = [0.8e-3, 1e-3]
jitter = 1e-4
)"));
  EXPECT_DOUBLE_EQ(MeanGrainRadius(scene), 0.9e-3);
  const auto reference = Fill("reference", scene), box2d = Fill("box2d", scene);
  BodyTable a, b;
  reference->adapter().ReadBodies(&a);
  box2d->adapter().ReadBodies(&b);
  ExpectSameBodies(a, b);
  const ContactTable contacts_a = Detect(reference.get(), a, 1e-3), contacts_b = Detect(box2d.get(), b, 1e-3);
  ASSERT_EQ(contacts_a.a, contacts_b.a);
  ASSERT_EQ(contacts_a.b, contacts_b.b);
  ASSERT_GT(contacts_a.size(), 20u);
  for (std::size_t c = 0; c < contacts_a.size(); ++c) EXPECT_NEAR(contacts_a.gap[c], contacts_b.gap[c], 1e-15) << c;
}

}  // namespace
}  // namespace nscdd

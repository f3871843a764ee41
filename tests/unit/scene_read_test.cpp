// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "scene/body_stream.h"
#include "scene/read_scene.h"
#include "scene_files.h"

namespace nscdd {
namespace {

struct Shipped {
  std::string name;
  std::int64_t steps;
  std::int64_t prescribed;
  std::int64_t free;
};
void PrintTo(const Shipped& scene, std::ostream* out) { *out << scene.name; }

class ShippedScene : public testing::TestWithParam<Shipped> {};

TEST_P(ShippedScene, HasItsBodiesWithUniqueIdsWallsFirst) {
  const Scene scene = ReadSceneFile(SampleScenes() / (GetParam().name + ".toml"));
  EXPECT_EQ(scene.name, GetParam().name);
  EXPECT_EQ(scene.time.steps, GetParam().steps);
  EXPECT_EQ(scene.time.theta, 0.5);
  std::map<BodyKind, std::int64_t> count;
  std::set<std::int64_t> ids;
  ForEachBody(scene, 0, 1, [&](const BodyDefinition& body) {
    ++count[body.kind];
    EXPECT_TRUE(ids.insert(body.id).second) << body.id;
    EXPECT_NO_THROW(reference::Validate(body));
    EXPECT_TRUE(body.kind == BodyKind::kFree || count[BodyKind::kFree] == 0) << "wall " << body.id << " after a grain";
  });
  EXPECT_EQ(count[BodyKind::kPrescribed], GetParam().prescribed);
  EXPECT_EQ(count[BodyKind::kFree], GetParam().free);
  EXPECT_EQ(CountBodies(scene), GetParam().prescribed + GetParam().free);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene,
                         testing::Values(Shipped{"two_disks", 200, 1, 2}, Shipped{"column", 50, 1, 4},
                                         Shipped{"pyramid", 100, 1, 6}, Shipped{"incline_roll", 100, 1, 1},
                                         Shipped{"rotating_box_730", 50, 3, 730},
                                         Shipped{"rotating_box_730_frictionless", 50, 3, 730},
                                         Shipped{"sloped_flow_750", 200, 60, 750}, Shipped{"drum", 300, 1, 300},
                                         Shipped{"clusters", 400, 1, 16}, Shipped{"box_10k", 20, 3, 10000},
                                         Shipped{"box_100k", 10, 3, 100000}),
                         [](const auto& test) { return test.param.name; });

TEST(SceneRead, EveryFileOfTheFolderIsListedAbove) {
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(SampleScenes())) {
    if (entry.path().extension() == ".toml") files.insert(entry.path().stem());
  }
  EXPECT_EQ(files.size(), 11u);
}

TEST(SceneRead, SettlingScenesStartFromTheRadiiOfTheirPackings) {
  for (const std::string name : {"rotating_box_730", "rotating_box_730_frictionless", "sloped_flow_750"}) {
    std::map<std::int64_t, double> settled, loose;
    const auto radii = [](std::map<std::int64_t, double>* of) {
      return [of](const BodyDefinition& body) {
        if (body.kind == BodyKind::kFree) (*of)[body.id] = body.disks.at(0).radius;
      };
    };
    ForEachBody(ReadSceneFile(SampleScenes() / (name + ".toml")), 0, 1, radii(&settled));
    ForEachBody(ReadSceneFile(SampleScenes() / "settle" / (name + ".toml")), 0, 1, radii(&loose));
    EXPECT_EQ(settled, loose) << name;
  }
}

TEST(SceneRead, PyramidIsTheGoldenCase) {
  const Scene scene = ReadSceneFile(SampleScenes() / "pyramid.toml");
  const Vec2 g = GravityAt(scene.gravity, 1, scene.time.dt);
  EXPECT_NEAR(g.x, 1.9138360589782182, 1e-15);
  EXPECT_NEAR(g.y, -9.6215036007556911, 1e-15);
  ForEachBody(scene, 0, 1, [](const BodyDefinition& body) {
    EXPECT_EQ(body.friction, 0.3);
    if (body.kind == BodyKind::kPrescribed) return;
    EXPECT_EQ(body.mass, std::numbers::pi);
    EXPECT_EQ(body.inertia, std::numbers::pi / 2);
  });
}

TEST(SceneRead, SolverKeysBecomeTextWithTheirLines) {
  const TestFolder folder;
  const Scene scene = ReadSceneFile(folder.Write("s.toml", R"([time]
dt = 1e-2
steps = 3
[[disks]]
centre = [0, 1]
radius = 1
[solver]
name = "nscdd"
on_nonconvergence = "stop"
tolerance = 1.666e-4
max_iterations = 50
warm_start = false
subdomains = [2, 3]
criterion = "qm16"
)"));
  EXPECT_EQ(scene.solver.name, "nscdd");
  EXPECT_EQ(scene.solver.line, 8);
  EXPECT_EQ(scene.solver.on_nonconvergence, OnNonconvergence::kStop);
  std::map<std::string, std::pair<std::string, int>> options;
  for (const SolverOption& option : scene.solver.options) options[option.key] = {option.text, option.line};
  const std::map<std::string, std::pair<std::string, int>> expected = {{"tolerance", {"0.0001666", 10}},
                                                                       {"max_iterations", {"50", 11}},
                                                                       {"warm_start", {"false", 12}},
                                                                       {"subdomains", {"2x3", 13}},
                                                                       {"criterion", {"qm16", 14}}};
  EXPECT_EQ(options, expected);
}

TEST(SceneRead, DefaultsAreTheDocumentedOnes) {
  const TestFolder folder;
  const Scene scene =
      ReadSceneFile(folder.Write("plain.toml", "[time]\ndt = 0.01\nsteps = 3\n[[disks]]\ncentre = [0, 1]\nradius = 1\n"));
  EXPECT_EQ(scene.name, "plain");
  EXPECT_EQ(scene.adapter, "box2d");
  EXPECT_EQ(GravityAt(scene.gravity, 1, 0.01).y, -9.81);
  EXPECT_FALSE(scene.periodic);
  EXPECT_EQ(scene.solver.name, "nscd");
  EXPECT_EQ(scene.solver.on_nonconvergence, OnNonconvergence::kContinue);
  EXPECT_TRUE(scene.solver.options.empty());
  EXPECT_FALSE(scene.output.save_every);
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].density, 1.0);
  EXPECT_EQ(scene.materials[0].friction, 0.3);
  EXPECT_EQ(scene.materials[0].restitution, 0.0);
}

}  // namespace
}  // namespace nscdd

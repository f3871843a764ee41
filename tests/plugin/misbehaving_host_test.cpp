// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "expect_error.h"
#include "nscdd/host/adapter_host.h"
#include "nscdd/host/solver.h"
#include "three_disk_platform.h"

namespace nscdd {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// The whole way: a spoilt platform behind the loaded plugin. The sentence must name the function.
using P = ThreeDiskPlatform;

struct Spoilt {
  const char* name;
  void (*spoil)(ThreeDiskPlatform*);
  std::vector<std::string> parts;
};

void PrintTo(const Spoilt& spoilt, std::ostream* out) { *out << spoilt.name; }

class MisbehavingHost : public testing::TestWithParam<Spoilt> {};

TEST_P(MisbehavingHost, IsRefusedByTheStep) {
  ThreeDiskPlatform platform;
  AdapterHost host(&platform);
  Solver solver(PluginLibrary::Load(PLUGIN_FILE), {.solver = "nscd", .options = {}, .host = host.table(), .communicator = {}});
  GetParam().spoil(&platform);
  ExpectError([&] { solver.Step(0.01); }, GetParam().parts);
  EXPECT_EQ(platform.commits, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Hosts, MisbehavingHost,
    testing::Values(
        Spoilt{"throwing", [](P* p) { p->throws = "read"; }, {"read_bodies", "on strike"}},
        Spoilt{"nan_velocity", [](P* p) { p->bodies.velocity[1].vy = kNan; }, {"ReadBodies", "body 1"}},
        Spoilt{"beyond_numbers",
               [](P* p) { p->bodies.pose[1].x = p->bodies.velocity[1].vx = 1.797e308; },
               {"ReadBodies", "body 1", "largest number"}},
        Spoilt{"nan_force", [](P* p) { p->bodies.force[2].torque = kNan; }, {"ReadBodies", "body 2"}},
        Spoilt{"negative_mass", [](P* p) { p->bodies.mass[1] = -1.0; }, {"ReadBodies", "body 1", "mass"}},
        Spoilt{"duplicate_ids",
               [](P* p) {
                 p->bodies.id = {0, 1, 1};
               },
               {"read_bodies", "body 1", "twice"}},
        Spoilt{"blind", [](P* p) { p->throws = "detect"; }, {"detect_contacts", "eyes are closed"}},
        Spoilt{"unsorted",
               [](P* p) {
                 std::swap(p->contacts.a[0], p->contacts.a[1]);
                 std::swap(p->contacts.b[0], p->contacts.b[1]);
               },
               {"DetectContacts", "bodies 0 and 1", "sorted"}},
        Spoilt{"twice",
               [](P* p) {
                 p->contacts.a[1] = 0;
                 p->contacts.b[1] = 1;
               },
               {"DetectContacts", "bodies 0 and 1", "twice"}},
        Spoilt{"swapped", [](P* p) { std::swap(p->contacts.a[0], p->contacts.b[0]); }, {"DetectContacts", "bodies 1 and 0"}},
        Spoilt{"no_such_row", [](P* p) { p->contacts.b[1] = 3; }, {"detect_contacts", "rows 1 and 3", "3 bodies"}},
        Spoilt{"nan_gap", [](P* p) { p->contacts.gap[0] = kNan; }, {"DetectContacts", "bodies 0 and 1", "gap"}},
        Spoilt{"long_normal", [](P* p) { p->contacts.normal[1].x = 1.1; }, {"DetectContacts", "bodies 1 and 2", "unit"}},
        Spoilt{"negative_friction", [](P* p) { p->contacts.friction[1] = -0.1; }, {"DetectContacts", "friction"}}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace nscdd

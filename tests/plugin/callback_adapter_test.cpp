// SPDX-License-Identifier: Apache-2.0
#include "nscdd/callback/callback_adapter.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <stdexcept>

#include "expect_error.h"
#include "nscdd/host/adapter_host.h"
#include "nscdd/host/solver.h"
#include "three_disk_platform.h"

namespace nscdd {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Out through AdapterHost and back through CallbackAdapter: both layers of the C interface.
struct Loop {
  ThreeDiskPlatform platform;
  std::unique_ptr<AdapterHost> host;
  nscdd_host table{};
  std::unique_ptr<CallbackAdapter> adapter;

  void Close() {
    host = std::make_unique<AdapterHost>(&platform);
    table = *host->table();
    adapter = std::make_unique<CallbackAdapter>(&table);
  }
};

TEST(CallbackAdapter, RoundTripsEverything) {
  Loop loop;
  loop.platform.description = {"spoilt", "2", true, true, true, 8.0, -1.0};
  loop.platform.contacts.image = {0, 1};
  loop.platform.contacts.arm_a = {{0.25, 0.5}, {0.0, 0.0}};
  loop.platform.contacts.arm_b = {{0.0, 0.0}, {1.0, -1.0}};
  loop.platform.bodies.kind[2] = BodyKind::kPrescribed;
  loop.platform.bodies.force[1] = {1.0, 2.0, 3.0};
  loop.Close();
  const AdapterDescription d = loop.adapter->Describe();
  EXPECT_EQ(d.name, "spoilt");
  EXPECT_EQ(d.version, "2");
  EXPECT_TRUE(d.distributed_bodies && d.prescribed_motion && d.clusters);
  EXPECT_EQ(d.period, 8.0);
  EXPECT_EQ(d.period_origin, -1.0);

  BodyTable bodies;
  loop.adapter->ReadBodies(&bodies);
  EXPECT_EQ(bodies.id, loop.platform.bodies.id);
  EXPECT_EQ(bodies.kind, loop.platform.bodies.kind);
  EXPECT_EQ(bodies.pose[2].x, 4.0);
  EXPECT_EQ(bodies.force[1].torque, 3.0);

  ContactTable contacts;
  loop.adapter->DetectContacts({bodies.id, bodies.pose}, 0.125, &contacts);
  EXPECT_EQ(loop.platform.seen_alert, 0.125);
  EXPECT_EQ(loop.platform.seen_ids, bodies.id);
  EXPECT_EQ(contacts.b, loop.platform.contacts.b);
  EXPECT_EQ(contacts.image, loop.platform.contacts.image);
  EXPECT_EQ(contacts.arm_b[1].y, -1.0);
  EXPECT_EQ(contacts.site[1].x, 3.0);

  const std::vector<ContactKey> keys = {{0, 1, 2, 3, 4}};
  const std::vector<Vec2> impulses = {{5.0, 6.0}};
  loop.adapter->Commit({bodies.id, bodies.pose, bodies.velocity, keys, impulses});
  EXPECT_EQ(loop.platform.committed_id, bodies.id);
  EXPECT_EQ(loop.platform.committed_pose[1].x, 2.0);
  EXPECT_EQ(loop.platform.keys, keys);
  EXPECT_EQ(loop.platform.impulses[0].y, 6.0);

  std::vector<std::byte> bytes(1);
  loop.adapter->transport()->Pack(7, &bytes);
  EXPECT_EQ(bytes.size(), 4u) << "Pack appends";
  EXPECT_EQ(bytes[3], static_cast<std::byte>(7));
  loop.adapter->transport()->Insert(9, bytes);
  EXPECT_EQ(loop.platform.inserted, 9);
  EXPECT_EQ(loop.platform.insert_size, 4u);
  ExpectError([&] { loop.adapter->transport()->Remove(1); }, {"'spoilt'", "remove", "there is no such body"});
}

TEST(CallbackAdapter, HasNoTransportUnlessDistributed) {
  Loop loop;
  loop.Close();
  EXPECT_EQ(loop.adapter->transport(), nullptr);
}

TEST(CallbackAdapter, ChecksTheTable) {
  Loop loop;
  loop.Close();
  ExpectError([] { CallbackAdapter adapter(nullptr); }, {"null pointer"});
  nscdd_host host = loop.table;
  host.header.abi_major = 9;
  ExpectError([&] { CallbackAdapter adapter(&host); }, {"nscdd_host", "ABI major 9", "speaks major 1"});
  host = loop.table;
  host.header.abi_minor = NSCDD_ABI_MINOR + 1;
  ExpectError([&] { CallbackAdapter adapter(&host); }, {"nscdd_host", "newer solver plugin"});
  host = loop.table;
  host.header.struct_size = sizeof(nscdd_host) - 1;
  ExpectError([&] { CallbackAdapter adapter(&host); }, {"nscdd_host", "prescribes at least"});
  host = loop.table;
  host.detect_contacts = nullptr;
  ExpectError([&] { CallbackAdapter adapter(&host); }, {"function detect_contacts is null"});
  loop.platform.description.distributed_bodies = true;
  host = loop.table;
  ExpectError([&] { CallbackAdapter adapter(&host); }, {"'spoilt'", "pack, insert and remove"});
}

TEST(CallbackAdapter, ChecksTheDescription) {
  Loop loop;
  loop.platform.description.period = kNan;
  ExpectError([&] { loop.Close(); }, {"describe", "period nan"});
  loop.platform.description.period = 0.0;
  loop.platform.description.name = "";
  ExpectError([&] { loop.Close(); }, {"describe", "name is empty"});
}

TEST(CallbackAdapter, PassesOnSentences) {
  Loop loop;
  loop.Close();
  BodyTable bodies;
  ContactTable contacts;
  loop.platform.throws = "read";
  ExpectError([&] { loop.adapter->ReadBodies(&bodies); }, {"host 'spoilt', function read_bodies", "the bodies are on strike"});
  loop.platform.throws = "detect";
  ExpectError([&] { loop.adapter->DetectContacts({}, 0.1, &contacts); }, {"function detect_contacts", "the eyes are closed"});
  loop.table.last_error = [](void*) -> const char* { return nullptr; };
  ExpectError([&] { loop.adapter->DetectContacts({}, 0.1, &contacts); }, {"function detect_contacts", "gave no sentence"});
}

TEST(CallbackAdapter, SurvivesAnExceptionThroughC) {
  Loop loop;
  loop.Close();
  loop.table.read_bodies = [](void*, nscdd_bodies*) -> std::int32_t { throw std::runtime_error("oops"); };
  BodyTable bodies;
  ExpectError([&] { loop.adapter->ReadBodies(&bodies); }, {"read_bodies", "exception through the C interface"});
}

TEST(CallbackAdapter, RefusesArraysThatAreNotThere) {
  Loop loop;
  loop.Close();
  BodyTable bodies;
  ContactTable contacts;
  loop.table.read_bodies = [](void*, nscdd_bodies* b) -> std::int32_t { return b->count = 2, NSCDD_OK; };
  ExpectError([&] { loop.adapter->ReadBodies(&bodies); }, {"read_bodies", "array id is null", "2 entries"});
  loop.table.read_bodies = [](void*, nscdd_bodies* b) -> std::int32_t { return b->count = ~std::uint64_t{0}, NSCDD_OK; };
  ExpectError([&] { loop.adapter->ReadBodies(&bodies); }, {"read_bodies", "18446744073709551615 bodies"});
  loop.table.detect_contacts = [](void*, std::uint64_t, const std::int64_t*, const double*, double,
                                  nscdd_contacts* c) -> std::int32_t { return c->count = 1, NSCDD_OK; };
  ExpectError([&] { loop.adapter->DetectContacts({}, 0.1, &contacts); }, {"detect_contacts", "array a is null"});
}

TEST(CallbackAdapter, RefusesIdsRowsAndImages) {
  Loop loop;
  loop.platform.bodies.id = {4, 2, 4};
  loop.Close();
  BodyTable bodies;
  ContactTable contacts;
  ExpectError([&] { loop.adapter->ReadBodies(&bodies); }, {"read_bodies", "body 4", "twice"});
  loop.platform.bodies.id = {4, -2, 5};
  ExpectError([&] { loop.adapter->ReadBodies(&bodies); }, {"read_bodies", "body -2", ">= 0"});
  loop.platform.bodies.id = {4, 2, 5};
  loop.platform.bodies.kind[1] = static_cast<BodyKind>(3);
  ExpectError([&] { loop.adapter->ReadBodies(&bodies); }, {"read_bodies", "body 2", "kind is 3"});
  const std::vector<std::int64_t> id = {0, 1};
  const std::vector<Pose> pose(2);
  ExpectError(
      [&] {
        loop.adapter->DetectContacts({id, pose}, 0.1, &contacts);
      },
      {"detect_contacts", "contact 1", "rows 1 and 2"});
  loop.platform.contacts.image = {0, 0};
  const std::vector<std::int64_t> ids = {0, 1, 2};
  const std::vector<Pose> poses(3);
  ExpectError([&] { loop.adapter->DetectContacts({ids, poses}, 0.1, &contacts); }, {"detect_contacts", "not periodic"});
}

TEST(CallbackAdapter, RefusesAnAbsurdPackage) {
  Loop loop;
  loop.platform.description.distributed_bodies = true;
  loop.Close();
  loop.table.pack = [](void*, std::int64_t, const void** bytes, std::uint64_t* size) -> std::int32_t {
    *bytes = nullptr;
    *size = 5;
    return NSCDD_OK;
  };
  std::vector<std::byte> bytes;
  ExpectError([&] { loop.adapter->transport()->Pack(3, &bytes); }, {"pack", "body 3", "null"});
}

TEST(CallbackAdapter, CommitsNothingThatIsNotFinite) {
  Loop loop;
  loop.Close();
  const std::vector<std::int64_t> id = {5};
  const std::vector<Pose> pose = {{0.0, kNan, 0.0}};
  const std::vector<Twist> velocity(1);
  ExpectError([&] { loop.adapter->Commit({id, pose, velocity, {}, {}}); }, {"body 5", "not finite"});
  EXPECT_EQ(loop.platform.commits, 0);
}

}  // namespace
}  // namespace nscdd

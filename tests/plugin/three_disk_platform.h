// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "nscdd/error.h"
#include "nscdd/platform_adapter.h"

namespace nscdd {

/// A platform in memory whose tables a test can spoil: three unit disks in a row, the first two and the last two touching.
class ThreeDiskPlatform final : public PlatformAdapter, public BodyTransport {
 public:
  ThreeDiskPlatform() {
    bodies.Resize(3);
    for (std::size_t i = 0; i < 3; ++i) {
      bodies.id[i] = static_cast<std::int64_t>(i);
      bodies.mass[i] = bodies.inertia[i] = bodies.radius[i] = bodies.bounding_radius[i] = 1.0;
      bodies.pose[i].x = 2.0 * static_cast<double>(i);
    }
    contacts.a = {0, 1};
    contacts.b = {1, 2};
    contacts.shape_a = contacts.shape_b = {0, 0};
    contacts.gap = {0.0, 0.0};
    contacts.normal = {{1.0, 0.0}, {1.0, 0.0}};
    contacts.lever_a = contacts.lever_b = {1.0, 1.0};
    contacts.site = {{1.0, 0.0}, {3.0, 0.0}};
    contacts.flat = {0, 0};
    contacts.friction = contacts.restitution = {0.0, 0.0};
    description.name = "spoilt";
    description.version = "1";
  }

  AdapterDescription Describe() const override { return description; }
  void ReadBodies(BodyTable* target) override {
    if (throws == "read") throw std::runtime_error("the bodies are on strike");
    *target = bodies;
  }
  void DetectContacts(const PoseView& poses, double alert, ContactTable* target) override {
    seen_alert = alert;
    seen_ids.assign(poses.id.begin(), poses.id.end());
    if (throws == "detect") throw Error("the eyes are closed");
    *target = contacts;
  }
  void Commit(const StepResult& result) override {
    ++commits;
    committed_id.assign(result.id.begin(), result.id.end());
    committed_pose.assign(result.pose.begin(), result.pose.end());
    keys.assign(result.key.begin(), result.key.end());
    impulses.assign(result.impulse.begin(), result.impulse.end());
  }
  BodyTransport* transport() override { return description.distributed_bodies ? this : nullptr; }
  void Pack(std::int64_t id, std::vector<std::byte>* bytes) override { bytes->assign(3, static_cast<std::byte>(id)); }
  void Insert(std::int64_t id, std::span<const std::byte> bytes) override {
    inserted = id;
    insert_size = bytes.size();
  }
  void Remove(std::int64_t) override { throw Error("there is no such body"); }

  AdapterDescription description;
  BodyTable bodies;
  ContactTable contacts;
  std::string throws;
  double seen_alert = 0.0;
  std::vector<std::int64_t> seen_ids, committed_id;
  std::vector<Pose> committed_pose;
  std::vector<ContactKey> keys;
  std::vector<Vec2> impulses;
  int commits = 0;
  std::int64_t inserted = -1;
  std::size_t insert_size = 0;
};

}  // namespace nscdd

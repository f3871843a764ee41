// SPDX-License-Identifier: Apache-2.0
#include "validator/two_disk_host.h"

#include <cmath>

#include "layout.h"

namespace nscdd {
namespace {

constexpr std::int64_t kIds[] = {3, 7};
constexpr std::uint8_t kKinds[] = {0, 0};
constexpr double kMasses[] = {TwoDiskHost::kMass, TwoDiskHost::kMass};
constexpr double kInertia = 0.5 * TwoDiskHost::kMass * TwoDiskHost::kRadius * TwoDiskHost::kRadius;
constexpr double kInertias[] = {kInertia, kInertia};
constexpr double kRadii[] = {TwoDiskHost::kRadius, TwoDiskHost::kRadius};
constexpr double kForces[6] = {};
constexpr std::int32_t kShape = 0;
constexpr std::uint8_t kFlat = 0;
constexpr double kFriction = 0.3;
constexpr double kRestitution = 0.0;

}  // namespace

struct TwoDiskHost::Functions {
  static TwoDiskHost& Self(void* user) { return *static_cast<TwoDiskHost*>(user); }

  static std::int32_t Describe(void* user, nscdd_host_description* d) {
    *d = {"two_disks", "1", 0, 0, 0, 0, 0.0, 0.0};
    return Self(user).Result("describe");
  }

  static std::int32_t ReadBodies(void* user, nscdd_bodies* bodies) {
    TwoDiskHost& self = Self(user);
    *bodies = {2, kIds, kKinds, kMasses, kInertias, kRadii, kRadii, self.pose_.data(), self.velocity_.data(), kForces};
    return self.Result("read_bodies");
  }

  static std::int32_t DetectContacts(void* user, std::uint64_t count, const std::int64_t* id, const double* pose,
                                     double alert_distance, nscdd_contacts* contacts) {
    TwoDiskHost& self = Self(user);
    *contacts = {};
    if (count != 2 || id[0] != kIds[0] || id[1] != kIds[1]) {
      self.last_error_ = "detect_contacts was not given the bodies of read_bodies";
      return NSCDD_BAD_INPUT;
    }
    const double dx = pose[3] - pose[0], dy = pose[4] - pose[1], distance = std::hypot(dx, dy);
    self.detected_gap_ = distance - 2.0 * kRadius;
    if (self.detected_gap_ <= alert_distance) self.Show(distance, dx, dy, pose, contacts);
    return self.Result("detect_contacts");
  }

  static std::int32_t Commit(void* user, const nscdd_step_result* result) {
    TwoDiskHost& self = Self(user);
    const std::int32_t ok = self.Result("commit");
    if (ok != NSCDD_OK) return ok;
    if (result->body_count != 2 || result->id[0] != kIds[0] || result->id[1] != kIds[1]) {
      self.last_error_ = "commit was not given the bodies of read_bodies";
      return NSCDD_BAD_INPUT;
    }
    for (std::size_t i = 0; i < 6; ++i) {
      self.pose_[i] = result->pose[i];
      self.velocity_[i] = result->velocity[i];
    }
    ++self.commits_;
    return NSCDD_OK;
  }

  static const char* LastError(void* user) { return Self(user).last_error_.c_str(); }
};

void TwoDiskHost::Show(double distance, double dx, double dy, const double* pose, nscdd_contacts* contacts) {
  lever_ = 0.5 * distance;
  normal_ = {dx / distance, dy / distance};
  site_ = {0.5 * (pose[0] + pose[3]), 0.5 * (pose[1] + pose[4])};
  contacts->count = 1;
  contacts->a = &row_a_;
  contacts->b = &row_b_;
  contacts->shape_a = contacts->shape_b = &kShape;
  contacts->gap = &detected_gap_;
  contacts->normal = normal_.data();
  contacts->lever_a = contacts->lever_b = &lever_;
  contacts->site = site_.data();
  contacts->flat = &kFlat;
  contacts->friction = &kFriction;
  contacts->restitution = &kRestitution;
}

std::int32_t TwoDiskHost::Result(const char* function) {
  if (failing_ != function) return NSCDD_OK;
  last_error_ = sentence_;
  return NSCDD_FAILED;
}

void TwoDiskHost::FailIn(std::string function, std::string sentence) {
  failing_ = std::move(function);
  sentence_ = std::move(sentence);
}

double TwoDiskHost::gap() const { return std::hypot(pose_[3] - pose_[0], pose_[4] - pose_[1]) - 2.0 * kRadius; }

const nscdd_host* TwoDiskHost::table() {
  table_ = WithHeader<nscdd_host>();
  table_.user = this;
  table_.describe = Functions::Describe;
  table_.read_bodies = Functions::ReadBodies;
  table_.detect_contacts = Functions::DetectContacts;
  table_.commit = Functions::Commit;
  table_.last_error = Functions::LastError;
  return &table_;
}

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#include "nscdd/host/adapter_host.h"

#include "layout.h"
#include "nscdd/error.h"

namespace nscdd {

std::int32_t AdapterHost::Guard(const std::function<void()>& function) noexcept {
  const auto say = [this](const char* sentence) {
    try {
      sentence_ = sentence;
    } catch (...) {
      sentence_.clear();
    }
  };
  try {
    function();
    return NSCDD_OK;
  } catch (const std::exception& e) {
    say(e.what());
  } catch (...) {
    say("the adapter threw something that is no std::exception");
  }
  return NSCDD_FAILED;
}

struct AdapterHost::Functions {
  static AdapterHost& Self(void* user) { return *static_cast<AdapterHost*>(user); }

  static std::int32_t Describe(void* user, nscdd_host_description* target) {
    AdapterHost& self = Self(user);
    return self.Guard([&] {
      self.description_ = self.adapter_->Describe();
      const AdapterDescription& d = self.description_;
      *target = {d.name.c_str(), d.version.c_str(), d.distributed_bodies, d.prescribed_motion, d.clusters, 0,
                 d.period,       d.period_origin};
    });
  }

  static std::int32_t ReadBodies(void* user, nscdd_bodies* target) {
    AdapterHost& self = Self(user);
    return self.Guard([&] {
      self.adapter_->ReadBodies(&self.bodies_);
      const BodyTable& b = self.bodies_;
      target->count = b.size();
      target->id = b.id.data();
      target->kind = reinterpret_cast<const std::uint8_t*>(b.kind.data());
      target->mass = b.mass.data();
      target->inertia = b.inertia.data();
      target->radius = b.radius.data();
      target->bounding_radius = b.bounding_radius.data();
      target->pose = AsDoubles(b.pose.data());
      target->velocity = AsDoubles(b.velocity.data());
      target->force = AsDoubles(b.force.data());
    });
  }

  static std::int32_t DetectContacts(void* user, std::uint64_t count, const std::int64_t* id, const double* pose,
                                     double alert_distance, nscdd_contacts* target) {
    AdapterHost& self = Self(user);
    return self.Guard([&] {
      const PoseView poses{{id, count}, {reinterpret_cast<const Pose*>(pose), count}};
      self.adapter_->DetectContacts(poses, alert_distance, &self.contacts_);
      *target = ShowContacts(self.contacts_);
    });
  }

  static std::int32_t SweepContacts(void* user, std::uint64_t count, const std::int64_t* id, const double* pose,
                                    const double* velocity, const double* reach, double dt, nscdd_contacts* target,
                                    const double** moment) {
    AdapterHost& self = Self(user);
    return self.Guard([&] {
      ContactTable& found = self.contacts_;
      self.adapter_->SweepContacts({{id, count},
                                    {reinterpret_cast<const Pose*>(pose), count},
                                    {reinterpret_cast<const Twist*>(velocity), count},
                                    {reach, count},
                                    dt},
                                   &found);
      if (!found.has_moments()) found.moment.assign(found.size(), 0.0);
      *target = ShowContacts(found);
      *moment = found.moment.data();
    });
  }

  static std::int32_t Commit(void* user, const nscdd_step_result* result) {
    AdapterHost& self = Self(user);
    return self.Guard([&] {
      self.keys_.resize(result->contact_count);
      for (std::size_t i = 0; i < self.keys_.size(); ++i) {
        const std::int64_t* body = result->contact_body + 2 * i;
        const std::int32_t* shape = result->contact_shape + 3 * i;
        self.keys_[i] = {body[0], body[1], shape[0], shape[1], shape[2]};
      }
      const auto count = static_cast<std::size_t>(result->body_count);
      self.adapter_->Commit({{result->id, count},
                             {reinterpret_cast<const Pose*>(result->pose), count},
                             {reinterpret_cast<const Twist*>(result->velocity), count},
                             self.keys_,
                             {reinterpret_cast<const Vec2*>(result->impulse), self.keys_.size()}});
    });
  }

  static BodyTransport& Transport(AdapterHost& self) {
    BodyTransport* transport = self.adapter_->transport();
    if (transport == nullptr) throw Error("the adapter has no transport(); its description must not say distributed_bodies");
    return *transport;
  }

  static std::int32_t Pack(void* user, std::int64_t id, const void** bytes, std::uint64_t* size) {
    AdapterHost& self = Self(user);
    return self.Guard([&] {
      self.packed_.clear();
      Transport(self).Pack(id, &self.packed_);
      *bytes = self.packed_.data();
      *size = self.packed_.size();
    });
  }

  static std::int32_t Insert(void* user, std::int64_t id, const void* bytes, std::uint64_t size) {
    AdapterHost& self = Self(user);
    return self.Guard([&] { Transport(self).Insert(id, {static_cast<const std::byte*>(bytes), size}); });
  }

  static std::int32_t Remove(void* user, std::int64_t id) {
    AdapterHost& self = Self(user);
    return self.Guard([&] { Transport(self).Remove(id); });
  }

  static const char* LastError(void* user) { return Self(user).sentence_.c_str(); }
};

AdapterHost::AdapterHost(PlatformAdapter* adapter) : adapter_(adapter) {
  table_ = WithHeader<nscdd_host>();
  table_.header.abi_minor = 3;
  table_.user = this;
  table_.describe = Functions::Describe;
  table_.read_bodies = Functions::ReadBodies;
  table_.detect_contacts = Functions::DetectContacts;
  table_.commit = Functions::Commit;
  table_.last_error = Functions::LastError;
  table_.sweep_contacts = Functions::SweepContacts;
  if (!adapter->Describe().distributed_bodies) return;
  table_.pack = Functions::Pack;
  table_.insert = Functions::Insert;
  table_.remove = Functions::Remove;
}

}  // namespace nscdd

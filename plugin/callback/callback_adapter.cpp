// SPDX-License-Identifier: Apache-2.0
#include "nscdd/callback/callback_adapter.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "array_copy.h"
#include "body_arrays.h"
#include "nscdd/callback/abi_check.h"
#include "nscdd/callback/contact_arrays.h"
#include "nscdd/error.h"

namespace nscdd {
namespace {

constexpr std::size_t kLongestName = 256;
constexpr std::size_t kLongestSentence = 4096;
constexpr std::uint64_t kLargestBody = std::uint64_t{1} << 30;  // [bytes] packed; MPI messages count in int

// A host's string may lack its terminator: read no further than `longest`.
std::string Bounded(const char* text, std::size_t longest) { return std::string(text, strnlen(text, longest)); }

const double* AsDoubles(const void* first) { return static_cast<const double*>(first); }

void CheckFunctions(const nscdd_host& host) {
  const auto need = [](bool present, const char* name) {
    if (!present) throw Error(fmt::format("nscdd_host: the function {} is null; a host must provide it", name));
  };
  need(host.describe != nullptr, "describe");
  need(host.read_bodies != nullptr, "read_bodies");
  need(host.detect_contacts != nullptr, "detect_contacts");
  need(host.commit != nullptr, "commit");
  need(host.last_error != nullptr, "last_error");
}

AdapterDescription Translate(const nscdd_host_description& d) {
  if (d.name == nullptr || d.version == nullptr) {
    throw Error("nscdd_host, function describe: name and version must not be null");
  }
  AdapterDescription description;
  description.name = Bounded(d.name, kLongestName);
  description.version = Bounded(d.version, kLongestName);
  description.distributed_bodies = d.distributed_bodies != 0;
  description.prescribed_motion = d.prescribed_motion != 0;
  description.clusters = d.clusters != 0;
  description.period = d.period;
  description.period_origin = d.period_origin;
  if (description.name.empty()) throw Error("nscdd_host, function describe: name is empty; give the platform a name");
  if (!std::isfinite(d.period) || d.period < 0.0 || !std::isfinite(d.period_origin)) {
    throw Error(
        fmt::format("host '{}', function describe: period {} m (>= 0, 0: not periodic) and period_origin {} m must be "
                    "finite",
                    description.name, d.period, d.period_origin));
  }
  return description;
}

void CheckColumns(const StepResult& result) {
  if (result.pose.size() == result.id.size() && result.velocity.size() == result.id.size() &&
      result.impulse.size() == result.key.size()) {
    return;
  }
  throw Error(
      fmt::format("Commit got {} ids, {} poses, {} velocities, {} contact keys and {} impulses; give one pose and velocity "
                  "for each id and one impulse for each key",
                  result.id.size(), result.pose.size(), result.velocity.size(), result.key.size(), result.impulse.size()));
}

void CheckFinite(const StepResult& result) {
  for (std::size_t i = 0; i < result.id.size(); ++i) {
    const Pose& q = result.pose[i];
    const Twist& v = result.velocity[i];
    if (std::isfinite(q.x + q.y + q.angle) && std::isfinite(v.vx + v.vy + v.spin)) continue;
    throw Error(
        fmt::format("the step gave body {} the pose ({}, {}, {}) and velocity ({}, {}, {}), which are not finite; nothing "
                    "was committed; reduce the time step or look at the masses and loads of this body",
                    result.id[i], q.x, q.y, q.angle, v.vx, v.vy, v.spin));
  }
  for (std::size_t i = 0; i < result.key.size(); ++i) {
    if (std::isfinite(result.impulse[i].x + result.impulse[i].y)) continue;
    throw Error(
        fmt::format("the step gave the contact of bodies {} and {} an impulse that is not finite; nothing was committed; "
                    "reduce the time step or look at the masses and loads of these bodies",
                    result.key[i].body_a, result.key[i].body_b));
  }
}

}  // namespace

class CallbackAdapter::Transport final : public BodyTransport {
 public:
  explicit Transport(const CallbackAdapter* adapter) : adapter_(*adapter) {}

  void Pack(std::int64_t id, std::vector<std::byte>* bytes) override {
    const void* packed = nullptr;
    std::uint64_t size = 0;
    adapter_.Call("pack", [&](const nscdd_host& host) { return host.pack(host.user, id, &packed, &size); });
    if (size > kLargestBody || (packed == nullptr && size > 0)) {
      throw Error(fmt::format("{}: body {}: {} bytes at {}; give a pointer that is not null and at most {} bytes",
                              adapter_.Who("pack"), id, size, packed == nullptr ? "null" : "a pointer", kLargestBody));
    }
    const auto* first = static_cast<const std::byte*>(packed);
    bytes->insert(bytes->end(), first, first + size);
  }

  void Insert(std::int64_t id, std::span<const std::byte> bytes) override {
    adapter_.Call("insert", [&](const nscdd_host& host) { return host.insert(host.user, id, bytes.data(), bytes.size()); });
  }

  void Remove(std::int64_t id) override {
    adapter_.Call("remove", [&](const nscdd_host& host) { return host.remove(host.user, id); });
  }

 private:
  const CallbackAdapter& adapter_;
};

CallbackAdapter::CallbackAdapter(const nscdd_host* host) : host_(host) {
  if (host == nullptr) throw Error("the host is a null pointer; give the address of an nscdd_host");
  CheckAbiHeader(host->header, HostSize(host->header.abi_minor), "nscdd_host");
  CheckFunctions(*host);
  nscdd_host_description description{};
  Call("describe", [&](const nscdd_host& h) { return h.describe(h.user, &description); });
  description_ = Translate(description);
  if (!description_.distributed_bodies) return;
  if (host->pack == nullptr || host->insert == nullptr || host->remove == nullptr) {
    throw Error(
        fmt::format("host '{}' says distributed_bodies, but one of pack, insert and remove is null", description_.name));
  }
  transport_ = std::make_unique<Transport>(this);
}

CallbackAdapter::~CallbackAdapter() = default;

std::string CallbackAdapter::Who(const char* function) const {
  return fmt::format("host '{}', function {}", description_.name.empty() ? "?" : description_.name, function);
}

template <class Function>
void CallbackAdapter::Call(const char* function, Function&& call) const {
  std::int32_t result = NSCDD_FAILED;
  try {
    result = call(*host_);
  } catch (...) {
    throw Error(
        fmt::format("{}: it threw a C++ exception through the C interface; catch it there and return NSCDD_FAILED with a "
                    "sentence in last_error",
                    Who(function)));
  }
  if (result == NSCDD_OK) return;
  const char* sentence = host_->last_error(host_->user);
  throw Error(fmt::format("{}: {} (result {})", Who(function),
                          sentence == nullptr || *sentence == '\0' ? "it failed and last_error gave no sentence"
                                                                   : Bounded(sentence, kLongestSentence),
                          result));
}

void CallbackAdapter::ReadBodies(BodyTable* bodies) {
  nscdd_bodies arrays{};
  Call("read_bodies", [&](const nscdd_host& host) { return host.read_bodies(host.user, &arrays); });
  CopyBodies(arrays, Who("read_bodies"), bodies);
}

void CallbackAdapter::DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) {
  nscdd_contacts arrays{};
  Call("detect_contacts", [&](const nscdd_host& host) {
    return host.detect_contacts(host.user, poses.id.size(), poses.id.data(), AsDoubles(poses.pose.data()), alert, &arrays);
  });
  CopyFound(arrays, poses.id.size(), Who("detect_contacts"), contacts);
}

void CallbackAdapter::CopyFound(const nscdd_contacts& arrays, std::size_t bodies, const std::string& who,
                                ContactTable* contacts) const {
  CopyContacts(arrays, bodies, {}, who, contacts);
  contacts->moment.clear();
  if (contacts->has_images() && description_.period == 0.0) {
    throw Error(fmt::format("{}: it gives images, but describe says that it is not periodic; leave image null", who));
  }
}

void CallbackAdapter::SweepContacts(const MotionView& motion, ContactTable* contacts) {
  if (host_->header.abi_minor < 3 || host_->sweep_contacts == nullptr) {
    PlatformAdapter::SweepContacts(motion, contacts);
    return;
  }
  nscdd_contacts arrays{};
  const double* moment = nullptr;
  Call("sweep_contacts", [&](const nscdd_host& host) {
    return host.sweep_contacts(host.user, motion.id.size(), motion.id.data(), AsDoubles(motion.pose.data()),
                               AsDoubles(motion.velocity.data()), motion.reach.data(), motion.dt, &arrays, &moment);
  });
  const std::string who = Who("sweep_contacts");
  CopyFound(arrays, motion.id.size(), who, contacts);
  CopyColumn(moment, "moment", contacts->size(), who, &contacts->moment);
}

void CallbackAdapter::Commit(const StepResult& result) {
  CheckColumns(result);
  CheckFinite(result);
  contact_body_.clear();
  contact_shape_.clear();
  contact_body_.reserve(2 * result.key.size());
  contact_shape_.reserve(3 * result.key.size());
  for (const ContactKey& key : result.key) {
    contact_body_.insert(contact_body_.end(), {key.body_a, key.body_b});
    contact_shape_.insert(contact_shape_.end(), {key.shape_a, key.shape_b, key.image});
  }
  nscdd_step_result arrays{};
  arrays.body_count = result.id.size();
  arrays.id = result.id.data();
  arrays.pose = AsDoubles(result.pose.data());
  arrays.velocity = AsDoubles(result.velocity.data());
  arrays.contact_count = result.key.size();
  arrays.contact_body = contact_body_.data();
  arrays.contact_shape = contact_shape_.data();
  arrays.impulse = AsDoubles(result.impulse.data());
  Call("commit", [&](const nscdd_host& host) { return host.commit(host.user, &arrays); });
}

BodyTransport* CallbackAdapter::transport() { return transport_.get(); }

}  // namespace nscdd

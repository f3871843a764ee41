// SPDX-License-Identifier: Apache-2.0
#include "broken_adapter.h"

#include <utility>

namespace nscdd::conformance {

class BrokenAdapter::BrokenTransport final : public BodyTransport {
 public:
  BrokenTransport(BodyTransport* whole, const Fault* fault) : whole_(whole), fault_(fault) {}

  void Pack(std::int64_t id, std::vector<std::byte>* bytes) override { whole_->Pack(id, bytes); }
  void Insert(std::int64_t id, std::span<const std::byte> bytes) override {
    fault_->insert ? fault_->insert(whole_, id, bytes) : whole_->Insert(id, bytes);
  }
  void Remove(std::int64_t id) override { fault_->remove ? fault_->remove(whole_, id) : whole_->Remove(id); }

 private:
  BodyTransport* whole_;
  const Fault* fault_;
};

Fault SpoilBodies(std::string name, std::function<void(BodyTable*)> spoil) {
  Fault fault;
  fault.name = std::move(name);
  fault.read = [spoil = std::move(spoil)](PlatformAdapter* whole, BodyTable* bodies) {
    whole->ReadBodies(bodies);
    spoil(bodies);
  };
  return fault;
}

Fault SpoilContacts(std::string name, std::function<void(const PoseView&, ContactTable*)> spoil) {
  Fault fault;
  fault.name = std::move(name);
  fault.sweep = [spoil](PlatformAdapter* whole, const MotionView& motion, ContactTable* contacts) {
    whole->SweepContacts(motion, contacts);
    if (contacts->size() > 0) spoil({motion.id, motion.pose}, contacts);
  };
  fault.detect = [spoil = std::move(spoil)](PlatformAdapter* whole, const PoseView& poses, double alert,
                                            ContactTable* contacts) {
    whole->DetectContacts(poses, alert, contacts);
    if (contacts->size() > 0) spoil(poses, contacts);
  };
  return fault;
}

BrokenAdapter::BrokenAdapter(PlatformAdapter* whole, const Fault& fault) : whole_(whole), fault_(fault) {
  if (whole->transport() != nullptr) transport_ = std::make_unique<BrokenTransport>(whole->transport(), &fault_);
}

BrokenAdapter::~BrokenAdapter() = default;

AdapterDescription BrokenAdapter::Describe() const { return fault_.describe ? fault_.describe(*whole_) : whole_->Describe(); }

void BrokenAdapter::ReadBodies(BodyTable* bodies) { fault_.read ? fault_.read(whole_, bodies) : whole_->ReadBodies(bodies); }

void BrokenAdapter::DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) {
  fault_.detect ? fault_.detect(whole_, poses, alert, contacts) : whole_->DetectContacts(poses, alert, contacts);
}

void BrokenAdapter::SweepContacts(const MotionView& motion, ContactTable* contacts) {
  fault_.sweep ? fault_.sweep(whole_, motion, contacts) : whole_->SweepContacts(motion, contacts);
}

void BrokenAdapter::Commit(const StepResult& result) { fault_.commit ? fault_.commit(whole_, result) : whole_->Commit(result); }

BodyTransport* BrokenAdapter::transport() { return transport_.get(); }

}  // namespace nscdd::conformance

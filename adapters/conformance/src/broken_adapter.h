// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "nscdd/platform_adapter.h"

namespace nscdd::conformance {

/// One way to break an adapter. Each function that is set takes the place of the adapter's; state lies in its closure, of which
/// every broken adapter has a copy.
struct Fault {
  std::string name;
  std::function<AdapterDescription(const PlatformAdapter&)> describe;
  std::function<void(PlatformAdapter*, BodyTable*)> read;
  std::function<void(PlatformAdapter*, const PoseView&, double, ContactTable*)> detect;
  std::function<void(PlatformAdapter*, const MotionView&, ContactTable*)> sweep;
  std::function<void(PlatformAdapter*, const StepResult&)> commit;
  std::function<void(BodyTransport*, std::int64_t, std::span<const std::byte>)> insert;
  std::function<void(BodyTransport*, std::int64_t)> remove;
};

/// Faults that spoil what a correct adapter gave.
Fault SpoilBodies(std::string name, std::function<void(BodyTable*)> spoil);
Fault SpoilContacts(std::string name, std::function<void(const PoseView&, ContactTable*)> spoil);

/// A correct adapter with one fault.
class BrokenAdapter final : public PlatformAdapter {
 public:
  BrokenAdapter(PlatformAdapter* whole, const Fault& fault);
  ~BrokenAdapter() override;

  AdapterDescription Describe() const override;
  void ReadBodies(BodyTable* bodies) override;
  void DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) override;
  void SweepContacts(const MotionView& motion, ContactTable* contacts) override;
  void Commit(const StepResult& result) override;
  BodyTransport* transport() override;

 private:
  class BrokenTransport;
  PlatformAdapter* whole_;
  Fault fault_;
  std::unique_ptr<BrokenTransport> transport_;
};

}  // namespace nscdd::conformance

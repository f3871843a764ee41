// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "nscdd/platform_adapter.h"
#include "nscdd_plugin.h"

namespace nscdd {

/// PlatformAdapter over the C function table of the plugin ABI (nscdd_host): any platform, in any language.
///
/// Everything that the host hands out is copied. What only this class can see is checked here (null pointers, counts, rows,
/// kinds, ids, results, exceptions), the numbers are checked by the core as for every adapter. Every refusal names host and
/// function.
class CallbackAdapter final : public PlatformAdapter {
 public:
  /// Keeps the pointer: the table must outlive the adapter. Calls `describe`. Throws Error when the header is of another ABI or
  /// truncated, when a function is missing, and when the description cannot be used.
  explicit CallbackAdapter(const nscdd_host* host);
  ~CallbackAdapter() override;

  AdapterDescription Describe() const override { return description_; }
  void ReadBodies(BodyTable* bodies) override;
  void DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) override;
  /// By detect_contacts, where the host is older than sweep_contacts or does not have it.
  void SweepContacts(const MotionView& motion, ContactTable* contacts) override;
  /// Also throws Error, before the host is told anything, when a result is not finite.
  void Commit(const StepResult& result) override;
  BodyTransport* transport() override;

 private:
  class Transport;

  template <class Function>
  void Call(const char* function, Function&& call) const;
  std::string Who(const char* function) const;
  void CopyFound(const nscdd_contacts& arrays, std::size_t bodies, const std::string& who, ContactTable* contacts) const;

  const nscdd_host* host_;
  AdapterDescription description_;
  std::unique_ptr<Transport> transport_;
  std::vector<std::int64_t> contact_body_;  // scratch of Commit
  std::vector<std::int32_t> contact_shape_;
};

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "nscdd/platform_adapter.h"
#include "nscdd_plugin.h"

namespace nscdd {

/// Shows a PlatformAdapter as the C table that a plugin wants. Columns are handed out without a copy; exceptions of the adapter
/// become NSCDD_FAILED and a sentence.
class AdapterHost {
 public:
  /// Keeps the pointer; both must outlive every solver made with table().
  explicit AdapterHost(PlatformAdapter* adapter);
  AdapterHost(const AdapterHost&) = delete;
  AdapterHost& operator=(const AdapterHost&) = delete;

  const nscdd_host* table() const { return &table_; }

 private:
  struct Functions;  // what the table points to
  std::int32_t Guard(const std::function<void()>& function) noexcept;

  PlatformAdapter* adapter_;
  nscdd_host table_{};
  AdapterDescription description_;
  BodyTable bodies_;
  ContactTable contacts_;
  std::vector<ContactKey> keys_;
  std::vector<std::byte> packed_;
  std::string sentence_;
};

}  // namespace nscdd

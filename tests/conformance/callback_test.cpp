// SPDX-License-Identifier: Apache-2.0
// The callback adapter over the reference platform shown as a C table.
#include "nscdd/callback/callback_adapter.h"
#include "nscdd/host/adapter_host.h"
#include "reference_host.h"

namespace nscdd {
namespace {

class CallbackHost final : public ReferenceHost {
 public:
  explicit CallbackHost(double period) : ReferenceHost(period) {}
  PlatformAdapter* adapter() override { return &callback_; }

 private:
  AdapterHost table_{ReferenceHost::adapter()};
  CallbackAdapter callback_{table_.table()};
};

}  // namespace
}  // namespace nscdd

int main(int argc, char** argv) {
  return nscdd::conformance::Main(argc, argv, [](double period) { return std::make_unique<nscdd::CallbackHost>(period); });
}

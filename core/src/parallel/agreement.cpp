// SPDX-License-Identifier: Apache-2.0
#include "nscdd/agreement.h"

#include <fmt/format.h>

#include <cstring>
#include <string>

#include "nscdd/error.h"

namespace nscdd {

void RunTogether(Communicator* communicator, const std::function<void()>& work) {
  if (communicator->size() == 1) return work();
  // The lowest rank that failed speaks for all.
  bool failed = true;
  std::string sentence;
  try {
    work();
    failed = false;
  } catch (const std::exception& e) {
    sentence = e.what();
  } catch (...) {
    sentence = "an unknown exception was thrown";
  }
  double failing = failed ? communicator->rank() : communicator->size();
  communicator->AllReduceMin({&failing, 1});
  const int root = static_cast<int>(failing);
  if (root == communicator->size()) return;
  std::vector<std::byte> bytes(sentence.size());
  if (!sentence.empty()) std::memcpy(bytes.data(), sentence.data(), sentence.size());
  communicator->Broadcast(root, &bytes);
  throw Error(fmt::format("rank {}: {}", root, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())));
}

}  // namespace nscdd

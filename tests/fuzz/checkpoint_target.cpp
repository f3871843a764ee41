// SPDX-License-Identifier: Apache-2.0
// Checkpoint files: as they are, and with a size and a checksum that fit, so that what they hold is met as well.
#include <cstring>
#include <span>
#include <vector>

#include "checkpoint/checkpoint.h"
#include "results/crc64.h"
#include "target.h"

namespace nscdd {
namespace {

/// Reads all that a checkpoint says.
void Read(std::span<const std::byte> bytes) {
  const Checkpoint checkpoint = ParseCheckpoint(bytes);
  double sum = 0.0;
  for (const CheckpointSection& section : checkpoint.sections) {
    for (std::size_t i = 0; i < section.body_count(); ++i) sum += section.body(i).pose.x;
    for (const std::byte byte : section.state) sum += static_cast<double>(byte);
  }
  volatile double seen = sum;
  (void)seen;
  if (FormatHead(ParseHead(FormatHead(checkpoint.head))) != FormatHead(checkpoint.head))
    fuzz::Fail("a head is read back as another one");
}

std::vector<std::byte> Sealed(std::vector<std::byte> bytes) {
  constexpr std::size_t kSizeAt = 16, kPrologue = 32;
  if (bytes.size() < kPrologue + 8) return bytes;
  const std::uint64_t size = bytes.size();
  std::memcpy(&bytes[kSizeAt], &size, sizeof size);
  Crc64 crc;
  crc.Add(std::span(bytes).first(bytes.size() - 8));
  const std::uint64_t sum = crc.value();
  std::memcpy(&bytes[bytes.size() - 8], &sum, sizeof sum);
  return bytes;
}

}  // namespace
}  // namespace nscdd

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nscdd;
  const auto* first = reinterpret_cast<const std::byte*>(data);
  const std::vector<std::byte> bytes(first, first + size);
  fuzz::Accepts([&] { Read(bytes); });
  fuzz::Accepts([&] { Read(Sealed(bytes)); });
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
#include "state/state_file.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <fstream>

#include "nscdd/error.h"
#include "results/crc64.h"
#include "results/mapped_file.h"
#include "results/written_file.h"

namespace nscdd {
namespace {

constexpr std::array<char, 8> kMark = {'n', 's', 'c', 'd', 'd', 's', 't', 'a'};
constexpr std::uint32_t kByteOrder = 0x01020304;

/// Zeros follow, up to kSealSize.
struct SealBlock {
  std::array<char, 8> mark = kMark;
  std::uint32_t version = kStateVersion;
  std::uint32_t byte_order = kByteOrder;
  std::uint64_t size = 0;  ///< of the file
  std::uint64_t crc = 0;   ///< CRC-64/XZ of all behind the seal
};
static_assert(sizeof(SealBlock) == 32);

std::uint64_t ChecksumOf(std::span<const std::byte> bytes) { return Crc64Of(bytes.subspan(kSealSize)); }

}  // namespace

void Seal(const std::filesystem::path& path) {
  SealBlock seal;
  {
    const MappedFile file(path);
    seal.size = file.bytes().size();
    seal.crc = ChecksumOf(file.bytes());
  }
  std::fstream stream(path, std::ios::binary | std::ios::in | std::ios::out);
  std::array<char, kSealSize> block{};
  std::memcpy(block.data(), &seal, sizeof seal);
  stream.write(block.data(), block.size());
  stream.close();
  if (!stream) throw Error(CannotWrite(path, errno));
}

std::uint64_t CheckSeal(std::span<const std::byte> bytes) {
  SealBlock seal;
  if (bytes.size() >= sizeof seal) std::memcpy(&seal, bytes.data(), sizeof seal);
  if (bytes.size() < sizeof seal || seal.mark != kMark) throw Error("it is no state file of nscdd (a run's state.h5)");
  if (seal.byte_order != kByteOrder) throw Error("it is damaged, or of a machine with another byte order");
  if (seal.version != kStateVersion) {
    throw Error(fmt::format("it is damaged, or of format version {}; this program reads {}", seal.version, kStateVersion));
  }
  if (seal.size != bytes.size() || seal.size < kSealSize) {
    throw Error(fmt::format("it has {} bytes, {} were written", bytes.size(), seal.size));
  }
  if (ChecksumOf(bytes) != seal.crc) throw Error("it is damaged: its checksum is another one");
  return seal.crc;
}

}  // namespace nscdd

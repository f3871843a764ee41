// SPDX-License-Identifier: Apache-2.0
#include "results/crc64.h"

#include <array>
#include <bit>
#include <cstring>

namespace nscdd {
namespace {

constexpr std::uint64_t kPolynomial = 0xC96C5795D7870F42;  // of ECMA-182, bits reversed
constexpr int kSlices = 8;                                 // bytes taken at a time

using Tables = std::array<std::array<std::uint64_t, 256>, kSlices>;

/// tables[s][b]: what the byte b does to the register when s more bytes follow it.
constexpr Tables MakeTables() {
  Tables tables{};
  for (std::uint64_t byte = 0; byte < 256; ++byte) {
    std::uint64_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1) ^ ((rest & 1) != 0 ? kPolynomial : 0);
    tables[0][byte] = rest;
  }
  for (int s = 1; s < kSlices; ++s) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint64_t before = tables[s - 1][byte];
      tables[s][byte] = (before >> 8) ^ tables[0][before & 0xFF];
    }
  }
  return tables;
}

constexpr Tables kTables = MakeTables();
static_assert(std::endian::native == std::endian::little, "eight bytes at a time are read as a little-endian word");

}  // namespace

void Crc64::Add(std::span<const std::byte> bytes) {
  std::uint64_t crc = register_;
  for (; bytes.size() >= kSlices; bytes = bytes.subspan(kSlices)) {
    std::uint64_t word;
    std::memcpy(&word, bytes.data(), sizeof word);
    word ^= crc;
    crc = 0;
    for (int s = 0; s < kSlices; ++s) crc ^= kTables[kSlices - 1 - s][(word >> (8 * s)) & 0xFF];
  }
  for (const std::byte byte : bytes) crc = (crc >> 8) ^ kTables[0][(crc ^ static_cast<std::uint64_t>(byte)) & 0xFF];
  register_ = crc;
}

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <lzma.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace nscdd {

/// CRC-64/XZ of bytes that come in any pieces.
class Crc64 {
 public:
  void Add(std::span<const std::byte> bytes) {
    value_ = lzma_crc64(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), value_);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0;
};

/// Of all of them.
inline std::uint64_t Crc64Of(std::span<const std::byte> bytes) {
  Crc64 crc;
  crc.Add(bytes);
  return crc.value();
}

}  // namespace nscdd

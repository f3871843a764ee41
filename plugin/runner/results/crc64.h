// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace nscdd {

/// CRC-64/XZ (ECMA-182, reflected), of bytes that come in any pieces. It notices every error within 64 consecutive bits.
class Crc64 {
 public:
  void Add(std::span<const std::byte> bytes);
  std::uint64_t value() const { return ~register_; }

 private:
  std::uint64_t register_ = ~std::uint64_t{0};
};

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace nscdd::fuzz {

/// Reads an input as numbers; zeros behind its end.
class ByteSource {
 public:
  ByteSource(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  bool empty() const { return next_ >= size_; }
  std::uint8_t Byte() { return next_ < size_ ? data_[next_++] : std::uint8_t{0}; }
  /// From 0 to most.
  std::size_t UpTo(std::size_t most) { return Byte() % (most + 1); }
  /// True for one byte in 16, never behind the end: most of an input makes sense, so that it gets far.
  bool Rarely() { return Byte() % 16 == 15; }

  std::uint64_t Word() {
    std::uint64_t word = 0;
    for (int k = 0; k < 8; ++k) word = word << 8 | Byte();
    return word;
  }

  /// Mostly a usual positive number, sometimes any.
  double Positive() {
    const std::uint8_t b = Byte();
    if (b < 240) return (1.0 + b) / 64.0;
    constexpr double kOdd[] = {0.0,
                               -1.0,
                               1e-300,
                               1e300,
                               5e-324,
                               1e-9,
                               1e9,
                               std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity()};
    const std::size_t k = b - 240u;
    return k < std::size(kOdd) ? kOdd[k] : std::bit_cast<double>(Word());
  }
  /// The same with both signs.
  double Number() {
    const double x = Positive();
    return Byte() % 2 == 0 ? x : -x;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t next_ = 0;
};

}  // namespace nscdd::fuzz

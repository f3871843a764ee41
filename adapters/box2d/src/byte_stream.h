// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "nscdd/error.h"

namespace nscdd::box2d {

/// Appends plain values.
class Writer {
 public:
  explicit Writer(std::vector<std::byte>* bytes) : bytes_(bytes) {}
  template <typename T>
  requires std::is_trivially_copyable_v<T>
  void Put(const T& value) {
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes_->insert(bytes_->end(), first, first + sizeof(T));
  }
  template <typename T>
  void PutArray(const T* values, std::size_t count) {
    Put(static_cast<std::uint32_t>(count));
    for (std::size_t i = 0; i < count; ++i) Put(values[i]);
  }

 private:
  std::vector<std::byte>* bytes_;
};

/// Takes them off again; throws Error that names body `id` when there are too few bytes.
class Reader {
 public:
  Reader(std::span<const std::byte> bytes, std::int64_t id) : bytes_(bytes), id_(id) {}
  template <typename T>
  requires std::is_trivially_copyable_v<T> T Get() {
    if (bytes_.size() < sizeof(T)) Fail("end too early");
    T value;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_ = bytes_.subspan(sizeof(T));
    return value;
  }
  template <typename T>
  std::vector<T> GetArray() {
    const auto count = Get<std::uint32_t>();
    if (bytes_.size() < std::size_t{count} * sizeof(T)) Fail("end too early");
    std::vector<T> values(count);
    for (T& value : values) value = Get<T>();
    return values;
  }
  void ExpectEnd() const {
    if (!bytes_.empty()) Fail("go on behind the end");
  }
  [[noreturn]] void Fail(const char* what) const {
    throw Error(fmt::format("The bytes for Box2D body {} {}: give Insert exactly what Pack of this version wrote.", id_, what));
  }

 private:
  std::span<const std::byte> bytes_;
  std::int64_t id_;
};

}  // namespace nscdd::box2d

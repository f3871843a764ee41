// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "nscdd/error.h"

namespace nscdd {

/// Appends plain values to a buffer.
class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::byte>* bytes) : bytes_(bytes) {}

  template <class T>
  void Put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    Append(&value, sizeof(T));
  }

  template <class T>
  void PutSpan(std::span<const T> values) {
    Put(static_cast<std::uint64_t>(values.size()));
    if (!values.empty()) Append(values.data(), values.size_bytes());
  }

 private:
  void Append(const void* from, std::size_t size) {
    const std::size_t end = bytes_->size();
    bytes_->resize(end + size);
    std::memcpy(bytes_->data() + end, from, size);
  }

  std::vector<std::byte>* bytes_;
};

/// Reads them back in the same order. Throws Error when the buffer is too short.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  bool empty() const { return bytes_.empty(); }

  template <class T>
  T Get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    std::memcpy(&value, Take(sizeof(T)).data(), sizeof(T));
    return value;
  }

  template <class T>
  std::vector<T> GetVector() {
    const auto count = Get<std::uint64_t>();
    if (count > bytes_.size() / sizeof(T)) throw Error("a message or saved state is shorter than it says it is");
    std::vector<T> values(count);
    const auto raw = Take(count * sizeof(T));
    if (count > 0) std::memcpy(values.data(), raw.data(), raw.size());
    return values;
  }

  std::span<const std::byte> Take(std::size_t size) {
    if (size > bytes_.size()) throw Error("a message or saved state is shorter than it says it is");
    const auto head = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return head;
  }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hdf5.h>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "results/rank_group.h"

namespace nscdd {

/// Owns one HDF5 object.
class Hdf5Handle {
 public:
  using Closer = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  /// Throws Error "cannot WHAT: HDF5's reason" if `id` is not valid.
  Hdf5Handle(hid_t id, Closer closer, const std::string& what);
  ~Hdf5Handle() { Reset(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), closer_(other.closer_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(closer_, other.closer_);
    return *this;
  }

  hid_t id() const { return id_; }
  bool is_open() const { return id_ >= 0; }
  /// Closes it now, to learn whether that went well.
  void Close(const std::string& what);

 private:
  void Reset() {
    if (id_ >= 0) closer_(id_);
    id_ = H5I_INVALID_HID;
  }

  hid_t id_ = H5I_INVALID_HID;
  Closer closer_ = nullptr;
};

/// Throws Error "cannot WHAT: HDF5's reason" if `status` is negative.
void CheckHdf5(herr_t status, const std::string& what);

/// HDF5 prints its errors by itself; not while this lives.
class Hdf5Silence {
 public:
  Hdf5Silence();
  ~Hdf5Silence();
  Hdf5Silence(const Hdf5Silence&) = delete;
  Hdf5Silence& operator=(const Hdf5Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// HDF5's name of an element type of our tables.
template <class T>
hid_t Hdf5TypeOf() {
  if constexpr (std::is_enum_v<T>) {
    return Hdf5TypeOf<std::underlying_type_t<T>>();
  } else if constexpr (std::is_same_v<T, double>) {
    return H5T_NATIVE_DOUBLE;
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    return H5T_NATIVE_INT64;
  } else if constexpr (std::is_same_v<T, std::int32_t>) {
    return H5T_NATIVE_INT32;
  } else {
    static_assert(std::is_same_v<T, std::uint8_t>);
    return H5T_NATIVE_UINT8;
  }
}

/// This rank's rows of a table whose rows are spread over the ranks, one rank's behind the lower ranks'.
struct RowRange {
  RowRange(const RankGroup& ranks, std::size_t rows);

  hsize_t first;
  hsize_t count;
  hsize_t total;  ///< of all ranks
};

/// Tables of columns and attributes in one HDF5 file. With several ranks all calls are collective (MPI-IO).
class Hdf5File {
 public:
  /// Creates the file, replacing one that is there. It begins with a user block of so many bytes (0, 512 or a power of two
  /// above), which HDF5 leaves alone.
  static Hdf5File Create(const std::filesystem::path& path, const RankGroup& ranks, hsize_t user_block = 0);
  /// Opens it for reading in one process.
  static Hdf5File Open(const std::filesystem::path& path);

  Hdf5Handle CreateGroup(const std::string& name);
  Hdf5Handle OpenGroup(const std::string& name) const;
  /// Names of the groups and data sets in a group, ascending.
  std::vector<std::string> Names(const Hdf5Handle& group) const;

  /// Copies a group with all that is in it from another file, under the same name.
  void Copy(const Hdf5File& from, const std::string& name);

  template <class T>
  void WriteColumn(const Hdf5Handle& group, const char* name, const char* unit, const std::vector<T>& column,
                   const RowRange& rows) {
    WriteTable(group, name, unit, Hdf5TypeOf<T>(), column.data(), rows, 1);
  }
  /// Plane vectors as rows (x, y, 0).
  void WriteVectors(const Hdf5Handle& group, const char* name, const char* unit, const std::vector<double>& x,
                    const std::vector<double>& y, const RowRange& rows);
  /// `width` numbers a row.
  void WriteRows(const Hdf5Handle& group, const char* name, const std::vector<std::int32_t>& numbers, const RowRange& rows,
                 int width) {
    WriteTable(group, name, "", H5T_NATIVE_INT32, numbers.data(), rows, static_cast<hsize_t>(width));
  }
  template <class T>
  void ReadColumn(const Hdf5Handle& group, const char* name, std::vector<T>* column) const {
    const Hdf5Handle data = OpenColumn(group, name);
    column->resize(RowsOf(data));
    Read(data, Hdf5TypeOf<T>(), column->data());
  }
  void ReadVectors(const Hdf5Handle& group, const char* name, std::vector<double>* x, std::vector<double>* y) const;

  /// The rows [first, first + count). Throws Error if the column has not so many.
  template <class T>
  void ReadRows(const Hdf5Handle& group, const char* name, std::int64_t first, std::int64_t count,
                std::vector<T>* column) const {
    const Hdf5Handle data = OpenColumn(group, name);
    CheckRows(data, name, first, count);
    column->resize(static_cast<std::size_t>(count));
    ReadRows(data, Hdf5TypeOf<T>(), first, count, column->data());
  }

  /// A text of fixed length as a data set of its own.
  void WriteText(const Hdf5Handle& group, const char* name, const std::string& text);
  std::uint64_t RowsOf(const Hdf5Handle& group, const char* name) const { return RowsOf(OpenColumn(group, name)); }
  bool Has(const Hdf5Handle& group, const char* name) const;

  void WriteAttribute(const Hdf5Handle& object, const char* name, const std::string& text);
  void WriteAttribute(const Hdf5Handle& object, const char* name, double value);
  void WriteAttribute(const Hdf5Handle& object, const char* name, std::int64_t value);
  void ReadAttribute(const Hdf5Handle& object, const char* name, std::string* text) const;
  void ReadAttribute(const Hdf5Handle& object, const char* name, double* value) const;
  void ReadAttribute(const Hdf5Handle& object, const char* name, std::int64_t* value) const;
  template <class T>
  T ReadAttribute(const Hdf5Handle& object, const char* name) const {
    T value{};
    ReadAttribute(object, name, &value);
    return value;
  }

  /// All that was written is in the file when it returns, which is then complete.
  void Flush();
  void Close();

 private:
  Hdf5File(const std::filesystem::path& path, const RankGroup& ranks);

  void WriteTable(const Hdf5Handle& group, const char* name, const char* unit, hid_t type, const void* data,
                  const RowRange& rows, hsize_t width);
  void WriteScalar(const Hdf5Handle& object, const char* name, hid_t type, const void* value);
  void ReadScalar(const Hdf5Handle& object, const char* name, hid_t type, void* value) const;
  Hdf5Handle OpenColumn(const Hdf5Handle& group, const char* name) const;
  std::size_t RowsOf(const Hdf5Handle& column) const;
  void Read(const Hdf5Handle& column, hid_t type, void* data) const;
  void CheckRows(const Hdf5Handle& column, const char* name, std::int64_t first, std::int64_t count) const;
  void ReadRows(const Hdf5Handle& column, hid_t type, std::int64_t first, std::int64_t count, void* data) const;
  std::string Writing() const { return "write " + path_.string(); }
  std::string Reading(const std::string& name) const { return "read " + name + " in " + path_.string(); }

  std::filesystem::path path_;
  RankGroup ranks_;
  bool parallel_;
  Hdf5Handle file_;
};

}  // namespace nscdd

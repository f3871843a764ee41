// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nscdd/vector.h"

namespace nscdd {

/// One line of a CSV file of disks.
struct DiskRow {
  std::optional<std::int64_t> id;  ///< only if the file has this column
  Pose pose;
  Twist velocity;
  double radius = 0.0;   ///< [m] > 0
  std::string material;  ///< empty: not said
  std::int64_t line = 0;
};

/// Reads disks from a CSV file, one line at a time. The first line names the columns, in any order: x, y, radius, and, if
/// wanted, id, angle, vx, vy, spin, material. Empty lines and lines that begin with # are skipped.
/// Throws Error "FILE:LINE: ..." on anything else.
class DiskFileReader {
 public:
  explicit DiskFileReader(const std::filesystem::path& path);

  bool has_ids() const { return has_ids_; }
  /// Reads the next disk; false at the end. Leaves in `row` what the file has no column for.
  bool Next(DiskRow* row);
  /// Passes over the next disk unread; false at the end.
  bool Skip() { return NextLine(); }

 private:
  bool NextLine();
  void CheckText(std::string_view line) const;
  void ReadHeader();
  void ReadField(std::size_t column, std::string_view field, DiskRow* row) const;
  [[noreturn]] void Refuse(const std::string& what) const;

  std::filesystem::path path_;
  std::ifstream stream_;
  std::vector<std::size_t> columns_;  ///< of the file, as numbers of known names
  bool has_ids_ = false;
  std::array<char, 4098> line_{};
  std::int64_t line_number_ = 0;
};

}  // namespace nscdd

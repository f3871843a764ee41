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

#include "nscdd/body_table.h"
#include "nscdd/vector.h"
#include "scene/csv_cells.h"
#include "scene/disk_columns.h"
#include "scene/scene.h"

namespace nscdd {

/// One row of a table of disks.
struct DiskRow {
  std::optional<std::int64_t> id;  ///< only if the table has this column
  Pose pose;
  double z = 0.0;  ///< [m] what a plane has no use for
  Twist velocity;
  double radius = 0.0;   ///< [m] > 0
  std::string material;  ///< empty: not said
  std::optional<BodyKind> kind;
  std::int64_t line = 0;
};

/// Reads a table of disks, one line at a time, in the dialects that programs write: sample_scenes/README.md says which.
/// Throws Error "FILE:LINE: ..." on anything else.
class DiskFileReader {
 public:
  explicit DiskFileReader(const std::filesystem::path& path);

  bool has_ids() const { return columns_.Has(DiskColumn::kId); }
  /// Reads the next disk; false at the end. Leaves in `row` what the table has no column for.
  bool Next(DiskRow* row);
  /// Passes over the next disk unread; false at the end.
  bool Skip();
  /// What the reader of a table should know, as far as it was read: whole sentences.
  std::vector<std::string> Remarks() const;

 private:
  bool NextLine();
  bool NextDisk();
  void CheckText(std::string_view line) const;
  void ReadHead();
  void ConsiderComment(std::string_view text);
  void TakeNames(const std::vector<std::string_view>& names);
  void TakeRowWithoutHeader();
  void SplitFields();
  void ReadField(DiskColumn column, std::string_view field, DiskRow* row);
  double ReadNumber(DiskColumn column, std::string_view field);
  void ReadKind(std::string_view field, DiskRow* row) const;
  [[noreturn]] void Refuse(const std::string& what) const;

  std::filesystem::path path_;
  std::ifstream stream_;
  DiskColumns columns_;  ///< empty until the head is read
  Separator separator_ = Separator::kComma;
  bool named_ = true;          ///< the table says what its columns are
  std::string comment_;        ///< the last one above the rows that names x, y and a radius, as it stands
  bool held_ = false;          ///< line_ is a row that was seen but not taken
  char decimal_mark_ = '\0';   ///< of the numbers so far, once one of them had one
  std::int64_t left_out_ = 0;  ///< rows that are no disks
  std::array<char, 4098> line_{};
  std::int64_t line_number_ = 0;
  std::vector<std::string_view> fields_;  ///< of line_
};

/// Writes the free disks of a finished run as a packing: id,x,y,angle,radius,vx,vy,spin, and material if the scene names
/// materials, that [[disks]] file = "..." reads back, with the digits of `final_csv` untouched. Call it on one rank. Returns a
/// sentence about what a table of disks cannot hold, "" if that is nothing. Throws Error when a body of the scene is not in
/// `final_csv` or the file cannot be written.
std::string WritePacking(const Scene& scene, const std::filesystem::path& final_csv, const std::filesystem::path& packing);

}  // namespace nscdd

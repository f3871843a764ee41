// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "nscdd/vector.h"

namespace nscdd {

/// Which numbers a key takes; infinities and NaN never.
enum class Bound { kFinite, kPositive, kNotNegative, kFraction };

/// Reads the keys of one TOML table and refuses, with a sentence that begins "FILE:LINE: key 'table.key'", whatever is not
/// as it should be. Every key that is asked for becomes a known one; Finish() refuses the others.
class TableReader {
 public:
  /// `path` names the table in sentences: "time", "disks[2]"; empty for the whole file.
  TableReader(const toml::table& table, std::string path, const std::filesystem::path& file);

  bool Has(std::string_view key);
  /// Without a fallback a missing key is refused. `unit` is what a sentence says, such as "[m]".
  double Number(std::string_view key, Bound bound, std::string_view unit, std::optional<double> fallback = {});
  std::int64_t Integer(std::string_view key, std::int64_t low, std::optional<std::int64_t> fallback = {},
                       std::int64_t high = std::numeric_limits<std::int64_t>::max());
  bool Flag(std::string_view key, bool fallback);
  std::string Text(std::string_view key, std::optional<std::string> fallback = {});
  /// A text that is one of `names`.
  std::string Choice(std::string_view key, const std::vector<std::string>& names, std::optional<std::string> fallback = {});
  Vec2 Vector(std::string_view key, std::string_view unit, std::optional<Vec2> fallback = {});
  /// A list of lists of `width` numbers, at least `min_rows` of them; `columns` says which, such as "[x, y, radius]".
  std::vector<std::vector<double>> Rows(std::string_view key, std::size_t width, std::string_view columns,
                                        std::size_t min_rows);
  /// A list of `width` numbers.
  std::vector<double> List(std::string_view key, std::size_t width, std::string_view columns);
  /// The table [key]; none if it is not there.
  std::optional<TableReader> Table(std::string_view key);
  /// The tables [[key]], in order.
  std::vector<TableReader> Tables(std::string_view key);

  /// Refuses keys that nobody asked for.
  void Finish() const;

  /// Throws Error "FILE:LINE: key 'path.key' WHAT".
  [[noreturn]] void Refuse(std::string_view key, std::string_view what) const;

  const toml::table& table() const { return *table_; }
  const std::string& path() const { return path_; }
  const std::filesystem::path& file() const { return *file_; }
  /// Line of the key, or of the table when the key is not there.
  int Line(std::string_view key = {}) const;

 private:
  const toml::node* Find(std::string_view key);
  const toml::node& Need(std::string_view key, std::string_view what);
  std::vector<double> Numbers(const toml::node& node, std::string_view key, std::size_t width, std::string_view columns) const;
  std::string Name(std::string_view key) const;

  const toml::table* table_;
  std::string path_;
  const std::filesystem::path* file_;
  std::vector<std::string> known_;
};

/// "a text", "a list", ... for sentences.
std::string_view TypeName(const toml::node& node);

}  // namespace nscdd

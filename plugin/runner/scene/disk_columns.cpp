// SPDX-License-Identifier: Apache-2.0
#include "scene/disk_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <span>

#include "scene/text.h"

namespace nscdd {
namespace {

/// The documented name first, then synonyms, as PlainName() gives them.
struct Names {
  DiskColumn column;
  std::vector<std::string> names;
};

const std::vector<Names>& KnownNames() {
  static const std::vector<Names> known = {
      {DiskColumn::kId, {"id", "particleid"}},
      {DiskColumn::kX, {"x", "posx", "positionx", "centrex", "centerx", "points0"}},
      {DiskColumn::kY, {"y", "posy", "positiony", "centrey", "centery", "points1"}},
      {DiskColumn::kZ, {"z", "posz", "positionz", "centrez", "centerz", "points2"}},
      {DiskColumn::kRadius, {"radius", "r", "rad"}},
      {DiskColumn::kDiameter, {"diameter", "d", "diam"}},
      {DiskColumn::kAngle, {"angle"}},
      {DiskColumn::kVx, {"vx", "velx", "velocityx", "velocity0"}},
      {DiskColumn::kVy, {"vy", "vely", "velocityy", "velocity1"}},
      {DiskColumn::kSpin, {"spin", "omega", "omegaz"}},
      {DiskColumn::kMaterial, {"material"}},
      {DiskColumn::kKind, {"kind"}},
  };
  return known;
}

/// Letters and digits, small.
std::string PlainName(std::string_view name) {
  std::string plain;
  for (const unsigned char c : name) {
    if (c >= 0x80 || std::isalnum(c)) plain.push_back(static_cast<char>(std::tolower(c)));
  }
  return plain;
}

/// Gives `known.column` to its documented name or else to its synonym. Sets the fault if either is there twice.
void Find(const Names& known, const std::vector<std::string_view>& names, DiskColumns* columns) {
  const std::span<const std::string> documented(known.names.data(), 1),
      synonyms(known.names.data() + 1, known.names.size() - 1);
  for (const auto& group : {documented, synonyms}) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (std::find(group.begin(), group.end(), PlainName(names[i])) != group.end()) places.push_back(i);
    }
    if (places.size() > 1 && columns->fault.empty()) {
      columns->fault = fmt::format("column '{}' is there twice{}; keep one", names[places[1]],
                                   names[places[0]] == names[places[1]] ? "" : fmt::format(", also as '{}'", names[places[0]]));
    }
    if (places.empty()) continue;
    columns->meaning[places.front()] = known.column;
    return;
  }
}

/// An unused name that looks like a misspelt `wanted`.
std::string Misspelt(const DiskColumns& columns, const std::string& wanted) {
  for (const std::string& name : columns.unused) {
    if (NearestName(name, std::span(&wanted, 1)) == wanted) return name;
  }
  return {};
}

void RequirePositionAndSize(DiskColumns* columns) {
  for (const DiskColumn needed : {DiskColumn::kX, DiskColumn::kY, DiskColumn::kRadius}) {
    if (columns->Has(needed) || (needed == DiskColumn::kRadius && columns->Has(DiskColumn::kDiameter))) continue;
    const std::string name(NameOf(needed)), misspelt = Misspelt(*columns, name);
    columns->fault = fmt::format("column '{}' is missing; ", name);
    columns->fault += misspelt.empty() ? "the first line must name x, y and radius (or diameter), such as x,y,radius"
                                       : fmt::format("did you mean '{}' by '{}'?", name, misspelt);
    return;
  }
}

}  // namespace

bool DiskColumns::Has(DiskColumn column) const { return std::find(meaning.begin(), meaning.end(), column) != meaning.end(); }

std::string_view NameOf(DiskColumn column) {
  for (const Names& known : KnownNames()) {
    if (known.column == column) return known.names.front();
  }
  return "unused";
}

DiskColumns ColumnsNamed(const std::vector<std::string_view>& names) {
  DiskColumns columns;
  columns.meaning.assign(names.size(), DiskColumn::kUnused);
  for (const Names& known : KnownNames()) Find(known, names, &columns);
  if (columns.Has(DiskColumn::kRadius)) {
    std::replace(columns.meaning.begin(), columns.meaning.end(), DiskColumn::kDiameter, DiskColumn::kUnused);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_unused = columns.meaning[i] == DiskColumn::kUnused || columns.meaning[i] == DiskColumn::kZ;
    if (is_unused && !names[i].empty()) columns.unused.emplace_back(names[i]);
  }
  if (columns.fault.empty()) RequirePositionAndSize(&columns);
  return columns;
}

DiskColumns ColumnsByPosition(std::size_t count) {
  DiskColumns columns;
  columns.meaning = {DiskColumn::kX, DiskColumn::kY};
  if (count == 4) columns.meaning.push_back(DiskColumn::kZ);
  columns.meaning.push_back(DiskColumn::kRadius);
  if (columns.meaning.size() != count) {
    columns.fault = fmt::format(
        "no line names the columns, and {} number{} could be anything; write the names above, such as x,y,radius, or give just "
        "x, y, radius or x, y, z, radius",
        count, count == 1 ? "" : "s");
  }
  return columns;
}

}  // namespace nscdd

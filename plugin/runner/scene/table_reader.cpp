// SPDX-License-Identifier: Apache-2.0
#include "scene/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nscdd/error.h"
#include "scene/text.h"

namespace nscdd {
namespace {

std::string_view BoundText(Bound bound) {
  switch (bound) {
    case Bound::kFinite:
      return "a finite number";
    case Bound::kPositive:
      return "a number > 0";
    case Bound::kNotNegative:
      return "a number >= 0";
    case Bound::kFraction:
      return "a number in [0, 1]";
  }
  return "";
}

bool Fulfils(double value, Bound bound) {
  if (!std::isfinite(value)) return false;
  switch (bound) {
    case Bound::kFinite:
      return true;
    case Bound::kPositive:
      return value > 0.0;
    case Bound::kNotNegative:
      return value >= 0.0;
    case Bound::kFraction:
      return value >= 0.0 && value <= 1.0;
  }
  return false;
}

std::optional<double> NumberOf(const toml::node& node) {
  if (!node.is_number()) return std::nullopt;
  return node.value<double>();
}

}  // namespace

std::string_view TypeName(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

TableReader::TableReader(const toml::table& table, std::string path, const std::filesystem::path& file)
    : table_(&table), path_(std::move(path)), file_(&file) {}

const toml::node* TableReader::Find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  return table_->get(key);
}

const toml::node& TableReader::Need(std::string_view key, std::string_view what) {
  const toml::node* node = Find(key);
  if (node != nullptr) return *node;
  const std::string wanted[] = {std::string(key)};
  for (const auto& [other, unused] : *table_) {  // it may be there, misspelt
    const bool is_known = std::find(known_.begin(), known_.end(), other.str()) != known_.end();
    if (!is_known && !NearestName(other.str(), wanted).empty()) {
      Refuse(other.str(), fmt::format("is unknown here; did you mean '{}'?", key));
    }
  }
  Refuse(key, fmt::format("is missing; give {}", what));
}

bool TableReader::Has(std::string_view key) { return Find(key) != nullptr; }

double TableReader::Number(std::string_view key, Bound bound, std::string_view unit, std::optional<double> fallback) {
  if (!Has(key) && fallback) return *fallback;
  const std::string wanted = fmt::format("{} {}", BoundText(bound), unit);
  const toml::node& node = Need(key, wanted);
  const std::optional<double> value = NumberOf(node);
  if (!value) Refuse(key, fmt::format("is {}; give {}", TypeName(node), wanted));
  if (!Fulfils(*value, bound)) Refuse(key, fmt::format("is {}; give {}", *value, wanted));
  return *value;
}

std::int64_t TableReader::Integer(std::string_view key, std::int64_t low, std::optional<std::int64_t> fallback,
                                  std::int64_t high) {
  if (!Has(key) && fallback) return *fallback;
  const std::string wanted = high == std::numeric_limits<std::int64_t>::max()
                                 ? fmt::format("an integer >= {}", low)
                                 : fmt::format("an integer from {} to {}", low, high);
  const toml::node& node = Need(key, wanted);
  if (!node.is_integer()) Refuse(key, fmt::format("is {}; give {}", TypeName(node), wanted));
  const std::int64_t value = node.as_integer()->get();
  if (value < low || value > high) Refuse(key, fmt::format("is {}; give {}", value, wanted));
  return value;
}

bool TableReader::Flag(std::string_view key, bool fallback) {
  const toml::node* node = Find(key);
  if (node == nullptr) return fallback;
  if (!node->is_boolean()) Refuse(key, fmt::format("is {}; give true or false", TypeName(*node)));
  return node->as_boolean()->get();
}

std::string TableReader::Text(std::string_view key, std::optional<std::string> fallback) {
  if (!Has(key) && fallback) return *fallback;
  const toml::node& node = Need(key, "a text in quotes");
  if (!node.is_string()) Refuse(key, fmt::format("is {}; give a text in quotes", TypeName(node)));
  const std::string& text = node.as_string()->get();
  if (text.empty()) Refuse(key, "is empty; give a text or leave the key out");
  if (HasControls(text)) Refuse(key, "has a control character in it; leave it out");
  return text;
}

std::string TableReader::Choice(std::string_view key, const std::vector<std::string>& names,
                                std::optional<std::string> fallback) {
  const std::string text = Text(key, std::move(fallback));
  if (std::find(names.begin(), names.end(), text) == names.end()) {
    Refuse(key, fmt::format("is '{}'; {}", text, Suggestion(text, names, "known values")));
  }
  return text;
}

std::vector<double> TableReader::Numbers(const toml::node& node, std::string_view key, std::size_t width,
                                         std::string_view columns) const {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() != width) {
    Refuse(key, fmt::format("has {} of {} where {} numbers stand; give {}", TypeName(node), list ? list->size() : 1, width,
                            columns));
  }
  std::vector<double> numbers;
  for (const toml::node& element : *list) {
    const std::optional<double> number = NumberOf(element);
    if (!number) Refuse(key, fmt::format("has {} where a number stands; give {}", TypeName(element), columns));
    if (!std::isfinite(*number)) Refuse(key, fmt::format("has {} in it; give finite numbers {}", *number, columns));
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<double> TableReader::List(std::string_view key, std::size_t width, std::string_view columns) {
  return Numbers(Need(key, columns), key, width, columns);
}

Vec2 TableReader::Vector(std::string_view key, std::string_view unit, std::optional<Vec2> fallback) {
  if (!Has(key) && fallback) return *fallback;
  const std::vector<double> xy = List(key, 2, fmt::format("[x, y] {}", unit));
  return {xy[0], xy[1]};
}

std::vector<std::vector<double>> TableReader::Rows(std::string_view key, std::size_t width, std::string_view columns,
                                                   std::size_t min_rows) {
  const std::string wanted = fmt::format("a list of at least {} {}", min_rows, columns);
  const toml::node& node = Need(key, wanted);
  const toml::array* list = node.as_array();
  if (list == nullptr) Refuse(key, fmt::format("is {}; give {}", TypeName(node), wanted));
  if (list->size() < min_rows) Refuse(key, fmt::format("has {} entries; give {}", list->size(), wanted));
  std::vector<std::vector<double>> rows;
  for (const toml::node& element : *list) rows.push_back(Numbers(element, key, width, columns));
  return rows;
}

std::optional<TableReader> TableReader::Table(std::string_view key) {
  const toml::node* node = Find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_table()) Refuse(key, fmt::format("is {}; write a table [{}]", TypeName(*node), Name(key)));
  return TableReader(*node->as_table(), Name(key), *file_);
}

std::vector<TableReader> TableReader::Tables(std::string_view key) {
  const toml::node* node = Find(key);
  if (node == nullptr) return {};
  const toml::array* list = node->as_array();
  if (list == nullptr) Refuse(key, fmt::format("is {}; write tables [[{}]]", TypeName(*node), Name(key)));
  std::vector<TableReader> tables;
  for (const toml::node& element : *list) {
    if (!element.is_table()) Refuse(key, fmt::format("has {} in it; write tables [[{}]]", TypeName(element), Name(key)));
    tables.emplace_back(*element.as_table(), fmt::format("{}[{}]", Name(key), tables.size() + 1), *file_);
  }
  return tables;
}

void TableReader::Finish() const {
  for (const auto& [key, node] : *table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    Refuse(key.str(), fmt::format("is unknown here; {}", Suggestion(key.str(), known_, "known keys")));
  }
}

std::string TableReader::Name(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

int TableReader::Line(std::string_view key) const {
  const toml::node* node = key.empty() ? nullptr : table_->get(key);
  const auto line = (node != nullptr ? *node : static_cast<const toml::node&>(*table_)).source().begin.line;
  return std::max(1, static_cast<int>(line));
}

void TableReader::Refuse(std::string_view key, std::string_view what) const {
  throw Error(Sentence(fmt::format("{}:{}: key '{}' {}", file_->string(), Line(key), Name(key), what)));
}

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#include "result_table.h"

#include <bit>
#include <iterator>

namespace nscdd {
namespace {

// A column: its name, unit and the number of a row; one of the two getters is null.
template <class Results>
struct Column {
  const char* name;
  const char* unit;
  std::int64_t (*integer)(const Results&, std::size_t row);
  double (*real)(const Results&, std::size_t row);
};

using B = BodyResults;
constexpr Column<B> kBodyColumns[] = {
    {"id", "-", [](const B& r, std::size_t i) -> std::int64_t { return r.id[i]; }, nullptr},
    {"kind", "-", [](const B& r, std::size_t i) { return static_cast<std::int64_t>(r.kind[i]); }, nullptr},
    {"radius", "m", nullptr, [](const B& r, std::size_t i) { return r.radius[i]; }},
    {"x", "m", nullptr, [](const B& r, std::size_t i) { return r.pose[i].x; }},
    {"y", "m", nullptr, [](const B& r, std::size_t i) { return r.pose[i].y; }},
    {"angle", "rad", nullptr, [](const B& r, std::size_t i) { return r.pose[i].angle; }},
    {"vx", "m/s", nullptr, [](const B& r, std::size_t i) { return r.velocity[i].vx; }},
    {"vy", "m/s", nullptr, [](const B& r, std::size_t i) { return r.velocity[i].vy; }},
    {"spin", "rad/s", nullptr, [](const B& r, std::size_t i) { return r.velocity[i].spin; }},
    {"multiplicity", "-", [](const B& r, std::size_t i) -> std::int64_t { return r.multiplicity[i]; }, nullptr},
    {"subdomain", "-", [](const B& r, std::size_t i) -> std::int64_t { return r.subdomain[i]; }, nullptr},
};

using C = ContactResults;
constexpr Column<C> kContactColumns[] = {
    {"body_a", "-", [](const C& r, std::size_t i) -> std::int64_t { return r.key[i].body_a; }, nullptr},
    {"body_b", "-", [](const C& r, std::size_t i) -> std::int64_t { return r.key[i].body_b; }, nullptr},
    {"shape_a", "-", [](const C& r, std::size_t i) -> std::int64_t { return r.key[i].shape_a; }, nullptr},
    {"shape_b", "-", [](const C& r, std::size_t i) -> std::int64_t { return r.key[i].shape_b; }, nullptr},
    {"image", "-", [](const C& r, std::size_t i) -> std::int64_t { return r.key[i].image; }, nullptr},
    {"gap", "m", nullptr, [](const C& r, std::size_t i) { return r.gap[i]; }},
    {"final_gap", "m", nullptr, [](const C& r, std::size_t i) { return r.final_gap[i]; }},
    {"normal_x", "-", nullptr, [](const C& r, std::size_t i) { return r.normal[i].x; }},
    {"normal_y", "-", nullptr, [](const C& r, std::size_t i) { return r.normal[i].y; }},
    {"point_x", "m", nullptr, [](const C& r, std::size_t i) { return r.point[i].x; }},
    {"point_y", "m", nullptr, [](const C& r, std::size_t i) { return r.point[i].y; }},
    {"lever_a", "m", nullptr, [](const C& r, std::size_t i) { return r.lever_a[i]; }},
    {"lever_b", "m", nullptr, [](const C& r, std::size_t i) { return r.lever_b[i]; }},
    {"impulse_n", "N s", nullptr, [](const C& r, std::size_t i) { return r.impulse[i].x; }},
    {"impulse_t", "N s", nullptr, [](const C& r, std::size_t i) { return r.impulse[i].y; }},
    {"velocity_n", "m/s", nullptr, [](const C& r, std::size_t i) { return r.relative_velocity[i].x; }},
    {"velocity_t", "m/s", nullptr, [](const C& r, std::size_t i) { return r.relative_velocity[i].y; }},
    {"status", "-", [](const C& r, std::size_t i) -> std::int64_t { return static_cast<std::int64_t>(r.status[i]); }, nullptr},
    {"subdomain", "-", [](const C& r, std::size_t i) -> std::int64_t { return r.subdomain[i]; }, nullptr},
};

using I = std::span<const IterationRecord>;
constexpr Column<I> kIterationColumns[] = {
    {"iteration", "-", [](const I& r, std::size_t i) -> std::int64_t { return r[i].iteration; }, nullptr},
    {"nat", "-", nullptr, [](const I& r, std::size_t i) { return r[i].nat; }},
    {"nat_max", "-", nullptr, [](const I& r, std::size_t i) { return r[i].nat_max; }},
    {"qm16", "-", nullptr, [](const I& r, std::size_t i) { return r[i].qm16; }},
    {"interface_jump", "m/s", nullptr, [](const I& r, std::size_t i) { return r[i].interface_jump; }},
};

}  // namespace

template <class Results, class Columns>
void ResultTable::Fill(const Results& results, const Columns& columns) {
  rows_ = results.size();
  numbers_.resize(results.size() * std::size(columns));
  columns_.clear();
  std::uint64_t* next = numbers_.data();
  for (const Column<Results>& column : columns) {
    columns_.push_back({column.name, column.unit, column.real == nullptr ? 1 : 0, 0, next});
    for (std::size_t i = 0; i < results.size(); ++i) {
      *next++ = column.real == nullptr ? std::bit_cast<std::uint64_t>(column.integer(results, i))
                                       : std::bit_cast<std::uint64_t>(column.real(results, i));
    }
  }
}

void ResultTable::FillBodies(const BodyResults& results) { Fill(results, kBodyColumns); }
void ResultTable::FillContacts(const ContactResults& results) { Fill(results, kContactColumns); }
void ResultTable::FillIterations(std::span<const IterationRecord> records) { Fill(records, kIterationColumns); }

void ResultTable::Show(nscdd_table* table) const {
  table->row_count = rows_;
  table->column_count = columns_.size();
  table->columns = columns_.data();
}

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#include "result_table.h"

#include <bit>
#include <iterator>

namespace nscdd {
namespace {

// A column: its name, unit and where the number stands in a record; one of the two getters is null.
template <class Record>
struct Column {
  const char* name;
  const char* unit;
  std::int64_t (*integer)(const Record&);
  double (*real)(const Record&);
};

using B = BodyRecord;
constexpr Column<B> kBodyColumns[] = {
    {"id", "-", [](const B& r) -> std::int64_t { return r.id; }, nullptr},
    {"kind", "-", [](const B& r) { return static_cast<std::int64_t>(r.kind); }, nullptr},
    {"radius", "m", nullptr, [](const B& r) { return r.radius; }},
    {"x", "m", nullptr, [](const B& r) { return r.pose.x; }},
    {"y", "m", nullptr, [](const B& r) { return r.pose.y; }},
    {"angle", "rad", nullptr, [](const B& r) { return r.pose.angle; }},
    {"vx", "m/s", nullptr, [](const B& r) { return r.velocity.vx; }},
    {"vy", "m/s", nullptr, [](const B& r) { return r.velocity.vy; }},
    {"spin", "rad/s", nullptr, [](const B& r) { return r.velocity.spin; }},
    {"multiplicity", "-", [](const B& r) -> std::int64_t { return r.multiplicity; }, nullptr},
    {"subdomain", "-", [](const B& r) -> std::int64_t { return r.subdomain; }, nullptr},
};

using C = ContactRecord;
constexpr Column<C> kContactColumns[] = {
    {"body_a", "-", [](const C& r) -> std::int64_t { return r.key.body_a; }, nullptr},
    {"body_b", "-", [](const C& r) -> std::int64_t { return r.key.body_b; }, nullptr},
    {"shape_a", "-", [](const C& r) -> std::int64_t { return r.key.shape_a; }, nullptr},
    {"shape_b", "-", [](const C& r) -> std::int64_t { return r.key.shape_b; }, nullptr},
    {"image", "-", [](const C& r) -> std::int64_t { return r.key.image; }, nullptr},
    {"gap", "m", nullptr, [](const C& r) { return r.gap; }},
    {"final_gap", "m", nullptr, [](const C& r) { return r.final_gap; }},
    {"normal_x", "-", nullptr, [](const C& r) { return r.normal.x; }},
    {"normal_y", "-", nullptr, [](const C& r) { return r.normal.y; }},
    {"point_x", "m", nullptr, [](const C& r) { return r.point.x; }},
    {"point_y", "m", nullptr, [](const C& r) { return r.point.y; }},
    {"impulse_n", "N s", nullptr, [](const C& r) { return r.impulse.x; }},
    {"impulse_t", "N s", nullptr, [](const C& r) { return r.impulse.y; }},
    {"velocity_n", "m/s", nullptr, [](const C& r) { return r.relative_velocity.x; }},
    {"velocity_t", "m/s", nullptr, [](const C& r) { return r.relative_velocity.y; }},
    {"status", "-", [](const C& r) -> std::int64_t { return r.status; }, nullptr},
    {"subdomain", "-", [](const C& r) -> std::int64_t { return r.subdomain; }, nullptr},
};

using I = IterationRecord;
constexpr Column<I> kIterationColumns[] = {
    {"iteration", "-", [](const I& r) -> std::int64_t { return r.iteration; }, nullptr},
    {"nat", "-", nullptr, [](const I& r) { return r.nat; }},
    {"nat_max", "-", nullptr, [](const I& r) { return r.nat_max; }},
    {"qm16", "-", nullptr, [](const I& r) { return r.qm16; }},
    {"interface_jump", "m/s", nullptr, [](const I& r) { return r.interface_jump; }},
};

}  // namespace

template <class Record, class Columns>
void ResultTable::Fill(std::span<const Record> records, const Columns& columns) {
  rows_ = records.size();
  numbers_.resize(records.size() * std::size(columns));
  columns_.clear();
  std::uint64_t* next = numbers_.data();
  for (const Column<Record>& column : columns) {
    columns_.push_back({column.name, column.unit, column.real == nullptr ? 1 : 0, 0, next});
    for (const Record& record : records) {
      *next++ = column.real == nullptr ? std::bit_cast<std::uint64_t>(column.integer(record))
                                       : std::bit_cast<std::uint64_t>(column.real(record));
    }
  }
}

void ResultTable::FillBodies(std::span<const BodyRecord> records) { Fill(records, kBodyColumns); }
void ResultTable::FillContacts(std::span<const ContactRecord> records) { Fill(records, kContactColumns); }
void ResultTable::FillIterations(std::span<const IterationRecord> records) { Fill(records, kIterationColumns); }

void ResultTable::Show(nscdd_table* table) const {
  table->row_count = rows_;
  table->column_count = columns_.size();
  table->columns = columns_.data();
}

}  // namespace nscdd

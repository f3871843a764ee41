// SPDX-License-Identifier: Apache-2.0
#include "results/final_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <limits>
#include <memory>
#include <string>

#include "nscdd/error.h"
#include "results/written_file.h"

namespace nscdd {
namespace {

struct Row {
  std::int64_t id;
  std::array<double, 7> values;  ///< x, y, angle, vx, vy, spin, radius
  std::int64_t kind;             ///< BodyKind; as wide as the rest, so that no byte is undefined
};

/// Hands out rows by ascending id.
class RowQueue {
 public:
  explicit RowQueue(const GrainTable& grains) : grains_(grains), order_(AscendingOrder(grains.id)) {}

  /// Id up to which about `count` rows can be taken; the largest number if that is all of them.
  std::int64_t BoundFor(std::size_t count) const {
    if (order_.size() - next_ <= count) return std::numeric_limits<std::int64_t>::max();
    return grains_.id[order_[next_ + count - 1]];
  }

  /// Takes the rows with an id <= bound.
  std::vector<std::byte> Take(std::int64_t bound) {
    std::vector<std::byte> bytes;
    for (; next_ < order_.size() && grains_.id[order_[next_]] <= bound; ++next_) {
      const std::size_t i = order_[next_];
      const Row row{
          grains_.id[i],
          {grains_.x[i], grains_.y[i], grains_.angle[i], grains_.vx[i], grains_.vy[i], grains_.spin[i], grains_.radius[i]},
          grains_.kind[i]};
      const std::size_t end = bytes.size();
      bytes.resize(end + sizeof row);
      std::memcpy(bytes.data() + end, &row, sizeof row);
    }
    return bytes;
  }

 private:
  const GrainTable& grains_;
  std::vector<std::size_t> order_;
  std::size_t next_ = 0;
};

/// Appends rows to the file in order of id; ids of later calls are larger. Remembers the last one, to see it come twice.
void WriteRows(const std::vector<std::byte>& bytes, const RoleOfBody& role, std::int64_t* last_id, StagedFile* file) {
  std::vector<Row> rows(bytes.size() / sizeof(Row));
  if (!rows.empty()) std::memcpy(rows.data(), bytes.data(), bytes.size());
  std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.id < b.id; });
  fmt::memory_buffer text;
  for (const Row& row : rows) {
    if (row.id == *last_id) {
      throw Error(fmt::format("two bodies have the id {}: ids of the platform's bodies must be unique.", row.id));
    }
    *last_id = row.id;
    fmt::format_to(std::back_inserter(text), "{}", row.id);
    for (const double value : row.values) fmt::format_to(std::back_inserter(text), ",{:.17g}", value);
    const std::string_view role_name = role(row.id);
    const std::string_view kind = row.kind == 0 ? "free" : "prescribed";
    fmt::format_to(std::back_inserter(text), ",{}\n", role_name.empty() ? kind : role_name);
  }
  file->Write({text.data(), text.size()});
}

}  // namespace

void WriteFinalCsv(ResultsFolder* folder, const GrainTable& grains, const RoleOfBody& role, int rows_at_a_time) {
  const RankGroup& ranks = folder->ranks();
  std::unique_ptr<StagedFile> file;
  ranks.RunOnRoot([&] {
    file = std::make_unique<StagedFile>(folder->Stage("final.csv"));
    file->Write("id,x,y,angle,vx,vy,spin,radius,kind\n");
  });
  // In each round every rank sends what it has up to an id that the ranks agree on, so rounds follow each other in order of id,
  // whatever the ids are and wherever the bodies live.
  RowQueue queue(grains);
  const auto share = static_cast<std::size_t>(std::max(1, rows_at_a_time / ranks.size()));
  std::int64_t last_id = std::numeric_limits<std::int64_t>::min();
  std::int64_t bound = 0;
  do {
    bound = ranks.Min(queue.BoundFor(share));
    const std::vector<std::byte> rows = ranks.GatherOnRoot(queue.Take(bound));
    ranks.RunOnRoot([&] { WriteRows(rows, role, &last_id, file.get()); });
  } while (bound != std::numeric_limits<std::int64_t>::max());
  ranks.RunOnRoot([&] { file->Close(); });
}

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#include "state/state_file.h"

#include <fmt/format.h>

#include <cstdint>

#include "results/hdf5_file.h"
#include "results/written_file.h"
#include "state/state_columns.h"

namespace nscdd {
namespace {

std::vector<std::uint8_t> Bytes(std::span<const std::byte> bytes) {
  const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data());
  return {first, first + bytes.size()};
}

void AddBody(const BodyDefinition& body, StateBodyTable* t) {
  t->id.push_back(body.id);
  t->kind.push_back(static_cast<std::uint8_t>(body.kind));
  t->role.push_back(body.role);
  t->material.push_back(body.material);
  t->mass.push_back(body.mass);
  t->inertia.push_back(body.inertia);
  t->x.push_back(body.pose.x);
  t->y.push_back(body.pose.y);
  t->angle.push_back(body.pose.angle);
  t->vx.push_back(body.velocity.vx);
  t->vy.push_back(body.velocity.vy);
  t->spin.push_back(body.velocity.spin);
}

void AddShapes(const BodyDefinition& body, StateShapeTables* t) {
  for (const reference::Disk& disk : body.disks) {
    t->disk_x.push_back(disk.centre.x);
    t->disk_y.push_back(disk.centre.y);
    t->disk_radius.push_back(disk.radius);
  }
  for (const reference::Segment& segment : body.segments) {
    t->segment_x0.push_back(segment.a.x);
    t->segment_y0.push_back(segment.a.y);
    t->segment_x1.push_back(segment.b.x);
    t->segment_y1.push_back(segment.b.y);
  }
  for (const reference::HalfPlane& plane : body.half_planes) {
    t->plane_normal_x.push_back(plane.normal.x);
    t->plane_normal_y.push_back(plane.normal.y);
    t->plane_offset.push_back(plane.offset);
  }
}

/// This rank's tables; shapes of the ranks follow each other.
void MakeTables(const std::vector<BodyDefinition>& bodies, const RankGroup& ranks, StateBodyTable* table,
                StateShapeTables* shapes) {
  std::int64_t disks = 0, segments = 0, planes = 0;
  for (const BodyDefinition& body : bodies) {
    disks += std::ssize(body.disks);
    segments += std::ssize(body.segments);
    planes += std::ssize(body.half_planes);
  }
  disks = ranks.SumOfLowerRanks(disks);
  segments = ranks.SumOfLowerRanks(segments);
  planes = ranks.SumOfLowerRanks(planes);
  for (const BodyDefinition& body : bodies) {
    AddBody(body, table);
    AddShapes(body, shapes);
    table->first_disk.push_back(disks);
    table->first_segment.push_back(segments);
    table->first_half_plane.push_back(planes);
    disks += std::ssize(body.disks);
    segments += std::ssize(body.segments);
    planes += std::ssize(body.half_planes);
  }
}

class StateWriter {
  /// Writes the columns that it is shown into a new group.
  auto Columns(const char* name) {
    return [this, group = file_.CreateGroup(name)](const char* column_name, const char* unit, const auto& column) {
      file_.WriteColumn(group, column_name, unit, column, RowRange(ranks_, column.size()));
    };
  }

  auto Attributes(const Hdf5Handle& object) {
    return [&](const char* name, const auto& value) { file_.WriteAttribute(object, name, value); };
  }

 public:
  StateWriter(const std::filesystem::path& path, const RankGroup& ranks)
      : ranks_(ranks), file_(Hdf5File::Create(path, ranks, kSealSize)) {}

  void WriteHead(const StateHead& head) {
    const Hdf5Handle root = file_.OpenGroup("/");
    file_.WriteAttribute(root, "format", "nscdd state");
    file_.WriteAttribute(root, "format_version", kStateVersion);
    ForEachStateAttribute(head, Attributes(root));
    file_.CreateGroup("/materials");
    for (std::size_t i = 0; i < head.materials.size(); ++i) {
      const Hdf5Handle group = file_.CreateGroup(fmt::format("/materials/{:06}", i));
      ForEachMaterialAttribute(head.materials[i], Attributes(group));
    }
    const std::vector<std::uint8_t> run =
        ranks_.is_root() ? Bytes(std::as_bytes(std::span(head.run))) : std::vector<std::uint8_t>{};
    file_.WriteColumn(root, "run", "", run, RowRange(ranks_, run.size()));
  }

  void WriteBodies(const StateBodyTable& bodies, const StateShapeTables& shapes) {
    ForEachStateBodyColumn(bodies, Columns("/bodies"));
    ForEachStateDiskColumn(shapes, Columns("/disks"));
    ForEachStateSegmentColumn(shapes, Columns("/segments"));
    ForEachStatePlaneColumn(shapes, Columns("/half_planes"));
  }

  void WriteSolver(std::span<const std::byte> state) {
    const Hdf5Handle group = file_.CreateGroup("/solver");
    const std::vector<std::int64_t> size = {std::ssize(state)};
    file_.WriteColumn(group, "part_size", "bytes", size, RowRange(ranks_, 1));
    file_.WriteColumn(group, "parts", "", Bytes(state), RowRange(ranks_, state.size()));
  }

  void Close() { file_.Close(); }

 private:
  const RankGroup& ranks_;
  Hdf5File file_;
};

std::int64_t SizeOf(const StateBodyTable& bodies, const StateShapeTables& shapes) {
  std::int64_t size = 128 << 10;  // HDF5's own, at most
  const auto add = [&](const char*, const char*, const auto& column) { size += std::ssize(column) * sizeof(column[0]); };
  ForEachStateBodyColumn(bodies, add);
  ForEachStateDiskColumn(shapes, add);
  ForEachStateSegmentColumn(shapes, add);
  ForEachStatePlaneColumn(shapes, add);
  return size;
}

}  // namespace

void WriteStateFile(const std::filesystem::path& path, const StateHead& head, const std::vector<BodyDefinition>& bodies,
                    std::span<const std::byte> solver_state, const RankGroup& ranks) {
  const Hdf5Silence silence;
  StateBodyTable table;
  StateShapeTables shapes;
  MakeTables(bodies, ranks, &table, &shapes);
  const std::int64_t size =
      ranks.Sum(SizeOf(table, shapes) + std::ssize(solver_state) + (ranks.is_root() ? std::ssize(head.run) : 0));
  ranks.RunOnRoot([&] {
    StagedFile(path).Close();
    CheckSpace(path, static_cast<std::uint64_t>(size));
  });
  ranks.RunTogether([&] {
    StateWriter writer(path, ranks);
    writer.WriteHead(head);
    writer.WriteBodies(table, shapes);
    writer.WriteSolver(solver_state);
    writer.Close();
  });
  ranks.RunOnRoot([&] { Seal(path); });
}

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#include "scene/body_stream.h"

#include <fmt/format.h>
#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "nscdd/error.h"
#include "scene/disk_file.h"
#include "scene/read_bodies.h"
#include "state/state_file.h"

namespace nscdd {
namespace {

constexpr std::int64_t kMostBodiesOfARank = 20'000'000;  // some 20 GB on Box2D

/// Makes the bodies [first, last) of one source; `number` bodies before them take free ids.
class SourceVisitor {
 public:
  SourceVisitor(const Scene& scene, const BodySource& source, std::int64_t number, std::int64_t first, std::int64_t last,
                const std::function<void(const BodyDefinition&)>& visit)
      : scene_(scene), source_(source), number_(number), first_(first), last_(last), visit_(visit) {}

  void operator()(const StateBodies& state) const {
    const StateReader reader(state.path);
    if (reader.checksum() != state.checksum)
      throw Error(fmt::format("{}: has changed since the scene was read; leave it alone during a run.", state.path.string()));
    reader.ForEachBody(first_, last_, [this](const BodyDefinition& saved) {
      BodyDefinition body = saved;
      body.friction = material(body.material).friction;
      body.restitution = material(body.material).restitution;
      visit_(body);
    });
  }

  void operator()(const SingleDisk& disk) const {
    BodyDefinition body = MakeDisk({{disk.pose.x, disk.pose.y}, disk.radius});
    body.pose.angle = disk.pose.angle;
    Give(0, std::move(body));
  }

  void operator()(const Lattice& lattice) const {
    for (std::int64_t i = first_; i < last_; ++i) Give(i, MakeDisk(LatticeDisk(lattice, i)));
  }

  void operator()(const Deposition& deposition) const {
    DepositionGenerator generator(deposition);
    for (std::int64_t i = 0; i < last_; ++i) {
      const reference::Disk disk = generator.Next();
      if (i >= first_) Give(i, MakeDisk(disk));
    }
  }

  void operator()(const DiskFile& file) const {
    DiskFileReader reader(file.path);
    for (std::int64_t i = 0; i < first_; ++i) {
      if (!reader.Skip()) RefuseChange(file);
    }
    for (std::int64_t i = first_; i < last_; ++i) {
      DiskRow row;
      row.velocity = source_.velocity;
      if (!reader.Next(&row)) RefuseChange(file);
      const std::string where = fmt::format("{}:{}:", file.path.string(), row.line);
      const int material = row.material.empty() ? source_.material : FindMaterial(scene_, row.material, where);
      BodyDefinition body = MakeDisk({{row.pose.x, row.pose.y}, row.radius}, material, row.kind.value_or(source_.kind));
      body.pose.angle = row.pose.angle;
      body.velocity = row.velocity;
      body.id = row.id ? *row.id : scene_.free_ids.At(number_ + i);
      visit_(body);
    }
  }

  void operator()(const Cluster& cluster) const {
    for (std::int64_t i = first_; i < last_; ++i) {
      BodyDefinition body{reference::MakeCluster(0, cluster.disks, material(source_.material).density)};
      const Pose& at = cluster.at[static_cast<std::size_t>(i)];
      const Vec2 centre = Centre(at) + Rotate(at.angle, Centre(body.pose));
      body.pose = {centre.x, centre.y, at.angle};
      body.mass = cluster.mass.value_or(body.mass);
      body.inertia = cluster.inertia.value_or(body.inertia);
      body.role = BodyRole::kCluster;
      Finish(source_.material, &body);
      Give(i, std::move(body));
    }
  }

  void operator()(const Wall& wall) const {
    for (std::int64_t i = first_; i < last_; ++i) {
      const Vec2 centre = wall.one_body ? wall.centre : wall.disks[static_cast<std::size_t>(i)].centre;
      BodyDefinition body{reference::MakeWall(0, {centre.x, centre.y, 0.0})};
      body.role = BodyRole::kWall;
      Finish(source_.material, &body);
      if (wall.one_body) CopyShapes(wall, &body);
      if (!wall.one_body) body.disks = {{{}, wall.disks[static_cast<std::size_t>(i)].radius}};
      Give(i, std::move(body));
    }
  }

 private:
  const Material& material(int index) const { return scene_.materials[static_cast<std::size_t>(index)]; }

  void Finish(int material_index, BodyDefinition* body) const { Finish(material_index, source_.kind, body); }

  void Finish(int material_index, BodyKind kind, BodyDefinition* body) const {
    body->kind = kind;
    body->material = material_index;
    body->friction = material(material_index).friction;
    body->restitution = material(material_index).restitution;
    body->velocity = source_.velocity;
    if (kind == BodyKind::kPrescribed) body->mass = body->inertia = 0.0;
  }

  BodyDefinition MakeDisk(const reference::Disk& disk, int material_index, BodyKind kind) const {
    BodyDefinition body{reference::MakeDisk(0, disk.centre, disk.radius, material(material_index).density)};
    Finish(material_index, kind, &body);
    return body;
  }

  BodyDefinition MakeDisk(const reference::Disk& disk) const { return MakeDisk(disk, source_.material, source_.kind); }

  static void CopyShapes(const Wall& wall, BodyDefinition* body) {
    const Vec2 origin = wall.centre;
    for (const reference::Disk& disk : wall.disks) body->disks.push_back({disk.centre - origin, disk.radius});
    for (const reference::Segment& segment : wall.segments) body->segments.push_back({segment.a - origin, segment.b - origin});
    for (const reference::HalfPlane& plane : wall.half_planes) {
      body->half_planes.push_back({plane.normal, plane.offset - Dot(plane.normal, origin)});
    }
  }

  void Give(std::int64_t index, BodyDefinition body) const {
    body.id = source_.id ? *source_.id : scene_.free_ids.At(number_ + index);
    visit_(body);
  }

  [[noreturn]] static void RefuseChange(const DiskFile& file) {
    throw Error(
        fmt::format("{}: has fewer disks than when the scene was read; leave it alone during a run.", file.path.string()));
  }

  const Scene& scene_;
  const BodySource& source_;
  std::int64_t number_, first_, last_;
  const std::function<void(const BodyDefinition&)>& visit_;
};

/// Smallest k with floor(k ranks / n) >= rank.
std::int64_t FirstNumber(std::int64_t count, int rank, int ranks) {
  const auto n = static_cast<unsigned __int128>(count);
  const auto whole = n * static_cast<unsigned>(rank) + static_cast<unsigned>(ranks) - 1;
  return static_cast<std::int64_t>(whole / static_cast<unsigned>(ranks));
}

struct OwnId {
  std::int64_t id;
  std::int32_t source;
  std::int32_t line;  ///< of the table, or 0
};

void CollectIds(const BodySource& source, std::int32_t index, std::vector<OwnId>* ids) {
  if (source.id) ids->push_back({*source.id, index, 0});
  if (const auto* state = std::get_if<StateBodies>(&source.what)) {
    for (const std::int64_t id : StateReader(state->path).Ids()) ids->push_back({id, index, 0});
  }
  const auto* file = std::get_if<DiskFile>(&source.what);
  if (file == nullptr || !file->has_ids) return;
  DiskFileReader reader(file->path);
  for (DiskRow row; reader.Next(&row);) ids->push_back({*row.id, index, static_cast<std::int32_t>(row.line)});
}

std::string Place(const Scene& scene, const OwnId& id) {
  const BodySource& source = scene.bodies[static_cast<std::size_t>(id.source)];
  if (const auto* state = std::get_if<StateBodies>(&source.what)) return fmt::format("{}:", state->path.string());
  if (id.line == 0) return fmt::format("{}:{}: key '{}.id'", scene.file.string(), source.line, source.key);
  return fmt::format("{}:{}:", std::get<DiskFile>(source.what).path.string(), id.line);
}

}  // namespace

std::int64_t CountBodies(const Scene& scene) {
  std::int64_t count = 0;
  for (const BodySource& source : scene.bodies) count += source.count;
  return count;
}

bool TakesFreeIds(const BodySource& source) {
  const auto* file = std::get_if<DiskFile>(&source.what);
  return !source.id && !std::holds_alternative<StateBodies>(source.what) && !(file != nullptr && file->has_ids);
}

void ForEachBody(const Scene& scene, int rank, int ranks, const std::function<void(const BodyDefinition&)>& visit) {
  const std::int64_t count = CountBodies(scene);
  const std::int64_t begin = FirstNumber(count, rank, ranks), end = FirstNumber(count, rank + 1, ranks);
  if (end - begin > kMostBodiesOfARank) {
    throw Error(
        fmt::format("{}: makes {} bodies, {} on one process; at most {} are possible there: give fewer, or start more ranks.",
                    scene.file.string(), count, end - begin, kMostBodiesOfARank));
  }
  std::int64_t place = 0, number = 0;
  for (const BodySource& source : scene.bodies) {
    const std::int64_t first = std::max<std::int64_t>(begin - place, 0);
    const std::int64_t last = std::min(end - place, source.count);
    if (first < last) std::visit(SourceVisitor(scene, source, number, first, last, visit), source.what);
    place += source.count;
    if (TakesFreeIds(source)) number += source.count;
  }
}

FreeIds FindFreeIds(const Scene& scene) {
  std::vector<OwnId> own;
  std::int64_t needed = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    CollectIds(scene.bodies[i], static_cast<std::int32_t>(i), &own);
    if (TakesFreeIds(scene.bodies[i])) needed += scene.bodies[i].count;
  }
  std::sort(own.begin(), own.end(),
            [](const OwnId& a, const OwnId& b) { return std::tie(a.id, a.source, a.line) < std::tie(b.id, b.source, b.line); });
  const auto twin = std::adjacent_find(own.begin(), own.end(), [](const OwnId& a, const OwnId& b) { return a.id == b.id; });
  if (twin != own.end()) {
    throw Error(fmt::format("{} {} is a duplicate: the first body of this id is at {}; give each body its own, or none.",
                            Place(scene, twin[1]), twin->id, Place(scene, *twin)));
  }
  std::vector<std::int64_t> taken;
  taken.reserve(own.size());
  for (const OwnId& id : own) taken.push_back(id.id);
  return {taken, needed};
}

BodyRoles::BodyRoles(const Scene& scene) : free_ids_(scene.free_ids) {
  for (const BodySource& source : scene.bodies) {
    const bool is_wall = std::holds_alternative<Wall>(source.what), is_cluster = std::holds_alternative<Cluster>(source.what);
    if (source.id && is_wall) own_walls_.insert(*source.id);
    if (source.id && is_cluster) own_clusters_.insert(*source.id);
    if (const auto* state = std::get_if<StateBodies>(&source.what)) AddState(*state);
    if (!TakesFreeIds(source)) continue;
    numbered_ += source.count;
    if (is_wall) walls_ += source.count;
    if (!is_cluster) before_clusters_ += source.count;
  }
}

void BodyRoles::AddState(const StateBodies& bodies) {
  const StateReader state(bodies.path);
  const std::vector<std::int64_t> ids = state.Ids();
  const std::vector<BodyRole> roles = state.Roles();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (roles[i] == BodyRole::kWall) own_walls_.insert(ids[i]);
    if (roles[i] == BodyRole::kCluster) own_clusters_.insert(ids[i]);
  }
}

std::string_view BodyRoles::Of(std::int64_t id) const {
  if (own_walls_.contains(id)) return "wall";
  if (own_clusters_.contains(id)) return "cluster";
  const std::optional<std::int64_t> number = free_ids_.NumberOf(id);
  if (!number || *number >= numbered_) return {};
  if (*number < walls_) return "wall";
  return *number < before_clusters_ ? std::string_view() : "cluster";
}

namespace {

/// Number of disks of a source and the sum of their radii.
struct Sum {
  double count = 0.0;
  double radii = 0.0;
};

struct SourceSum {
  double bodies;

  Sum operator()(const StateBodies& state) const {
    return state.mean_radius > 0.0 ? Sum{bodies, bodies * state.mean_radius} : Sum{};
  }
  Sum operator()(const SingleDisk& disk) const { return {1.0, disk.radius}; }
  Sum operator()(const DiskFile& file) const { return {static_cast<double>(file.free), file.free_radii}; }
  Sum operator()(const Lattice& lattice) const { return {bodies, bodies * 0.5 * (lattice.min_radius + lattice.max_radius)}; }
  Sum operator()(const Deposition& bed) const { return {bodies, bodies * 0.5 * (bed.min_radius + bed.max_radius)}; }
  Sum operator()(const Cluster& cluster) const {
    Sum sum{bodies * static_cast<double>(cluster.disks.size()), 0.0};
    for (const reference::Disk& disk : cluster.disks) sum.radii += bodies * disk.radius;
    return sum;
  }
  Sum operator()(const Wall&) const { return {}; }
};

}  // namespace

double MeanGrainRadius(const Scene& scene) {
  Sum total;
  for (const BodySource& source : scene.bodies) {
    if (source.kind != BodyKind::kFree && !std::holds_alternative<DiskFile>(source.what)) continue;
    const Sum sum = std::visit(SourceSum{static_cast<double>(source.count)}, source.what);
    total.count += sum.count;
    total.radii += sum.radii;
  }
  return total.radii / total.count;
}

}  // namespace nscdd

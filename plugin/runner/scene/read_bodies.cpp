// SPDX-License-Identifier: Apache-2.0
#include "scene/read_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

#include "nscdd/error.h"
#include "scene/disk_file.h"
#include "scene/text.h"

namespace nscdd {
namespace {

constexpr std::size_t kMostClusterDisks = 100'000'000;  // of one entry
constexpr std::int64_t kMostBodies = 1'000'000'000;

/// False when the radius is so small or large that mass or inertia vanish or overflow.
bool HasMass(double radius, double density) {
  const reference::Body disk = reference::MakeDisk(0, {}, radius, density);
  return std::isnormal(disk.mass) && std::isnormal(disk.inertia);
}

void CheckMass(const TableReader& entry, std::string_view key, double radius, const Material& material) {
  if (HasMass(radius, material.density)) return;
  entry.Refuse(key, fmt::format("{} m with density {} kg/m^2 gives a mass that no computer number holds; change one of them",
                                radius, material.density));
}

/// A table that the scene names; a relative path begins in the scene's folder.
std::filesystem::path TablePath(TableReader* entry) {
  const std::filesystem::path path = entry->file().parent_path() / entry->Text("file");
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    entry->Refuse("file",
                  fmt::format("names {}, which is no file; correct the name, which is relative to the scene's folder, or "
                              "add the file",
                              path.string()));
  }
  return path;
}

/// Free unless the file says otherwise; [[walls]] are the usual place of prescribed bodies.
BodyKind ReadKind(TableReader* entry) {
  return entry->Choice("kind", {"free", "prescribed"}, "free") == "free" ? BodyKind::kFree : BodyKind::kPrescribed;
}

std::optional<std::int64_t> ReadId(TableReader* entry) {
  if (!entry->Has("id")) return std::nullopt;
  return entry->Integer("id", 0);
}

/// `radius = r` or `radius = [r0, r1]`.
std::pair<double, double> ReadRadii(TableReader* entry) {
  const bool is_list = entry->Has("radius") && entry->table().get("radius")->is_array();
  if (!is_list) {
    const double radius = entry->Number("radius", Bound::kPositive, "[m], or the range [smallest, largest]");
    return {radius, radius};
  }
  const std::vector<double> radii = entry->List("radius", 2, "[smallest, largest] [m]");
  if (!(radii[0] > 0.0 && radii[0] <= radii[1])) {
    entry->Refuse("radius", fmt::format("is [{}, {}]; give [smallest, largest] > 0 [m]", radii[0], radii[1]));
  }
  return {radii[0], radii[1]};
}

std::pair<double, double> ReadSides(TableReader* entry) {
  const std::vector<double> sides = entry->List("x", 2, "[left, right] [m]");
  if (!(sides[0] < sides[1]))
    entry->Refuse("x", fmt::format("is [{}, {}]; give [left, right] with left < right [m]", sides[0], sides[1]));
  return {sides[0], sides[1]};
}

/// Keys that lattices and depositions share.
template <typename Generator>
BodySource ReadGenerator(TableReader* entry, const Scene& scene, Generator* generator) {
  BodySource source = ReadSource(entry, scene);
  source.kind = ReadKind(entry);
  source.count = entry->Integer("count", 1, {}, kMostBodies);
  std::tie(generator->left, generator->right) = ReadSides(entry);
  generator->bottom = entry->Number("bottom", Bound::kFinite, "[m]");
  std::tie(generator->min_radius, generator->max_radius) = ReadRadii(entry);
  generator->seed = static_cast<std::uint64_t>(entry->Integer("seed", 0, 0));
  const Material& material = scene.materials[static_cast<std::size_t>(source.material)];
  CheckMass(*entry, "radius", generator->min_radius, material);
  CheckMass(*entry, "radius", generator->max_radius, material);
  if (2.0 * generator->max_radius > generator->right - generator->left) {
    entry->Refuse("x", fmt::format("is narrower than the largest disk ({} m); widen it or give smaller radii",
                                   2.0 * generator->max_radius));
  }
  return source;
}

BodySource ReadLattice(TableReader* entry, const Scene& scene) {
  Lattice lattice;
  BodySource source = ReadGenerator(entry, scene, &lattice);
  lattice.jitter = entry->Number("jitter", Bound::kNotNegative, "[m]", 0.0);
  lattice.spacing = entry->Number("spacing", Bound::kPositive, "[m]", 2.0 * (lattice.max_radius + lattice.jitter));
  lattice.hexagonal = entry->Choice("pattern", {"square", "hexagonal"}, "square") == "hexagonal";
  if (LatticeColumns(lattice) < 1)
    entry->Refuse("x", "is too narrow for one column of this lattice; widen it, or reduce jitter or spacing");
  const Vec2 last = LatticeDisk(lattice, source.count - 1).centre;
  if (!std::isfinite(last.x + last.y))
    entry->Refuse("count", "leads beyond the largest number; give fewer disks or a smaller spacing");
  source.what = lattice;
  return source;
}

BodySource ReadDeposition(TableReader* entry, const Scene& scene) {
  Deposition deposition;
  BodySource source = ReadGenerator(entry, scene, &deposition);
  source.what = deposition;
  return source;
}

/// How far the centres of a table reach out of the plane.
struct Depth {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, largest_radius = 0.0;  // [m]

  void Add(const DiskRow& row) {
    lowest = std::min(lowest, row.z);
    highest = std::max(highest, row.z);
    largest_radius = std::max(largest_radius, row.radius);
  }
  bool IsPlane() const { return highest - lowest <= 1e-3 * largest_radius; }
};

/// Reads the file through: counts its rows and checks each.
BodySource ReadDiskFile(TableReader* entry, const Scene& scene, Notes* notes) {
  BodySource source = ReadSource(entry, scene);
  source.kind = ReadKind(entry);
  DiskFile file{.path = TablePath(entry)};
  DiskFileReader reader(file.path);
  source.count = 0;
  Depth depth;
  for (;; ++source.count) {
    DiskRow row;
    if (!reader.Next(&row)) break;
    depth.Add(row);
    if (row.kind.value_or(source.kind) == BodyKind::kFree) {
      ++file.free;
      file.free_radii += row.radius;
    }
    const std::string where = fmt::format("{}:{}:", file.path.string(), row.line);
    const int material = row.material.empty() ? source.material : FindMaterial(scene, row.material, where);
    if (!HasMass(row.radius, scene.materials[static_cast<std::size_t>(material)].density)) {
      throw Error(fmt::format("{} radius {} m gives a mass that no computer number holds; change it.", where, row.radius));
    }
  }
  if (source.count == 0)
    entry->Refuse("file", fmt::format("names {}, which has no disk; add rows or leave the entry out", file.path.string()));
  if (!depth.IsPlane()) {
    entry->Refuse("file",
                  fmt::format("names {}, whose spheres are no plane of disks: z goes from {} to {} m; keep the rows of one "
                              "layer, or give just the plane's two coordinates, as x and y",
                              file.path.string(), depth.lowest, depth.highest));
  }
  file.has_ids = reader.has_ids();
  const std::vector<std::string> remarks = reader.Remarks();
  notes->sentences.insert(notes->sentences.end(), remarks.begin(), remarks.end());
  source.what = std::move(file);
  return source;
}

BodySource ReadDisk(TableReader* entry, const Scene& scene, Notes* notes) {
  if (entry->Has("file")) return ReadDiskFile(entry, scene, notes);
  BodySource source = ReadSource(entry, scene);
  source.kind = ReadKind(entry);
  source.id = ReadId(entry);
  SingleDisk disk;
  const Vec2 centre = entry->Vector("centre", "[m]");
  disk.pose = {centre.x, centre.y, entry->Number("angle", Bound::kFinite, "[rad]", 0.0)};
  disk.radius = entry->Number("radius", Bound::kPositive, "[m]");
  CheckMass(*entry, "radius", disk.radius, scene.materials[static_cast<std::size_t>(source.material)]);
  source.what = disk;
  return source;
}

std::optional<double> ReadOptional(TableReader* entry, std::string_view key, std::string_view unit) {
  if (!entry->Has(key)) return std::nullopt;
  return entry->Number(key, Bound::kPositive, unit);
}

BodySource ReadCluster(TableReader* entry, const Scene& scene) {
  BodySource source = ReadSource(entry, scene);
  source.kind = ReadKind(entry);
  Cluster cluster;
  for (const auto& row : entry->Rows("disks", 3, "[x, y, radius] [m]", 1)) {
    if (!(row[2] > 0.0)) entry->Refuse("disks", fmt::format("has a disk of radius {}; give radii > 0 [m]", row[2]));
    CheckMass(*entry, "disks", row[2], scene.materials[static_cast<std::size_t>(source.material)]);
    cluster.disks.push_back({{row[0], row[1]}, row[2]});
  }
  if (entry->Has("at")) {
    for (const auto& row : entry->Rows("at", 3, "[x, y, angle] [m, m, rad]", 1)) cluster.at.push_back({row[0], row[1], row[2]});
  } else {
    cluster.at.push_back({});
  }
  cluster.mass = ReadOptional(entry, "mass", "[kg]");
  cluster.inertia = ReadOptional(entry, "inertia", "[kg m^2]");
  source.id = ReadId(entry);
  source.count = static_cast<std::int64_t>(cluster.at.size());
  if (cluster.at.size() * cluster.disks.size() > kMostClusterDisks) {
    entry->Refuse("at", fmt::format("makes more than {} disks in all; give fewer places", kMostClusterDisks));
  }
  if (source.id && source.count > 1)
    entry->Refuse("id", "names one body but 'at' makes several; give one place or leave the id out");
  source.what = std::move(cluster);
  return source;
}

using ReadEntry = std::function<BodySource(TableReader*, const Scene&)>;

void ReadAll(TableReader* root, std::string_view key, const ReadEntry& read, Scene* scene) {
  for (TableReader& entry : root->Tables(key)) {
    scene->bodies.push_back(read(&entry, *scene));
    entry.Finish();
  }
}

}  // namespace

int FindMaterial(const Scene& scene, const std::string& name, const std::string& where) {
  std::vector<std::string> names;
  for (const Material& material : scene.materials) {
    if (material.name == name) return static_cast<int>(names.size());
    names.push_back(material.name);
  }
  throw Error(Sentence(
      fmt::format("{} material '{}' is not one of [[materials]]; {}", where, name, Suggestion(name, names, "known names"))));
}

BodySource ReadSource(TableReader* entry, const Scene& scene) {
  BodySource source;
  source.key = entry->path();
  source.line = entry->Line();
  if (entry->Has("material")) {
    const std::string where =
        fmt::format("{}:{}: key '{}.material':", entry->file().string(), entry->Line("material"), entry->path());
    source.material = FindMaterial(scene, entry->Text("material"), where);
  }
  const Vec2 velocity = entry->Vector("velocity", "[m/s]", Vec2{});
  source.velocity = {velocity.x, velocity.y, entry->Number("spin", Bound::kFinite, "[rad/s]", 0.0)};
  return source;
}

void ReadGrains(TableReader* root, Scene* scene) {
  const auto read_disk = [&](TableReader* entry, const Scene& so_far) { return ReadDisk(entry, so_far, &scene->notes); };
  ReadAll(root, "disks", read_disk, scene);
  ReadAll(root, "lattices", ReadLattice, scene);
  ReadAll(root, "depositions", ReadDeposition, scene);
  ReadAll(root, "clusters", ReadCluster, scene);
}

}  // namespace nscdd

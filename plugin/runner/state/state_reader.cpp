// SPDX-License-Identifier: Apache-2.0
#include "state/state_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "nscdd/error.h"
#include "results/hdf5_file.h"
#include "results/mapped_file.h"
#include "state/state_columns.h"

namespace nscdd {
namespace {

constexpr std::int64_t kBlock = 1 << 15;  // bodies read at a time

}  // namespace

class StateReader::Impl {
 public:
  explicit Impl(const std::filesystem::path& path) : path_(path), checksum_(SealOf(path)), file_(Open(path)) {
    Guard([&] {
      ReadHead();
      bodies_ = Rows("/bodies", "id");
      disks_ = Rows("/disks", "x");
      segments_ = Rows("/segments", "x0");
      planes_ = Rows("/half_planes", "offset");
    });
  }

  const StateHead& head() const { return head_; }
  std::uint64_t checksum() const { return checksum_; }
  std::int64_t bodies() const { return bodies_; }

  std::vector<std::int64_t> Ids() const {
    std::vector<std::int64_t> ids;
    Guard([&] { file_.ReadRows(file_.OpenGroup("/bodies"), "id", 0, bodies_, &ids); });
    return ids;
  }

  std::vector<BodyRole> Roles() const {
    std::vector<BodyRole> roles;
    Guard([&] { file_.ReadRows(file_.OpenGroup("/bodies"), "role", 0, bodies_, &roles); });
    return roles;
  }

  void ForEachBody(std::int64_t first, std::int64_t last, const std::function<void(const BodyDefinition&)>& visit) const {
    for (; first < last; first += kBlock) {
      std::vector<BodyDefinition> block;
      Guard([&] { block = ReadBlock(first, std::min(kBlock, last - first)); });
      for (const BodyDefinition& body : block) visit(body);
    }
  }

  std::vector<std::vector<std::byte>> SolverParts() const {
    std::vector<std::vector<std::byte>> parts;
    Guard([&] {
      const Hdf5Handle group = file_.OpenGroup("/solver");
      std::vector<std::int64_t> sizes;
      file_.ReadColumn(group, "part_size", &sizes);
      const auto total = static_cast<std::int64_t>(file_.RowsOf(group, "parts"));
      std::int64_t first = 0;
      for (const std::int64_t size : sizes) {
        if (size < 0 || size > total - first) throw Error("the solver's state is longer than it is");
        std::vector<std::uint8_t> bytes;
        file_.ReadRows(group, "parts", first, size, &bytes);
        const auto* begin = reinterpret_cast<const std::byte*>(bytes.data());
        parts.emplace_back(begin, begin + bytes.size());
        first += size;
      }
    });
    return parts;
  }

 private:
  template <class Work>
  void Guard(Work&& work) const {
    const Hdf5Silence silence;
    try {
      work();
    } catch (const Error& e) {
      throw Error(Sentence(path_, e.what()));
    }
  }

  static std::string Sentence(const std::filesystem::path& path, const std::string& clause) {
    const std::string end = clause.ends_with('.') ? "" : ".";
    return fmt::format("{} cannot be used as a state: {}{}", path.string(), clause, end);
  }

  /// HDF5 sees only files that are as they were written.
  static std::uint64_t SealOf(const std::filesystem::path& path) {
    const MappedFile file(path);
    try {
      return CheckSeal(file.bytes());
    } catch (const Error& e) {
      throw Error(Sentence(path, e.what()));
    }
  }

  static Hdf5File Open(const std::filesystem::path& path) {
    const Hdf5Silence silence;
    return Hdf5File::Open(path);
  }

  std::int64_t Rows(const char* group, const char* column) const {
    return static_cast<std::int64_t>(file_.RowsOf(file_.OpenGroup(group), column));
  }

  auto Attributes(const Hdf5Handle& object) const {
    return [&](const char* name, auto& value) { file_.ReadAttribute(object, name, &value); };
  }

  void ReadHead() {
    const Hdf5Handle root = file_.OpenGroup("/");
    ForEachStateAttribute(head_, Attributes(root));
    for (const std::string& name : file_.Names(file_.OpenGroup("/materials"))) {
      const Hdf5Handle group = file_.OpenGroup("/materials/" + name);
      ForEachMaterialAttribute(head_.materials.emplace_back(), Attributes(group));
    }
    std::vector<std::uint8_t> run;
    file_.ReadColumn(root, "run", &run);
    head_.run.assign(run.begin(), run.end());
    CheckHead();
  }

  void CheckHead() const {
    const RunClock& clock = head_.clock;
    const bool counts = clock.step >= 0 && clock.even_since >= 0 && clock.even_since <= clock.step && clock.step < kMostSteps;
    if (!counts || !std::isfinite(clock.time + clock.even_time) || !(head_.dt > 0.0)) throw Error("its clock makes no sense");
    if (head_.materials.empty()) throw Error("it has no material");
    for (const Material& m : head_.materials) {
      const bool good = std::isfinite(m.density + m.friction) && m.density > 0.0 && m.friction >= 0.0 && m.restitution >= 0.0 &&
                        m.restitution <= 1.0;
      if (!good) throw Error(fmt::format("its material '{}' has an impossible number", m.name));
    }
  }

  std::vector<BodyDefinition> ReadBlock(std::int64_t first, std::int64_t count) const {
    StateBodyTable t;
    // One row more, for where the shapes of the last body end.
    const std::int64_t rows = std::min(count + 1, bodies_ - first);
    const Hdf5Handle group = file_.OpenGroup("/bodies");
    ForEachStateBodyColumn(
        t, [&](const char* name, const char*, auto& column) { file_.ReadRows(group, name, first, rows, &column); });
    if (rows == count) {
      t.first_disk.push_back(disks_);
      t.first_segment.push_back(segments_);
      t.first_half_plane.push_back(planes_);
    }
    const StateShapeTables shapes = ReadShapes(t, static_cast<std::size_t>(count));
    std::vector<BodyDefinition> bodies;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) bodies.push_back(MakeBody(t, shapes, i));
    return bodies;
  }

  StateShapeTables ReadShapes(const StateBodyTable& t, std::size_t count) const {
    StateShapeTables shapes;
    const auto reader = [&](const char* name, const std::vector<std::int64_t>& first, std::int64_t total) {
      if (!std::is_sorted(first.begin(), first.end()) || first.front() < 0 || first[count] > total)
        throw Error(fmt::format("its table {} has other rows than its bodies say", name));
      return
          [this, group = file_.OpenGroup(name), begin = first.front(), rows = first[count] - first.front()](
              const char* column_name, const char*, auto& column) { file_.ReadRows(group, column_name, begin, rows, &column); };
    };
    ForEachStateDiskColumn(shapes, reader("/disks", t.first_disk, disks_));
    ForEachStateSegmentColumn(shapes, reader("/segments", t.first_segment, segments_));
    ForEachStatePlaneColumn(shapes, reader("/half_planes", t.first_half_plane, planes_));
    return shapes;
  }

  BodyDefinition MakeBody(const StateBodyTable& t, const StateShapeTables& shapes, std::size_t i) const {
    BodyDefinition body;
    body.id = t.id[i];
    if (t.kind[i] > 1) throw Error(fmt::format("body {} is of the unknown kind {}", body.id, t.kind[i]));
    body.kind = static_cast<BodyKind>(t.kind[i]);
    if (t.role[i] > BodyRole::kWall) throw Error(fmt::format("body {} has an unknown role", body.id));
    body.role = t.role[i];
    body.material = t.material[i];
    if (body.material < 0 || body.material >= std::ssize(head_.materials))
      throw Error(fmt::format("body {} has the unknown material {}", body.id, body.material));
    const Material& material = head_.materials[static_cast<std::size_t>(body.material)];
    body.friction = material.friction;
    body.restitution = material.restitution;
    body.mass = t.mass[i];
    body.inertia = t.inertia[i];
    body.pose = {t.x[i], t.y[i], t.angle[i]};
    body.velocity = {t.vx[i], t.vy[i], t.spin[i]};
    AddShapes(t, shapes, i, &body);
    reference::Validate(body);
    return body;
  }

  static void AddShapes(const StateBodyTable& t, const StateShapeTables& shapes, std::size_t i, BodyDefinition* body) {
    const auto for_each = [i](const std::vector<std::int64_t>& first, auto&& add) {
      for (auto k = first[i]; k < first[i + 1]; ++k) add(static_cast<std::size_t>(k - first.front()));
    };
    for_each(t.first_disk, [&](std::size_t k) {
      body->disks.push_back({{shapes.disk_x[k], shapes.disk_y[k]}, shapes.disk_radius[k]});
    });
    for_each(t.first_segment, [&](std::size_t k) {
      body->segments.push_back({{shapes.segment_x0[k], shapes.segment_y0[k]}, {shapes.segment_x1[k], shapes.segment_y1[k]}});
    });
    for_each(t.first_half_plane, [&](std::size_t k) {
      body->half_planes.push_back({{shapes.plane_normal_x[k], shapes.plane_normal_y[k]}, shapes.plane_offset[k]});
    });
  }

  static constexpr std::int64_t kMostSteps = std::int64_t{1} << 62;

  std::filesystem::path path_;
  std::uint64_t checksum_;
  Hdf5File file_;
  StateHead head_;
  std::int64_t bodies_ = 0, disks_ = 0, segments_ = 0, planes_ = 0;
};

StateReader::StateReader(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
StateReader::~StateReader() = default;
const StateHead& StateReader::head() const { return impl_->head(); }
std::uint64_t StateReader::checksum() const { return impl_->checksum(); }
std::int64_t StateReader::bodies() const { return impl_->bodies(); }
std::vector<std::int64_t> StateReader::Ids() const { return impl_->Ids(); }
std::vector<BodyRole> StateReader::Roles() const { return impl_->Roles(); }
void StateReader::ForEachBody(std::int64_t first, std::int64_t last,
                              const std::function<void(const BodyDefinition&)>& visit) const {
  impl_->ForEachBody(first, last, visit);
}
std::vector<std::vector<std::byte>> StateReader::SolverParts() const { return impl_->SolverParts(); }

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include "extremes/extreme_case.h"
#include "scene/toml_file.h"

namespace nscdd {

extern const char kExtremeCases[];  // cases.toml

namespace {

constexpr double kGravity = 9.81;  // [m/s^2] unless a case says otherwise

/// Bodies of a case, in the order of their ids.
class Builder {
 public:
  Builder(TableReader* entry, ExtremeCase* extreme_case)
      : entry_(*entry),
        case_(*extreme_case),
        friction_(entry->Number("friction", Bound::kNotNegative, "", 0.0)),
        restitution_(entry->Number("restitution", Bound::kFraction, "", 0.0)) {}

  void AddAll() {
    AddWall();
    if (entry_.Has("squeeze")) AddSqueeze();
    if (entry_.Has("disks")) AddDisks();
    if (entry_.Has("cluster")) AddCluster();
    if (entry_.Has("stack")) AddStack();
    if (std::optional<TableReader> pile = entry_.Table("pile")) AddPile(&*pile);
  }

 private:
  std::vector<std::vector<double>> Rows(const char* key, std::size_t width) {
    return entry_.Has(key) ? entry_.Rows(key, width, "numbers", 0) : std::vector<std::vector<double>>{};
  }
  std::int64_t NextId() const { return std::ssize(case_.bodies); }
  reference::Body& Add(reference::Body body) {
    body.friction = friction_;
    body.restitution = restitution_;
    return case_.bodies.emplace_back(std::move(body));
  }
  reference::Body& AddDisk(Vec2 centre, double radius, double density = 1000.0) {
    return Add(reference::MakeDisk(NextId(), centre, radius, density));
  }

  /// A half-plane at x = 0 and one at `width` that comes with `speed`.
  void AddSqueeze() {
    const std::vector<double> numbers = entry_.List("squeeze", 2, "[width, speed] [m, m/s]");
    for (const double side : {1.0, -1.0}) {
      reference::Body wall = reference::MakeWall(NextId());
      wall.half_planes = {{{side, 0.0}, side > 0.0 ? 0.0 : -numbers[0]}};
      if (side < 0.0) wall.velocity.vx = -numbers[1];
      Add(std::move(wall));
    }
  }

  void AddWall() {
    reference::Body wall = reference::MakeWall(0);
    for (const auto& row : Rows("half_planes", 3)) wall.half_planes.push_back({{row[0], row[1]}, row[2]});
    for (const auto& row : Rows("segments", 4)) wall.segments.push_back({{row[0], row[1]}, {row[2], row[3]}});
    if (!wall.half_planes.empty() || !wall.segments.empty()) Add(std::move(wall));
  }

  void AddDisks() {
    for (const auto& row : Rows("disks", 5)) AddDisk({row[0], row[1]}, row[2]).velocity = {row[3], row[4], 0.0};
    if (!entry_.Has("fixed")) return;
    for (const toml::node& id : *entry_.table().get_as<toml::array>("fixed"))
      case_.bodies.at(id.value_or(std::size_t{0})).kind = BodyKind::kPrescribed;
  }

  void AddCluster() {
    std::vector<reference::Disk> disks;
    for (const auto& row : Rows("cluster", 3)) disks.push_back({{row[0], row[1]}, row[2]});
    Add(reference::MakeCluster(NextId(), disks, 1000.0));
  }

  void AddStack() {
    reference::Body floor = reference::MakeWall(0);
    floor.half_planes.push_back({});
    Add(std::move(floor));
    double top = 0.0;
    for (const auto& row : Rows("stack", 3)) {
      for (int k = 0; k < static_cast<int>(row[0]); ++k) {
        AddDisk({0.0, top + row[1]}, row[1], row[2]);
        top += 2.0 * row[1];
      }
    }
    case_.extent += top;
  }

  void AddPile(TableReader* pile) {
    constexpr int kColumns = 6, kRows = 5;  // columns of the even rows; the odd ones lie in their hollows
    const double r = pile->Number("radius", Bound::kPositive, "[m]", 0.5);
    const double spacing = pile->Number("spacing", Bound::kPositive, "", 1.0);
    const double other_friction = pile->Number("other_friction", Bound::kNotNegative, "", friction_);
    const double largest_velocity = pile->Number("largest_velocity", Bound::kNotNegative, "[m/s]", 0.0);
    const Vec2 origin = pile->Vector("origin", "[m]", Vec2{});
    const bool right_wall = pile->Flag("right_wall", true);
    pile->Finish();
    const double pitch = 2.0 * r * spacing, rise = std::sqrt(3.0) * r * spacing;
    const double width = (kColumns - 1) * pitch + 2.0 * r, height = kRows * 2.0 * r + 4.0 * r;
    reference::Body box = reference::MakeWall(0, {origin.x, origin.y, 0.0});
    box.segments = {{{0.0, height}, {0.0, 0.0}}, {{0.0, 0.0}, {width + (right_wall ? 0.0 : 20.0 * r), 0.0}}};
    if (right_wall) box.segments.push_back({{width, 0.0}, {width, height}});
    Add(std::move(box));
    std::mt19937 random(3);
    const auto draw = [&] { return largest_velocity * (2.0 * (random() / 4294967296.0) - 1.0); };
    for (int row = 0; row < kRows; ++row) {
      const bool odd = row % 2 == 1;
      for (int k = 0; k < kColumns - odd; ++k) {
        reference::Body& grain = AddDisk(origin + Vec2{r + pitch * (k + (odd ? 0.5 : 0.0)), r + row * rise}, r);
        if (grain.id % 2 == 0) grain.friction = other_friction;
        if (largest_velocity > 0.0) grain.velocity = {draw(), draw(), 0.0};
      }
    }
    case_.extent = std::abs(origin.x) + std::abs(origin.y) + 20.0 * r;
  }

  TableReader& entry_;
  ExtremeCase& case_;
  double friction_, restitution_;
};

ExtremeCase ReadCase(TableReader* entry) {
  ExtremeCase c;
  c.family = entry->Text("family");
  c.name = entry->Text("name");
  c.quick = entry->Flag("quick", false);
  c.gravity = entry->Vector("gravity", "[m/s^2]", Vec2{0.0, -kGravity});
  c.dt = entry->Number("dt", Bound::kPositive, "[s]", 0.01);
  c.steps = entry->Integer("steps", 1, 1);
  c.subdomains = entry->Text("subdomains", "2x2");
  c.criterion = entry->Text("criterion", "nat_max");
  c.tolerance = entry->Number("tolerance", Bound::kPositive, "", 1e-6);
  Builder(entry, &c).AddAll();
  c.tight = entry->Flag("tight", false);
  if (entry->Has("truth")) {
    const std::vector<double> v = entry->List("truth", 3, "[vx, vy, spin]");
    c.truth = {v[0], v[1], v[2]};
  }
  if (entry->Has("truths")) {
    for (const auto& row : entry->Rows("truths", 4, "[id, vx, vy, spin]", 1))
      c.truths[static_cast<std::int64_t>(row[0])] = {row[1], row[2], row[3]};
  }
  c.scale = entry->Number("scale", Bound::kPositive, "[m/s]", kGravity * c.dt);
  c.extent = entry->Number("extent", Bound::kPositive, "[m]", c.extent);
  c.amplification = entry->Number("amplification", Bound::kPositive, "", 1.0);
  c.feeds_energy = entry->Flag("feeds_energy", false);
  c.by_weight = entry->Flag("by_weight", false);
  c.has_no_solution = entry->Flag("has_no_solution", false);
  c.only_with = entry->Text("only_with", "");
  if (std::optional<TableReader> options = entry->Table("options")) {
    for (const auto& [key, node] : options->table()) c.options.emplace_back(key.str(), OptionText(*options, key.str(), node));
    if (options->Has("lambda")) c.lambda = options->Number("lambda", Bound::kNotNegative, "");
  }
  entry->Finish();
  return c;
}

}  // namespace

std::vector<ExtremeCase> ReadExtremeCases() {
  const std::filesystem::path file = "cases.toml";
  const toml::table text = ParseToml(kExtremeCases, file);
  TableReader root(text, "", file);
  std::vector<ExtremeCase> cases;
  for (TableReader& group : root.Tables("group")) {
    for (TableReader& own : group.Tables("cases")) {
      toml::table both = group.table();
      both.erase("cases");
      for (const auto& [key, node] : own.table()) both.insert_or_assign(key.str(), node);
      TableReader entry(both, own.path(), file);
      cases.push_back(ReadCase(&entry));
    }
  }
  return cases;
}

}  // namespace nscdd

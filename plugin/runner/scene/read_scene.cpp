// SPDX-License-Identifier: Apache-2.0
#include "scene/read_scene.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "nscdd/error.h"
#include "scene/body_stream.h"
#include "scene/read_bodies.h"
#include "scene/table_reader.h"
#include "scene/text.h"
#include "scene/toml_file.h"

namespace nscdd {
namespace {

constexpr std::int64_t kMostSteps = 1'000'000'000;

/// Letters, digits, '_', '-' and '.': it becomes a folder.
bool IsPlainName(const std::string& name) {
  return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return (c < 128 && std::isalnum(c)) || c == '_' || c == '-' || c == '.';
  });
}

void CheckName(const TableReader& table, std::string_view key, const std::string& name) {
  if (!IsPlainName(name)) table.Refuse(key, fmt::format("is '{}'; use only letters, digits, '_', '-' and '.'", name));
}

/// The folder of the results holds files of the run too.
void CheckPackingName(const TableReader& table, const std::string& name) {
  CheckName(table, "packing", name);
  const std::filesystem::path path = name;
  constexpr std::array kTaken = {"steps.csv",    "communication.csv", "final.csv", "results.h5",
                                 "results.xdmf", "run.json",          "state.h5"};
  const bool is_taken = std::find(kTaken.begin(), kTaken.end(), name) != kTaken.end();
  if (is_taken || path.extension() == ".part" || path.extension() == ".ckpt") {
    table.Refuse("packing", fmt::format("is '{}', a name of the run's own files; give another one, such as packing.csv", name));
  }
}

void ReadHead(TableReader* root, Scene* scene) {
  scene->name = scene->file.stem().string();
  std::optional<TableReader> table = root->Table("scene");
  if (!table) return;
  if (table->Has("name")) {
    scene->name = table->Text("name");
    CheckName(*table, "name", scene->name);
  }
  scene->title = table->Text("title", "");
  scene->adapter = table->Choice("adapter", {"box2d", "reference"}, scene->adapter);
  table->Finish();
}

void ReadTime(TableReader* root, Scene* scene) {
  std::optional<TableReader> table = root->Table("time");
  if (!table) root->Refuse("time", "is missing; write a table [time] with dt and steps");
  scene->time.dt = table->Number("dt", Bound::kPositive, "[s]");
  scene->time.steps = table->Integer("steps", 1, {}, kMostSteps);
  scene->time.theta = table->Number("theta", Bound::kFinite, "(of the Moreau-Jean scheme)", scene->time.theta);
  if (table->Has("theta")) scene->time.theta_line = table->Line("theta");
  table->Finish();
}

ConstantGravity ReadConstantGravity(TableReader* table) {
  if (table->Has("vector")) return {.vector = table->Vector("vector", "[m/s^2]")};
  const double g = table->Number("g", Bound::kNotNegative, "[m/s^2]", 9.81);
  const double angle = table->Number("angle", Bound::kFinite, "[rad]", 0.0);
  return {{g * std::sin(angle), -g * std::cos(angle)}, angle};
}

RotatingGravity ReadRotatingGravity(TableReader* table) {
  RotatingGravity law;
  law.g = table->Number("g", Bound::kNotNegative, "[m/s^2]", law.g);
  law.from_angle = table->Number("from_angle", Bound::kFinite, "[rad]");
  law.to_angle = table->Number("to_angle", Bound::kFinite, "[rad]");
  if (table->Has("in_steps") == table->Has("in_time")) {
    table->Refuse("in_steps", "and 'in_time' say the same; give exactly one of them");
  }
  if (table->Has("in_steps")) {
    law.in_steps = table->Integer("in_steps", 2, {}, kMostSteps);
  } else {
    law.in_time = table->Number("in_time", Bound::kPositive, "[s]");
  }
  return law;
}

GravityTable ReadGravityTable(TableReader* table) {
  GravityTable law;
  for (const auto& row : table->Rows("table", 3, "[time, gx, gy] [s, m/s^2, m/s^2]", 1)) {
    if (!law.samples.empty() && row[0] <= law.samples.back().time) {
      table->Refuse("table",
                    fmt::format("has time {} after time {}; give times in ascending order", row[0], law.samples.back().time));
    }
    law.samples.push_back({row[0], {row[1], row[2]}});
  }
  return law;
}

void ReadGravity(TableReader* root, Scene* scene) {
  std::optional<TableReader> table = root->Table("gravity");
  if (!table) return;
  const std::string kind = table->Choice("kind", {"constant", "rotating", "table"}, "constant");
  if (kind == "constant") scene->gravity = ReadConstantGravity(&*table);
  if (kind == "rotating") scene->gravity = ReadRotatingGravity(&*table);
  if (kind == "table") scene->gravity = ReadGravityTable(&*table);
  table->Finish();
}

void ReadPeriodicity(TableReader* root, Scene* scene) {
  std::optional<TableReader> table = root->Table("periodic");
  if (!table) return;
  const std::vector<double> x = table->List("x", 2, "[origin, length] [m]");
  if (!(x[1] > 0.0)) table->Refuse("x", fmt::format("is [{}, {}]; give [origin, length] with length > 0 [m]", x[0], x[1]));
  const std::optional<Periodicity> before = scene->periodic;  // of the state file
  scene->periodic = Periodicity{x[0], x[1]};
  if (scene->start && !(before && before->origin == x[0] && before->length == x[1])) {
    const std::string was = before ? fmt::format("[{}, {}]", before->origin, before->length) : "not periodic";
    table->Refuse("x", fmt::format("is [{}, {}], the bodies of {} were {}; leave it out, it is taken from the file", x[0], x[1],
                                   scene->start->path.string(), was));
  }
  table->Finish();
}

/// Those of a state file are there already: an entry of the same name changes what its bodies are like to the touch.
void ReadMaterials(TableReader* root, Scene* scene) {
  std::set<std::string> read;
  for (TableReader& entry : root->Tables("materials")) {
    Material material;
    material.name = entry.Text("name");
    if (!read.insert(material.name).second)
      entry.Refuse("name", fmt::format("is '{}' twice; give each material its own", material.name));
    const auto known = std::find_if(scene->materials.begin(), scene->materials.end(),
                                    [&](const Material& other) { return other.name == material.name; });
    if (known != scene->materials.end()) material = *known;
    material.density = entry.Number("density", Bound::kPositive, "[kg/m^2]", material.density);
    material.friction = entry.Number("friction", Bound::kNotNegative, "", material.friction);
    material.restitution = entry.Number("restitution", Bound::kFraction, "", material.restitution);
    entry.Finish();
    if (known == scene->materials.end()) {
      scene->materials.push_back(std::move(material));
      continue;
    }
    if (material.density != known->density) {
      entry.Refuse("density",
                   fmt::format("is {}, the bodies of '{}' in {} have {} and keep their masses; leave it out, or give "
                               "new bodies a material of another name",
                               material.density, known->name, scene->start->path.string(), known->density));
    }
    *known = material;
  }
  if (scene->materials.empty()) scene->materials.push_back({.name = "default"});
}

AutoSettings ReadWish(TableReader* solver) {
  AutoSettings wish;
  if (std::optional<TableReader> accuracy = solver->Table("accuracy")) {
    wish.interpenetration = accuracy->Number("interpenetration", Bound::kPositive, "(of what `of` says)");
    wish.of_mean_radius = accuracy->Choice("of", {"mean_radius", "metre"}, "mean_radius") == "mean_radius";
    accuracy->Finish();
  }
  if (solver->Has("budget_seconds_per_step")) wish.budget = solver->Number("budget_seconds_per_step", Bound::kPositive, "[s]");
  if (!wish.interpenetration && !wish.budget) wish.interpenetration = 1e-3;
  return wish;
}

void ReadSolver(TableReader* root, Scene* scene) {
  std::optional<TableReader> table = root->Table("solver");
  scene->solver.line = table ? table->Line("name") : 1;
  if (!table) return;
  scene->solver.name = table->Text("name", scene->solver.name);
  const bool stop = table->Choice("on_nonconvergence", {"continue", "stop"}, "continue") == "stop";
  scene->solver.on_nonconvergence = stop ? OnNonconvergence::kStop : OnNonconvergence::kContinue;
  const bool is_auto = scene->solver.name == "auto";
  if (is_auto) scene->solver.wish = ReadWish(&*table);
  for (const auto& [key, node] : table->table()) {
    if (key.str() == "name" || key.str() == "on_nonconvergence") continue;
    if (is_auto && (key.str() == "accuracy" || key.str() == "budget_seconds_per_step")) continue;
    scene->solver.options.push_back({std::string(key.str()), OptionText(*table, key.str(), node), table->Line(key.str())});
  }
}

void ReadOutput(TableReader* root, Scene* scene) {
  std::optional<TableReader> table = root->Table("output");
  if (!table) return;
  if (table->Has("dir")) {
    const std::filesystem::path dir = table->Text("dir");
    if (dir.is_absolute() || std::find(dir.begin(), dir.end(), "..") != dir.end()) {
      table->Refuse("dir",
                    fmt::format("is '{}'; give a path without '..' below the current folder, or use --out", dir.string()));
    }
    scene->output.dir = dir.string();
  }
  if (table->Has("save_every")) scene->output.save_every = table->Integer("save_every", 1, {}, kMostSteps);
  if (table->Has("checkpoint_every")) scene->output.checkpoint_every = table->Integer("checkpoint_every", 1, {}, kMostSteps);
  if (table->Has("packing")) {
    scene->output.packing = table->Text("packing");
    CheckPackingName(*table, scene->output.packing);
  }
  table->Finish();
}

bool HasFreeBody(const BodySource& source) {
  const auto* file = std::get_if<DiskFile>(&source.what);
  return file != nullptr ? file->free > 0 : source.kind == BodyKind::kFree;
}

/// Names of materials stand in it between commas.
void CheckPackingMaterials(const TableReader& root, const Scene& scene) {
  if (scene.output.packing.empty()) return;
  for (const Material& material : scene.materials) {
    const std::string& name = material.name;
    const bool fits =
        !name.empty() && name.find_first_of(",\"'#\n\r\t") == std::string::npos && name.front() != ' ' && name.back() != ' ';
    if (!fits) {
      root.Refuse("output.packing", fmt::format("cannot hold the material '{}'; give it a name without commas, quotes, '#' and "
                                                "spaces at its ends",
                                                name));
    }
  }
}

void CheckBodies(const TableReader& root, const Scene& scene) {
  if (scene.bodies.empty())
    root.Refuse("disks",
                "is missing, and so is every other body; add [[disks]], [[lattices]], [[depositions]] or [[clusters]]");
  const bool any_free = std::any_of(scene.bodies.begin(), scene.bodies.end(), HasFreeBody);
  if (!any_free) root.Refuse("disks", "has no free body in it, nor has any other table; add one that can move");
}

}  // namespace

Scene ReadSceneFile(const std::filesystem::path& path) { return ParseScene(ReadTomlText(path), path); }

Scene ParseScene(const std::string& text, const std::filesystem::path& path) {
  const toml::table table = ParseToml(text, path);
  Scene scene;
  scene.file = path;
  TableReader root(table, "", scene.file);
  ReadHead(&root, &scene);
  ReadTime(&root, &scene);
  ReadGravity(&root, &scene);
  ReadStart(&root, &scene);
  ReadPeriodicity(&root, &scene);
  ReadSolver(&root, &scene);
  ReadOutput(&root, &scene);
  ReadMaterials(&root, &scene);
  ReadWalls(&root, &scene);
  ReadGrains(&root, &scene);
  root.Finish();
  CheckPackingMaterials(root, scene);
  CheckBodies(root, scene);
  scene.free_ids = FindFreeIds(scene);
  return scene;
}

}  // namespace nscdd

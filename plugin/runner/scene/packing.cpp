// SPDX-License-Identifier: Apache-2.0
#include "scene/disk_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "nscdd/error.h"
#include "scene/body_stream.h"

namespace nscdd {
namespace {

/// Of a body, as written.
struct MotionText {
  std::string pose;      ///< "x,y,angle"
  std::string velocity;  ///< "vx,vy,spin"
};

std::map<std::int64_t, MotionText> ReadMotions(const std::filesystem::path& final_csv) {
  std::ifstream stream(final_csv);
  std::string line;
  if (!std::getline(stream, line) || !line.starts_with("id,x,y,angle,vx,vy,spin")) {
    throw Error(fmt::format("{}: does not begin with id,x,y,angle,vx,vy,spin; give the final.csv of a finished run.",
                            final_csv.string()));
  }
  std::map<std::int64_t, MotionText> motions;
  while (std::getline(stream, line)) {
    std::vector<std::string_view> fields;
    const std::optional<std::int64_t> id = SplitLine(line, Separator::kComma, &fields) ? CsvId(fields.front()) : std::nullopt;
    if (fields.size() < 7 || !id) {
      throw Error(fmt::format("{}: line '{}' is cut short; run the scene again.", final_csv.string(), line));
    }
    const auto text = [&](std::size_t first, std::size_t last) {
      return std::string(fields[first].data(), fields[last].data() + fields[last].size());
    };
    motions[*id] = {text(1, 3), text(4, 6)};
  }
  return motions;
}

/// What a table of disks leaves out.
struct Omissions {
  std::int64_t walls = 0, prescribed = 0, clusters = 0;

  std::string Sentence(const std::string& name) const {
    std::vector<std::string> what;
    const auto add = [&](std::int64_t count, const char* one, const char* several) {
      if (count > 0) what.push_back(fmt::format("{} {}", count, count == 1 ? one : several));
    };
    add(walls, "wall", "walls");
    add(prescribed, "prescribed body", "prescribed bodies");
    add(clusters, "cluster", "clusters");
    what.emplace_back("the impulses");
    return fmt::format("{} holds the free disks; not in it: {}. state.h5 holds all of it ([start] in a scene).", name,
                       fmt::join(what, ", "));
  }
};

}  // namespace

std::string WritePacking(const Scene& scene, const std::filesystem::path& final_csv, const std::filesystem::path& packing) {
  const std::map<std::int64_t, MotionText> motions = ReadMotions(final_csv);
  // A scene without [[materials]] need not know the name of its only one.
  const bool named = scene.materials.size() > 1 || scene.materials.front().name != "default";
  std::ofstream stream(packing);
  stream << "id,x,y,angle,radius,vx,vy,spin" << (named ? ",material\n" : "\n");
  Omissions omissions;
  ForEachBody(scene, 0, 1, [&](const BodyDefinition& body) {
    if (body.kind != BodyKind::kFree) {
      ++(body.role == BodyRole::kWall ? omissions.walls : omissions.prescribed);
      return;
    }
    if (body.disks.size() != 1) {
      ++omissions.clusters;
      return;
    }
    const auto motion = motions.find(body.id);
    if (motion == motions.end()) {
      throw Error(fmt::format("{}: body {} of {} is not in it; give the final.csv of this scene.", final_csv.string(), body.id,
                              scene.file.string()));
    }
    const std::string& material = scene.materials[static_cast<std::size_t>(body.material)].name;
    stream << fmt::format("{},{},{:.17g},{}{}{}\n", body.id, motion->second.pose, body.disks[0].radius, motion->second.velocity,
                          named ? "," : "", named ? material : "");
  });
  stream.close();
  if (!stream) throw Error(fmt::format("{}: cannot be written; check the folder and the space left.", packing.string()));
  return omissions.Sentence(scene.output.packing);
}

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#include "scene/packing.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <map>
#include <string>

#include "nscdd/error.h"
#include "scene/body_stream.h"

namespace nscdd {
namespace {

/// "x,y,angle" of each body, as written.
std::map<std::int64_t, std::string> ReadPoses(const std::filesystem::path& final_csv) {
  std::ifstream stream(final_csv);
  std::string line;
  if (!std::getline(stream, line) || !line.starts_with("id,x,y,angle,")) {
    throw Error(fmt::format("{}: does not begin with id,x,y,angle; give the final.csv of a finished run.", final_csv.string()));
  }
  std::map<std::int64_t, std::string> poses;
  while (std::getline(stream, line)) {
    const auto after_id = line.find(',');
    std::size_t end = after_id;
    for (int i = 0; i < 3 && end != std::string::npos; ++i) end = line.find(',', end + 1);
    std::int64_t id = 0;
    const auto parsed = std::from_chars(line.data(), line.data() + line.size(), id);
    if (end == std::string::npos || parsed.ec != std::errc{}) {
      throw Error(fmt::format("{}: line '{}' is cut short; run the scene again.", final_csv.string(), line));
    }
    poses[id] = line.substr(after_id + 1, end - after_id - 1);
  }
  return poses;
}

}  // namespace

void WritePacking(const Scene& scene, const std::filesystem::path& final_csv, const std::filesystem::path& packing) {
  const std::map<std::int64_t, std::string> poses = ReadPoses(final_csv);
  std::ofstream stream(packing);
  stream << "id,x,y,angle,radius\n";
  ForEachBody(scene, 0, 1, [&](const BodyDefinition& body) {
    if (body.kind != BodyKind::kFree || body.disks.size() != 1) return;
    const auto pose = poses.find(body.id);
    if (pose == poses.end()) {
      throw Error(fmt::format("{}: body {} of {} is not in it; give the final.csv of this scene.", final_csv.string(), body.id,
                              scene.file.string()));
    }
    stream << fmt::format("{},{},{:.17g}\n", body.id, pose->second, body.disks[0].radius);
  });
  stream.close();
  if (!stream) throw Error(fmt::format("{}: cannot be written; check the folder and the space left.", packing.string()));
}

}  // namespace nscdd

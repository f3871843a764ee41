// SPDX-License-Identifier: Apache-2.0
#include "checkpoint/run_record.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "nscdd/error.h"

namespace nscdd {

// Found by the JSON library beside the types.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FileExtent, name, size, crc)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(InputFile, path, hash)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunRecord, program, plugin_path, plugin, scene_text, scene_file, scene_path, scene_hash,
                                   inputs, notes, adapter, solver, options, steps, save_every, checkpoint_every)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CheckpointHead, run, pilot, step, ranks, tables, segments)

std::string FormatHead(const CheckpointHead& head) { return nlohmann::json(head).dump(); }

CheckpointHead ParseHead(const std::string& text) {
  // All numbers of a head are integers; the library would convert 1e300 to one, which is undefined.
  const auto is_sound = [](int, nlohmann::json::parse_event_t, const nlohmann::json& value) {
    if (value.is_number_float()) throw Error("its description has a number that is no integer");
    return true;
  };
  try {
    const auto head = nlohmann::json::parse(text, is_sound).get<CheckpointHead>();
    if (head.step < 0 || head.ranks < 1 || head.run.steps < 1) throw Error("its counters make no sense");
    return head;
  } catch (const nlohmann::json::exception& e) {
    throw Error(fmt::format("its description cannot be read ({})", std::string_view(e.what()).substr(0, 200)));
  }
}

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#include "checkpoint/checkpoint.h"

#include <fmt/format.h>
#include <array>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>

#include "nscdd/error.h"
#include "results/crc64.h"
#include "results/run_files.h"
#include "results/written_file.h"

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

namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> kMark = {'n', 's', 'c', 'd', 'd', 'c', 'k', 'p'};
constexpr std::uint32_t kVersion = 1;
constexpr std::uint32_t kByteOrder = 0x01020304;

/// The beginning of the file.
struct Prologue {
  std::array<char, 8> mark = kMark;
  std::uint32_t version = kVersion;
  std::uint32_t byte_order = kByteOrder;
  std::uint64_t file_size = 0;
  std::uint64_t head_size = 0;
};

/// The beginning of a section.
struct SectionSize {
  std::uint64_t bodies = 0;
  std::uint64_t state_size = 0;
};

using Crc = std::uint64_t;  // the end of the file: CRC-64/XZ of all before it

template <class T>
std::span<const std::byte> BytesOf(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

/// Takes pieces off the beginning of the file's bytes.
class Cutter {
 public:
  explicit Cutter(std::span<const std::byte> bytes) : rest_(bytes) {}

  std::span<const std::byte> Take(std::uint64_t size) {
    if (size > rest_.size()) throw Error("its parts are longer than the file");
    const auto piece = rest_.first(static_cast<std::size_t>(size));
    rest_ = rest_.subspan(piece.size());
    return piece;
  }

  template <class T>
  T Get() {
    T value;
    std::memcpy(&value, Take(sizeof(T)).data(), sizeof(T));
    return value;
  }

  bool empty() const { return rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
};

void CheckWhole(std::span<const std::byte> bytes) {
  if (bytes.size() < sizeof(Prologue) + sizeof(Crc)) throw Error(fmt::format("it has only {} bytes", bytes.size()));
  const auto prologue = Cutter(bytes).Get<Prologue>();
  if (prologue.mark != kMark) throw Error("it is no checkpoint of nscdd");
  if (prologue.byte_order != kByteOrder) throw Error("it is damaged, or of a machine with another byte order");
  if (prologue.version != kVersion) {
    throw Error(fmt::format("it is damaged, or of format version {}; this program reads {}", prologue.version, kVersion));
  }
  if (prologue.file_size != bytes.size()) {
    throw Error(fmt::format("it has {} bytes, {} were written", bytes.size(), prologue.file_size));
  }
  if (Cutter(bytes.last(sizeof(Crc))).Get<Crc>() != Crc64Of(bytes.first(bytes.size() - sizeof(Crc))))
    throw Error("it is damaged: its checksum is another one");
}

std::vector<std::byte> MakeSection(const std::vector<SavedBody>& bodies, std::span<const std::byte> state) {
  const SectionSize size{bodies.size(), state.size()};
  std::vector<std::byte> section;
  for (const auto part : {BytesOf(size), std::as_bytes(std::span(bodies)), state})
    section.insert(section.end(), part.begin(), part.end());
  return section;
}

/// The last two stay.
void RemoveOlder(const fs::path& folder) {
  const std::vector<std::int64_t> steps = CheckpointSteps(folder);
  std::error_code ignored;  // one too many does no harm
  for (std::size_t i = 0; i + 2 < steps.size(); ++i) fs::remove(folder / CheckpointName(steps[i]), ignored);
}

}  // namespace

SavedBody CheckpointSection::body(std::size_t i) const {
  SavedBody body;
  std::memcpy(&body, &bodies[i * sizeof(SavedBody)], sizeof body);
  return body;
}

Checkpoint ParseCheckpoint(std::span<const std::byte> bytes) {
  CheckWhole(bytes);
  Cutter cutter(bytes.first(bytes.size() - sizeof(Crc)));
  const auto prologue = cutter.Get<Prologue>();
  const auto text = cutter.Take(prologue.head_size);
  Checkpoint checkpoint;
  checkpoint.head = ParseHead({reinterpret_cast<const char*>(text.data()), text.size()});
  while (!cutter.empty()) {
    const auto size = cutter.Get<SectionSize>();
    if (size.bodies > bytes.size()) throw Error("its parts are longer than the file");
    const auto bodies = cutter.Take(size.bodies * sizeof(SavedBody));
    checkpoint.sections.push_back({bodies, cutter.Take(size.state_size)});
  }
  if (checkpoint.sections.size() != static_cast<std::size_t>(checkpoint.head.ranks)) {
    throw Error(fmt::format("it has the parts of {} ranks, {} wrote it", checkpoint.sections.size(), checkpoint.head.ranks));
  }
  return checkpoint;
}

void WriteCheckpoint(const fs::path& folder, const CheckpointHead& head, const std::vector<SavedBody>& bodies,
                     std::span<const std::byte> state, const RankGroup& ranks) {
  const std::string name = CheckpointName(head.step);
  const fs::path part = folder / PartOf(name);
  const std::vector<std::byte> section = MakeSection(bodies, state);
  const auto sections = static_cast<std::uint64_t>(ranks.Sum(static_cast<std::int64_t>(section.size())));
  std::unique_ptr<StagedFile> file;
  try {
    ranks.RunOnRoot([&] {
      const std::string text = FormatHead(head);
      Prologue prologue;
      prologue.head_size = text.size();
      prologue.file_size = sizeof(Prologue) + text.size() + sections + sizeof(Crc);
      file = std::make_unique<StagedFile>(part);
      file->Write(BytesOf(prologue));
      file->Write(text);
    });
    ranks.PassToRoot(section, [&](std::span<const std::byte> piece) { file->Write(piece); });
    ranks.RunOnRoot([&] {
      const Crc crc = file->crc();
      file->Write(BytesOf(crc));
      file->Close();
      SyncToDisk(part);
      fs::rename(part, folder / name);
      SyncToDisk(folder);
      RemoveOlder(folder);
    });
  } catch (const Error&) {
    std::error_code ignored;  // the first error counts
    if (ranks.is_root()) fs::remove(part, ignored);
    throw;
  }
}

}  // namespace nscdd

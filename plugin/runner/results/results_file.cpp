// SPDX-License-Identifier: Apache-2.0
#include "results/results_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <iterator>
#include <numeric>
#include <string>

#include "results/hdf5_file.h"
#include "results/result_tables.h"
#include "results/run_files.h"
#include "results/written_file.h"

namespace nscdd {
namespace {

/// Writes the columns that it is shown into `group`.
struct ColumnWriter {
  Hdf5File* file;
  const Hdf5Handle& group;
  const RowRange& rows;

  template <class T>
  void operator()(const char* name, const char* unit, const std::vector<T>& column) const {
    file->WriteColumn(group, name, unit, column, rows);
  }
  void operator()(const char* name, const char* unit, const std::vector<double>& x, const std::vector<double>& y) const {
    file->WriteVectors(group, name, unit, x, y, rows);
  }
};

/// Adds up the bytes of the columns that it is shown.
struct ColumnSize {
  std::int64_t* bytes;

  template <class T>
  void operator()(const char*, const char*, const std::vector<T>& column) const {
    *bytes += std::ssize(column) * static_cast<std::int64_t>(sizeof(T));
  }
  void operator()(const char*, const char*, const std::vector<double>& x, const std::vector<double>&) const {
    *bytes += 3 * std::ssize(x) * static_cast<std::int64_t>(sizeof(double));
  }
};

constexpr std::int64_t kOverhead = 128 << 10;  // [bytes] for HDF5 itself, at most, in a file with a step

/// What a saved state consists of, on this rank.
struct Tables {
  const GrainTable& grains;
  const ContactRows& contacts;
  LineTable chains;
  PlacedShapes shapes;

  std::int64_t Bytes() const {
    std::int64_t bytes = LineBytes(chains) + LineBytes(shapes.walls) +
                         (std::ssize(grains.id) + std::ssize(shapes.disks.id) + std::ssize(contacts.body_a)) *
                             static_cast<std::int64_t>(sizeof(std::int32_t));  // connectivity
    ForEachGrainColumn(grains, ColumnSize{&bytes});
    ForEachGrainColumn(shapes.disks, ColumnSize{&bytes});
    ForEachContactColumn(contacts, ColumnSize{&bytes});
    return bytes;
  }

  static std::int64_t LineBytes(const LineTable& lines) {
    std::int64_t bytes = 0;
    ColumnSize{&bytes}("", "", lines.x, lines.y);
    ColumnSize{&bytes}("", "", lines.ends);
    ColumnSize{&bytes}("", "", lines.body);
    return bytes;
  }
};

/// What ParaView is told of the steps in a file.
std::vector<XdmfStep> StepsIn(const std::filesystem::path& path) {
  const Hdf5File file = Hdf5File::Open(path);
  std::vector<XdmfStep> steps;
  for (const std::string& name : file.Names(file.OpenGroup("/steps"))) {
    const Hdf5Handle group = file.OpenGroup("/steps/" + name);
    XdmfStep step{"/steps/" + name, file.ReadAttribute<double>(group, "time")};
    step.has_disks = file.Has(group, "disks");
    step.grains = file.RowsOf(group, step.has_disks ? "disks/id" : "grains/id");
    step.contacts = file.RowsOf(group, "contacts/body_a");
    step.walls = file.RowsOf(group, "walls/body");
    step.wall_points = file.RowsOf(group, "walls/position") / 3;
    steps.push_back(step);
  }
  std::sort(steps.begin(), steps.end(), [](const XdmfStep& a, const XdmfStep& b) { return a.time < b.time; });
  return steps;
}

}  // namespace

class ResultsFile::Impl {
 public:
  Impl(ResultsFolder* folder, const RunDescription& run, const ShapeTable& shapes, Mode mode)
      : folder_(folder), run_(run), shapes_(shapes), mode_(mode) {
    const auto disks = std::count(shapes.kind.begin(), shapes.kind.end(), ShapeKind::kDisk);
    has_disks_ = ranks().Sum(disks) > 0;
  }

  void Begin() {
    ranks().RunTogether([&] {
      Open(0);
      const Hdf5Handle group = file_->CreateGroup("/shapes");
      const RowRange rows(ranks(), shapes_.size());
      ForEachShapeColumn(shapes_, ColumnWriter{file_.get(), group, rows});
      file_->Flush();
    });
  }

  void GoOn(const std::vector<FileExtent>& kept) {
    kept_ = kept;
    ranks().RunOnRoot([&] { RemoveSegmentsBut(folder_->path(), kept); });
  }

  void Save(const StepDescription& step, const GrainTable& grains, const ContactRows& contacts) {
    ranks().RunTogether([&] {
      if (!file_) Open(step.step);
    });
    Tables tables{grains, contacts, ChainsOf(contacts), PlaceShapes(grains, shapes_, step.mean_radius, ranks())};
    if (!has_disks_) tables.shapes.disks = {};
    const std::int64_t size = ranks().Sum(tables.Bytes()) + kOverhead;
    ranks().RunOnRoot([&] { CheckSpace(folder_->path() / name_, static_cast<std::uint64_t>(size)); });
    ranks().RunTogether([&] {
      WriteStep(step, tables);
      file_->Flush();
    });
  }

  std::vector<FileExtent> Keep() {
    if (!file_) return kept_;
    ranks().RunTogether([&] { file_->Close(); });
    file_.reset();
    ranks().RunOnRoot([&] {
      SyncToDisk(folder_->path() / name_);
      kept_.push_back(ExtentOf(folder_->path(), name_));
    });
    return kept_;
  }

  void Close() {
    if (mode_ == Mode::kSegments) {
      Keep();
      ranks().RunOnRoot([&] { Join(); });
    } else {
      ranks().RunTogether([&] { file_->Close(); });
    }
    ranks().RunOnRoot([&] {
      StagedFile file(folder_->Stage("results.xdmf"));
      file.Write(FormatXdmf(StepsIn(folder_->Stage("results.h5"))));
      file.Close();
    });
  }

 private:
  const RankGroup& ranks() const { return folder_->ranks(); }

  /// The file that begins with step `step`.
  void Open(std::int64_t step) {
    name_ = mode_ == Mode::kWhole ? folder_->Stage("results.h5").filename().string() : SegmentName(step);
    file_ = std::make_unique<Hdf5File>(Hdf5File::Create(folder_->path() / name_, ranks()));
    WriteRun(file_.get());
  }

  void WriteStep(const StepDescription& step, const Tables& tables) {
    const std::string name = fmt::format("/steps/{:06}", step.step);
    const Hdf5Handle group = file_->CreateGroup(name);
    file_->WriteAttribute(group, "step", step.step);
    file_->WriteAttribute(group, "time", step.time);
    file_->WriteAttribute(group, "mean_radius", step.mean_radius);
    WritePoints(name + "/grains", tables.grains.size(),
                [&](const ColumnWriter& write) { ForEachGrainColumn(tables.grains, write); });
    if (has_disks_) {
      WritePoints(name + "/disks", tables.shapes.disks.size(),
                  [&](const ColumnWriter& write) { ForEachGrainColumn(tables.shapes.disks, write); });
    }
    WritePoints(name + "/contacts", tables.contacts.size(),
                [&](const ColumnWriter& write) { ForEachContactColumn(tables.contacts, write); });
    WriteLines(name + "/chains", tables.chains);
    const LineTable& walls = tables.shapes.walls;
    const Hdf5Handle wall_group = WriteLines(name + "/walls", walls);
    file_->WriteColumn(wall_group, "body", "", walls.body, RowRange(ranks(), walls.size()));
  }

  template <class WriteColumns>
  void WritePoints(const std::string& name, std::size_t count, const WriteColumns& write_columns) {
    const Hdf5Handle group = file_->CreateGroup(name);
    const RowRange rows(ranks(), count);
    write_columns(ColumnWriter{file_.get(), group, rows});
    std::vector<std::int32_t> connectivity(count);
    std::iota(connectivity.begin(), connectivity.end(), static_cast<std::int32_t>(rows.first));
    file_->WriteRows(group, "connectivity", connectivity, rows, 1);
  }

  Hdf5Handle WriteLines(const std::string& name, const LineTable& lines) {
    Hdf5Handle group = file_->CreateGroup(name);
    const RowRange points(ranks(), lines.x.size());
    file_->WriteVectors(group, "position", "m", lines.x, lines.y, points);
    std::vector<std::int32_t> connectivity = lines.ends;
    for (std::int32_t& point : connectivity) point += static_cast<std::int32_t>(points.first);
    file_->WriteRows(group, "connectivity", connectivity, RowRange(ranks(), lines.size()), 2);
    return group;
  }

  void WriteRun(Hdf5File* file) const {
    const Hdf5Handle root = file->OpenGroup("/");
    file->WriteAttribute(root, "format", "nscdd results");
    file->WriteAttribute(root, "format_version", kResultsFormatVersion);
    ForEachRunAttribute(run_, [&](const char* name, const auto& value) { file->WriteAttribute(root, name, value); });
    file->CreateGroup("/steps");
  }

  /// results.h5 out of the segments, by one rank.
  void Join() const {
    Hdf5File whole = Hdf5File::Create(folder_->Stage("results.h5"), RankGroup());
    WriteRun(&whole);
    for (const FileExtent& part : kept_) {
      const Hdf5File segment = Hdf5File::Open(folder_->path() / part.name);
      if (&part == &kept_.front()) whole.Copy(segment, "/shapes");
      for (const std::string& step : segment.Names(segment.OpenGroup("/steps"))) whole.Copy(segment, "/steps/" + step);
    }
    whole.Close();
  }

  ResultsFolder* folder_;
  RunDescription run_;
  ShapeTable shapes_;       // as the scene gave them to the ranks
  bool has_disks_ = false;  // some body is more than one centred disk
  Mode mode_;
  std::string name_;                // of the file that is open
  std::unique_ptr<Hdf5File> file_;  // of segments: null between Keep() and Save()
  std::vector<FileExtent> kept_;    // rank 0
};

ResultsFile::ResultsFile(ResultsFolder* folder, const RunDescription& run, const ShapeTable& shapes, Mode mode)
    : impl_(std::make_unique<Impl>(folder, run, shapes, mode)) {
  const Hdf5Silence silence;
  impl_->Begin();
}

ResultsFile::ResultsFile(ResultsFolder* folder, const RunDescription& run, const ShapeTable& shapes,
                         const std::vector<FileExtent>& kept)
    : impl_(std::make_unique<Impl>(folder, run, shapes, Mode::kSegments)) {
  impl_->GoOn(kept);
}

ResultsFile::~ResultsFile() = default;

void ResultsFile::Save(const StepDescription& step, const GrainTable& grains, const ContactRows& contacts) {
  const Hdf5Silence silence;
  impl_->Save(step, grains, contacts);
}

std::vector<FileExtent> ResultsFile::Keep() {
  const Hdf5Silence silence;
  return impl_->Keep();
}

void ResultsFile::Close() {
  const Hdf5Silence silence;
  impl_->Close();
}

void CopyResultsFile(const std::filesystem::path& from, const std::filesystem::path& to, std::optional<std::int64_t> dropped) {
  const Hdf5Silence silence;
  StagedFile(to).Close();
  CheckSpace(to, std::filesystem::file_size(from));
  const Hdf5File whole = Hdf5File::Open(from);
  Hdf5File copy = Hdf5File::Create(to, RankGroup());
  const std::string steps = "steps", unwanted = dropped ? fmt::format("{:06}", *dropped) : "";
  for (const std::string& name : whole.Names(whole.OpenGroup("/"))) {
    if (name != steps) copy.Copy(whole, "/" + name);
  }
  copy.CreateGroup("/" + steps);
  for (const std::string& name : whole.Names(whole.OpenGroup("/" + steps))) {
    if (name != unwanted) copy.Copy(whole, "/" + steps + "/" + name);
  }
  copy.Close();
}

}  // namespace nscdd

// SPDX-License-Identifier: Apache-2.0
#include "results/results_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "results/hdf5_file.h"
#include "results/result_columns.h"
#include "results/run_files.h"
#include "results/staged_file.h"
#include "results/xdmf.h"

namespace nscdd {
namespace {

/// Writes the columns that it is shown into `group`.
auto Writer(Hdf5File* file, const Hdf5Handle& group, const RowRange& rows) {
  return [file, &group, &rows](const char* name, const char* unit, const auto& column) {
    file->WriteColumn(group, name, unit, column, rows);
  };
}

constexpr std::int64_t kOverhead = 128 << 10;  // [bytes] for HDF5 itself, at most, in a file with a step

std::int64_t SizeOf(const GrainTable& table) {
  std::int64_t size = 0;
  ForEachGrainColumn(table,
                     [&](const char*, const char*, const auto& column) { size += std::ssize(column) * sizeof(column[0]); });
  return size;
}

std::int64_t SizeOf(const ContactRows& table) {
  std::int64_t size = 0;
  ForEachContactColumn(table,
                       [&](const char*, const char*, const auto& column) { size += std::ssize(column) * sizeof(column[0]); });
  return size;
}

/// What ParaView is told of the steps in a file.
std::vector<XdmfStep> StepsIn(const std::filesystem::path& path) {
  const Hdf5File file = Hdf5File::Open(path);
  std::vector<XdmfStep> steps;
  for (const std::string& name : file.Names(file.OpenGroup("/steps"))) {
    const Hdf5Handle group = file.OpenGroup("/steps/" + name);
    steps.push_back({"/steps/" + name, file.ReadReal(group, "time"), file.RowsOf(group, "grains/id"),
                     file.RowsOf(group, "contacts/body_a")});
  }
  std::sort(steps.begin(), steps.end(), [](const XdmfStep& a, const XdmfStep& b) { return a.time < b.time; });
  return steps;
}

}  // namespace

class ResultsFile::Impl {
 public:
  Impl(ResultsFolder* folder, const RunDescription& run, Mode mode) : folder_(folder), run_(run), mode_(mode) {}

  void Begin(const ShapeTable& shapes) {
    ranks().RunTogether([&] {
      Open(0);
      const Hdf5Handle group = file_->CreateGroup("/shapes");
      const RowRange rows(ranks(), shapes.size());
      ForEachShapeColumn(shapes, Writer(file_.get(), group, rows));
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
    const std::int64_t size = ranks().Sum(SizeOf(grains) + SizeOf(contacts)) + kOverhead;
    ranks().RunOnRoot([&] { CheckSpace(folder_->path() / name_, static_cast<std::uint64_t>(size)); });
    ranks().RunTogether([&] {
      const std::string name = fmt::format("/steps/{:06}", step.step);
      const Hdf5Handle group = file_->CreateGroup(name);
      file_->WriteAttribute(group, "step", step.step);
      file_->WriteAttribute(group, "time", step.time);
      file_->WriteAttribute(group, "mean_radius", step.mean_radius);
      const RowRange grain_rows(ranks(), grains.size());
      const Hdf5Handle grain_group = file_->CreateGroup(name + "/grains");
      ForEachGrainColumn(grains, Writer(file_.get(), grain_group, grain_rows));
      const RowRange contact_rows(ranks(), contacts.size());
      const Hdf5Handle contact_group = file_->CreateGroup(name + "/contacts");
      ForEachContactColumn(contacts, Writer(file_.get(), contact_group, contact_rows));
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

  void WriteRun(Hdf5File* file) const {
    const Hdf5Handle root = file->OpenGroup("/");
    file->WriteAttribute(root, "format", "nscdd results");
    file->WriteAttribute(root, "format_version", std::int64_t{1});
    file->WriteAttribute(root, "scene", run_.scene);
    file->WriteAttribute(root, "solver", run_.solver);
    file->WriteAttribute(root, "version", run_.version);
    file->WriteAttribute(root, "subdomains_x", run_.subdomains_x);
    file->WriteAttribute(root, "subdomains_y", run_.subdomains_y);
    file->WriteAttribute(root, "period", run_.period);
    file->WriteAttribute(root, "period_origin", run_.period_origin);
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
  Mode mode_;
  std::string name_;                // of the file that is open
  std::unique_ptr<Hdf5File> file_;  // of segments: null between Keep() and Save()
  std::vector<FileExtent> kept_;    // rank 0
};

ResultsFile::ResultsFile(ResultsFolder* folder, const RunDescription& run, const ShapeTable& shapes, Mode mode)
    : impl_(std::make_unique<Impl>(folder, run, mode)) {
  const Hdf5Silence silence;
  impl_->Begin(shapes);
}

ResultsFile::ResultsFile(ResultsFolder* folder, const RunDescription& run, const std::vector<FileExtent>& kept)
    : impl_(std::make_unique<Impl>(folder, run, Mode::kSegments)) {
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

}  // namespace nscdd

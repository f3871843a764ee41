#include "results/results_file.h"

#include <fmt/format.h>

#include "results/hdf5_file.h"
#include "results/result_columns.h"
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

}  // namespace

class ResultsFile::Impl {
 public:
  Impl(ResultsFolder* folder, const RunDescription& run, const ShapeTable& shapes) : folder_(folder) {
    const Hdf5Silence silence;
    ranks().RunTogether([&] {
      file_ = std::make_unique<Hdf5File>(Hdf5File::Create(folder->Stage("results.h5"), ranks()));
      WriteRun(run);
      const Hdf5Handle group = file_->CreateGroup("/shapes");
      const RowRange rows(ranks(), shapes.size());
      ForEachShapeColumn(shapes, Writer(file_.get(), group, rows));
      file_->CreateGroup("/steps");
      file_->Flush();
    });
  }

  void Save(const StepDescription& step, const GrainTable& grains, const ContactRows& contacts) {
    const Hdf5Silence silence;
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
      steps_.push_back({name, step.time, grain_rows.total, contact_rows.total});
    });
  }

  void Close() {
    const Hdf5Silence silence;
    ranks().RunTogether([&] { file_->Close(); });
    ranks().RunOnRoot([&] {
      StagedFile file(folder_->Stage("results.xdmf"));
      file.Write(FormatXdmf(steps_));
      file.Close();
    });
  }

 private:
  const RankGroup& ranks() const { return folder_->ranks(); }

  void WriteRun(const RunDescription& run) {
    const Hdf5Handle root = file_->OpenGroup("/");
    file_->WriteAttribute(root, "format", "nscdd results");
    file_->WriteAttribute(root, "format_version", std::int64_t{1});
    file_->WriteAttribute(root, "scene", run.scene);
    file_->WriteAttribute(root, "solver", run.solver);
    file_->WriteAttribute(root, "version", run.version);
    file_->WriteAttribute(root, "subdomains_x", run.subdomains_x);
    file_->WriteAttribute(root, "subdomains_y", run.subdomains_y);
    file_->WriteAttribute(root, "period", run.period);
    file_->WriteAttribute(root, "period_origin", run.period_origin);
  }

  ResultsFolder* folder_;
  std::unique_ptr<Hdf5File> file_;
  std::vector<XdmfStep> steps_;
};

ResultsFile::ResultsFile(ResultsFolder* folder, const RunDescription& run, const ShapeTable& shapes)
    : impl_(std::make_unique<Impl>(folder, run, shapes)) {}

ResultsFile::~ResultsFile() = default;

void ResultsFile::Save(const StepDescription& step, const GrainTable& grains, const ContactRows& contacts) {
  impl_->Save(step, grains, contacts);
}

void ResultsFile::Close() { impl_->Close(); }

}  // namespace nscdd

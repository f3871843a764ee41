// SPDX-License-Identifier: Apache-2.0
#include "results/results_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "nscdd/error.h"
#include "results/hdf5_file.h"
#include "results/result_tables.h"

namespace nscdd {
namespace {

std::filesystem::path FileIn(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "results.h5";
  if (!std::filesystem::exists(file)) {
    throw Error(fmt::format("there is no {}: give the folder that a finished 'nscdd run' wrote.", file.string()));
  }
  return file;
}

std::int64_t StepNumber(const std::string& name) {
  std::int64_t number = 0;
  std::from_chars(name.data(), name.data() + name.size(), number);
  return number;
}

GrainTable SortedById(const GrainTable& grains) {
  const std::vector<std::size_t> order = AscendingOrder(grains.id);
  GrainTable sorted = grains;
  const auto sort = [&](auto& column) {
    const auto unsorted = column;
    for (std::size_t i = 0; i < order.size(); ++i) column[i] = unsorted[order[i]];
  };
  ForEachGrainColumn(sorted, [&](const char*, const char*, auto&... columns) { (sort(columns), ...); });
  return sorted;
}

}  // namespace

class ResultsReader::Impl {
 public:
  explicit Impl(const std::filesystem::path& file) : path_(file), file_(Hdf5File::Open(file)) { CheckFormat(); }

  const Hdf5File& file() const { return file_; }

  Hdf5Handle StepGroup(std::int64_t step, const std::vector<std::int64_t>& steps, const char* table) const {
    if (!std::binary_search(steps.begin(), steps.end(), step)) {
      throw Error(fmt::format("step {} is not in {}; it has the steps {} (more with --save-every when running).", step,
                              path_.string(), fmt::join(steps, ", ")));
    }
    return file_.OpenGroup(fmt::format("/steps/{:06}{}", step, table));
  }

  /// Reads the columns that it is shown from `group`, and checks that they are equally long.
  auto Reader(const Hdf5Handle& group) const {
    return [this, &group, rows = std::size_t{0}, first = true](const char* name, const char*, auto&... columns) mutable {
      if constexpr (sizeof...(columns) == 2) {
        file_.ReadVectors(group, name, &columns...);
      } else {
        file_.ReadColumn(group, name, &columns...);
      }
      const std::size_t length = std::max({columns.size()...});
      if (!first && length != rows) {
        throw Error(fmt::format("{} is damaged: the column {} has {} rows, the others {}; run the scene again.", path_.string(),
                                name, length, rows));
      }
      rows = length;
      first = false;
    };
  }

 private:
  void CheckFormat() const {
    const Hdf5Handle root = file_.OpenGroup("/");
    const bool is_ours =
        H5Aexists(root.id(), "format") > 0 && file_.ReadAttribute<std::string>(root, "format") == "nscdd results";
    if (!is_ours) throw Error(fmt::format("{} was not written by nscdd: give another folder.", path_.string()));
    const std::int64_t version = file_.ReadAttribute<std::int64_t>(root, "format_version");
    if (version != kResultsFormatVersion) {
      throw Error(
          fmt::format("{} has format version {}, this program reads {}: run the scene again, or use nscdd {}, which "
                      "wrote it.",
                      path_.string(), version, kResultsFormatVersion, file_.ReadAttribute<std::string>(root, "version")));
    }
  }

  std::filesystem::path path_;
  Hdf5File file_;
};

ResultsReader::ResultsReader(const std::filesystem::path& folder) {
  const Hdf5Silence silence;
  impl_ = std::make_unique<Impl>(FileIn(folder));
  const Hdf5File& file = impl_->file();
  const Hdf5Handle root = file.OpenGroup("/");
  ForEachRunAttribute(run_, [&](const char* name, auto& value) { file.ReadAttribute(root, name, &value); });
  for (const std::string& name : file.Names(file.OpenGroup("/steps"))) steps_.push_back(StepNumber(name));
  std::sort(steps_.begin(), steps_.end());
}

ResultsReader::~ResultsReader() = default;

ShapeTable ResultsReader::ReadShapes() const {
  const Hdf5Silence silence;
  ShapeTable shapes;
  const Hdf5Handle group = impl_->file().OpenGroup("/shapes");
  ForEachShapeColumn(shapes, impl_->Reader(group));
  return shapes;
}

StepDescription ResultsReader::ReadStep(std::int64_t step) const {
  const Hdf5Silence silence;
  const Hdf5Handle group = impl_->StepGroup(step, steps_, "");
  return {step, impl_->file().ReadAttribute<double>(group, "time"), impl_->file().ReadAttribute<double>(group, "mean_radius")};
}

GrainTable ResultsReader::ReadGrains(std::int64_t step) const {
  const Hdf5Silence silence;
  GrainTable grains;
  const Hdf5Handle group = impl_->StepGroup(step, steps_, "/grains");
  ForEachGrainColumn(grains, impl_->Reader(group));
  return SortedById(grains);
}

ContactRows ResultsReader::ReadContacts(std::int64_t step) const {
  const Hdf5Silence silence;
  ContactRows contacts;
  const Hdf5Handle group = impl_->StepGroup(step, steps_, "/contacts");
  ForEachContactColumn(contacts, impl_->Reader(group));
  return contacts;
}

}  // namespace nscdd

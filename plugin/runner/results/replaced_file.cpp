// SPDX-License-Identifier: Apache-2.0
#include "results/replaced_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "nscdd/error.h"
#include "results/run_files.h"

namespace nscdd {
namespace {

namespace fs = std::filesystem;

/// The file itself where `file` is a link.
fs::path Resolve(fs::path file) {
  std::error_code none;
  return fs::is_symlink(file, none) ? fs::weakly_canonical(file, none) : std::move(file);
}

[[noreturn]] void Refuse(const fs::path& file, int system_error) {
  throw Error(fmt::format("{}: the file cannot be written ({}); check the path, its permissions and the free space",
                          file.string(), std::generic_category().message(system_error)));
}

}  // namespace

ReplacedFile::ReplacedFile(fs::path file) : file_(Resolve(std::move(file))) {
  std::error_code none;
  const bool special = fs::exists(file_, none) && !fs::is_regular_file(file_, none);
  part_ = special ? file_ : fs::path(PartOf(file_.string()));
}

ReplacedFile::~ReplacedFile() {
  std::error_code ignored;
  if (!committed_ && part_ != file_) fs::remove(part_, ignored);
}

void ReplacedFile::Commit() {
  std::error_code error;
  if (part_ != file_) fs::rename(part_, file_, error);
  if (error) Refuse(file_, error.value());
  committed_ = true;
}

void ReplaceText(const fs::path& file, std::string_view text) {
  ReplacedFile replaced(file);
  std::ofstream out(replaced.part(), std::ios::binary);
  out << text;
  out.close();
  if (!out) Refuse(file, errno);
  replaced.Commit();
}

}  // namespace nscdd

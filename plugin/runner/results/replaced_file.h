// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace nscdd {

/// A single file that the user names: it is written beside its place and takes it when complete, so that who reads the file
/// that was there before goes on reading that one, and a failure leaves it as it was. What is no regular file (a pipe, a
/// terminal) is written as it is; a link stays one.
class ReplacedFile {
 public:
  explicit ReplacedFile(std::filesystem::path file);
  ~ReplacedFile();  ///< without Commit(): removes what was written
  ReplacedFile(const ReplacedFile&) = delete;
  ReplacedFile& operator=(const ReplacedFile&) = delete;

  /// Where to write.
  const std::filesystem::path& part() const { return part_; }
  /// After what was written is closed. Throws Error, naming the file, when the system refuses.
  void Commit();

 private:
  std::filesystem::path file_, part_;
  bool committed_ = false;
};

/// A whole file of text. Throws Error as above.
void ReplaceText(const std::filesystem::path& file, std::string_view text);

}  // namespace nscdd

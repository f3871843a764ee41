// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>

#include <unistd.h>

#include "nscdd/error.h"

/// One input; defined by each target. libFuzzer calls it, and so does replay.cpp.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace nscdd::fuzz {

[[noreturn]] inline void Fail(const std::string& what) {
  std::fprintf(stderr, "\n%s\n", what.c_str());
  std::abort();
}

/// A sentence that a user can read: there, and not the whole input.
inline void CheckSentence(std::string_view sentence) {
  if (sentence.empty()) Fail("refused without a sentence");
  if (sentence.size() > 2000) Fail("refused with a sentence of " + std::to_string(sentence.size()) + " characters");
}

/// True if `work` ended; false if it refused its input with a sentence. Any other exception is a fault and passes.
inline bool Accepts(const std::function<void()>& work) {
  try {
    work();
    return true;
  } catch (const Error& e) {
    CheckSentence(e.what());
    return false;
  }
}

/// A folder of this process, in memory where the system has such a place.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::error_code error;
    const std::filesystem::path memory = "/dev/shm";
    folder_ = (std::filesystem::is_directory(memory, error) ? memory : std::filesystem::temp_directory_path()) /
              ("nscdd_fuzz_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~ScratchFolder() {
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path Write(const char* name, const void* data, std::size_t size) const {
    const std::filesystem::path path = folder_ / name;
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr || std::fwrite(data, 1, size, file) != size || std::fclose(file) != 0)
      Fail("cannot write " + path.string());
    return path;
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace nscdd::fuzz

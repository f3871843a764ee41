// SPDX-License-Identifier: Apache-2.0
#include "validator/elf_symbols.h"

#include <elf.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

#include "nscdd/error.h"

namespace nscdd {
namespace {

// A file in memory whose structures are copied out with their bounds checked: it may be anything.
class ElfFile {
 public:
  explicit ElfFile(std::string path) : path_(std::move(path)) {
    std::ifstream file(path_, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
  }

  template <class T>
  T Read(std::uint64_t offset) const {
    if (offset > bytes_.size() || bytes_.size() - offset < sizeof(T)) Refuse();
    T value;
    std::memcpy(&value, bytes_.data() + offset, sizeof(T));
    return value;
  }

  std::string Text(std::uint64_t offset) const {
    if (offset >= bytes_.size()) Refuse();
    return {bytes_.data() + offset, strnlen(bytes_.data() + offset, bytes_.size() - offset)};
  }

  [[noreturn]] void Refuse() const {
    throw Error(fmt::format("'{}' is no complete 64-bit ELF shared library; rebuild it", path_));
  }

 private:
  std::string path_;
  std::vector<char> bytes_;
};

bool IsExported(const Elf64_Sym& symbol) {
  const unsigned char binding = ELF64_ST_BIND(symbol.st_info), visibility = ELF64_ST_VISIBILITY(symbol.st_other);
  return symbol.st_shndx != SHN_UNDEF && binding != STB_LOCAL && (visibility == STV_DEFAULT || visibility == STV_PROTECTED);
}

}  // namespace

std::vector<std::string> ExportedSymbols(const std::string& path) {
  const ElfFile file(path);
  const auto header = file.Read<Elf64_Ehdr>(0);
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 || header.e_ident[EI_CLASS] != ELFCLASS64) file.Refuse();
  std::vector<std::string> names;
  for (unsigned i = 0; i < header.e_shnum; ++i) {
    const auto section = file.Read<Elf64_Shdr>(header.e_shoff + i * sizeof(Elf64_Shdr));
    if (section.sh_type != SHT_DYNSYM) continue;
    const auto strings = file.Read<Elf64_Shdr>(header.e_shoff + section.sh_link * sizeof(Elf64_Shdr));
    for (std::uint64_t s = 0; s < section.sh_size / sizeof(Elf64_Sym); ++s) {
      const auto symbol = file.Read<Elf64_Sym>(section.sh_offset + s * sizeof(Elf64_Sym));
      if (IsExported(symbol)) names.push_back(file.Text(strings.sh_offset + symbol.st_name));
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace nscdd

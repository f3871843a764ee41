// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <string>
#include <string_view>

#include "scene/table_reader.h"

namespace nscdd {

/// Line (from 1) of the first dotted key of a TOML text with more than `most` parts; 0 if there is none. A parser makes nested
/// tables of it, and recursion through them may exhaust the stack. Texts need not be valid.
int FirstLineOfDeepKey(std::string_view text, int most);

/// Throws Error "FILE:LINE: ..." if there is no such file, it is too large, no UTF-8 text or no TOML.
toml::table ParseTomlFile(const std::filesystem::path& path);
/// The two halves of it: the text, and the table of a text that stands, or once stood, at `path`.
std::string ReadTomlText(const std::filesystem::path& path);
toml::table ParseToml(const std::string& text, const std::filesystem::path& path);

/// Any value of a solver's option as the text that its option table reads: numbers in the shortest form that reads back the
/// same, pairs of integers as "2x3".
std::string OptionText(const TableReader& table, std::string_view key, const toml::node& node);

}  // namespace nscdd

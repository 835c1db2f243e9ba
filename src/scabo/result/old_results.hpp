// Results of an earlier run in the directory of a new one: which files are results, and their removal.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scabo/analysis/state/written_results.hpp"
#include "scabo/result/files.hpp"

namespace scabo::result {

inline constexpr const char* problems_name = "problems";
inline constexpr const char* cells_name = "cells.vtu";
inline constexpr const char* mechanism_name = "mechanism.vtu";

/// `fields_0001.vtu`, `contact_0001.vtu` and the like; also `fields_0001.pvtu` and its parts, `fields_0001_0.vtu` ...;
/// and what a kill left of one that was not yet complete, `fields_0001.vtu.part`.
bool is_vtu_name(const std::string& name, std::string_view begin);

/// Bytes of a file that count.
long long size_in(const analysis::WrittenResults& written, const std::string& name);

/// Removes files of fields that were written after a checkpoint, whose last ones have the number `last`.
void remove_later_fields(const std::filesystem::path& path, int last);

/// Creates the directory, or removes the results of an earlier run from it. Only files written by Scabo are removed; a
/// file of another origin in the place of a result is an error, and so is another run that writes there. The directory
/// is locked for the caller as long as the lock exists. `summary`, where it is given, takes the place of an earlier
/// summary.json before anything is removed: there is one at every moment. Throws WriteError.
[[nodiscard]] DirectoryLock prepare_directory(const std::filesystem::path& path, std::string_view summary = "");

}  // namespace scabo::result

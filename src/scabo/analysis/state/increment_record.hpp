// Results of increments as bytes, for the file beside a checkpoint that grows with every increment (checkpoint.hpp).
// Not kept: fields, which only the last increment has and which follow from its state, the pairs of contacts, which
// follow too, and estimated errors, which are known only when all increments are. Of this machine: numbers as they are
// in memory.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "scabo/analysis/state/solution.hpp"

namespace scabo::analysis {

std::string record_of(const IncrementResult& increment);
/// Throws std::out_of_range for bytes that are no record.
IncrementResult increment_of(std::string_view record);

/// 64-bit FNV-1a, to recognise accidental changes.
constexpr std::uint64_t digest_start = 0xcbf29ce484222325ull;
std::uint64_t digest(std::string_view bytes, std::uint64_t before = digest_start);

}  // namespace scabo::analysis

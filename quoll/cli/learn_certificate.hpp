#pragma once
// What is told of a certificate from experience: its bounds, what they take for granted, and what
// still blocks it.

#include <string>

#include "quoll/base/json.hpp"
#include "quoll/cli/verb.hpp"
#include "quoll/experiment/run.hpp"

namespace quoll::cli {

/// Lines for people about the first seed's certificate; empty where none was asked for.
std::string experience_text(const Run& run, const RunResult& result);

/// The object "certificate" of `learn --json`: of experience where that was asked for, else of the
/// model, null where neither says anything.
void write_learned_certificate(JsonWriter& json, const Run& run, const RunResult& result);

/// Error: no certificate from experience was asked for, or the world has no names for a file.
Result<void> may_write_experience(const Run& run);

/// Writes the first seed's bounds as a file that `verify` takes. Error: none was found yet, or the
/// file cannot be written.
Result<void> write_experience(const std::string& file, const Run& run, const RunResult& result);

}  // namespace quoll::cli

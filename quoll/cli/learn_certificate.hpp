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

/// Writes the first seed's bounds as a file that `verify` takes. Error: none was asked for, or none
/// was found yet; a world without a model has no names and no place in such a file.
Result<void> write_experience(const std::string& file, const Run& run, const RunResult& result);

}  // namespace quoll::cli

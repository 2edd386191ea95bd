// quoll convert WORLD FILE: a world in another format.

#include <cstdio>

#include "quoll/cli/common.hpp"
#include "quoll/cli/explored.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/losses.hpp"

namespace quoll::cli {
namespace {

struct ConvertOptions {
  WorldOption world;
  ExploreOption explore;
  std::string file;
};

/// What the written files no longer say, found by reading them.
Result<std::string> lost(const Mdp& mdp, const std::string& file) {
  const Result<Mdp> again = read_model(file);
  if (!again) return again.error();
  std::string text;
  for (const std::string& phrase : losses(mdp, *again)) text += (text.empty() ? "" : "; ") + phrase;
  return text;
}

Exit convert(const ConvertOptions& options) {
  const Result<World> world = options.explore.open(options.world);
  if (!world) return fail(world.error());
  const Result<std::vector<WrittenFile>> files = write_model(*world->mdp, options.file);
  if (!files) return fail(files.error());
  std::string names;
  for (const WrittenFile& file : *files) {
    const Result<void> written = write_output(file.path, file.content, {options.world.name});
    if (!written) return fail(written.error());
    names += " " + file.path;
  }
  const Result<std::string> missing = lost(*world->mdp, options.file);
  if (!missing) return fail(missing.error());
  if (!missing->empty()) {
    std::fputs(("quoll: " + options.file + " does not hold " + *missing + "\n").c_str(), stderr);
  }
  return print("wrote" + names + "\n") ? done : user_error;
}

}  // namespace

void declare_convert(Options& options) {
  auto given = std::make_shared<ConvertOptions>();
  given->world.declare(options);
  given->explore.declare(options);
  options.word("file", given->file,
               "the file to write; its ending says the format (see 'quoll list formats')");
  options.run([given] { return convert(*given); });
}

}  // namespace quoll::cli

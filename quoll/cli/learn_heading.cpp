#include "quoll/cli/learn_heading.hpp"

#include <fmt/format.h>

#include "quoll/base/text.hpp"
#include "quoll/cli/network_words.hpp"
#include "quoll/nn/arithmetic.hpp"
#include "quoll/report/table.hpp"

namespace quoll::cli {

std::string learn_heading(const Run& run) {
  const LearnSettings& learn = run.settings().learn;
  const Result<LearnSetup> setup = resolve(learn, run.world());
  std::string text =
      fmt::format("learn {}   {}{}, discount {}", run.world().name, learn.method,
                  run.entry().rule.empty() ? "" : ", rule " + learn.rule, shortest(run.discount()));
  if (setup) {
    if (!run.entry().traits.approximates) text += ", step size " + setup->step_size.text();
    text += fmt::format(", actions {}, starts {}, episodes of at most {} steps",
                        run.entry().traits.directed ? "by hope" : setup->exploration.name(),
                        learn.start, setup->episode_steps);
  }
  if (run.settings().seeds > 1) {
    text += fmt::format(", seeds {} to {}", learn.seed, learn.seed + run.settings().seeds - 1);
  } else {
    text += fmt::format(", seed {}", learn.seed);
  }
  if (run.entry().traits.networks) {
    text += fmt::format(", {} arithmetic", nn::arithmetic().fused ? "fused" : "plain");
  }
  if (const auto network = run.trainings().front().learner().network()) {
    text += "\n" + network_words(*network);
    const double scale = network->value_scale;
    if (scale != 1.0) text += fmt::format(", rewards times {}", number_text(scale));
  }
  return text + "\n";
}

std::string unchanged_line(const Run& run) {
  std::uint64_t updates = 0;
  for (const Training& training : run.trainings()) {
    for (const Measure& measure : training.learner().measures()) updates += measure.count;
  }
  if (!run.entry().traits.networks || updates > 0) return "";
  return "No update was made in these steps: the network is as it began.\n";
}

}  // namespace quoll::cli

#include "quoll/cli/seeds_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quoll/base/text.hpp"

namespace quoll::cli {
namespace {

constexpr std::size_t few_seeds = 8;  // that colours tell apart

// The mean return in each bin of `width` steps; nan before the first episode ended.
std::vector<double> means_of(const LearningCurve& curve, std::uint64_t width) {
  const std::uint64_t joined = width / curve.width();
  std::vector<double> means;
  double last = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t first = 0; first + joined <= curve.bins().size(); first += joined) {
    LearningCurve::Bin sum;
    for (std::size_t i = first; i < first + joined; ++i) {
      sum.episodes += curve.bins()[i].episodes;
      sum.return_sum += curve.bins()[i].return_sum;
    }
    if (sum.episodes > 0) last = sum.mean();
    means.push_back(last);
  }
  return means;
}

}  // namespace

Curve curve_of(const Training& training) {
  Curve curve;
  curve.name = "seed " + std::to_string(training.seed());
  const LearningCurve& bins = training.curve();
  std::uint64_t step = 0;
  for (const LearningCurve::Bin& bin : bins.bins()) {
    step += bins.width();
    if (bin.episodes > 0) curve.points.push_back({static_cast<double>(step), bin.mean()});
  }
  if (const LearningCurve::Bin open = bins.open(); open.episodes > 0) {
    curve.points.push_back({static_cast<double>(training.learner().progress().steps), open.mean()});
  }
  return curve;
}

Curve curve_over_seeds(const Run& run) {
  Curve curve;
  curve.name = "mean of " + counted(run.trainings().size(), "seed");
  std::uint64_t width = 0;
  for (const Training& one : run.trainings()) width = std::max(width, one.curve().width());
  std::vector<std::vector<double>> seeds;
  std::size_t bins = std::numeric_limits<std::size_t>::max();
  for (const Training& one : run.trainings()) {
    seeds.push_back(means_of(one.curve(), width));
    bins = std::min(bins, seeds.back().size());
  }
  std::vector<double> values(seeds.size());
  for (std::size_t bin = 0; bin < bins; ++bin) {
    for (std::size_t i = 0; i < seeds.size(); ++i) values[i] = seeds[i][bin];
    if (std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); })) continue;
    const Statistics s = statistics(values);
    CurvePoint point{static_cast<double>((bin + 1) * width), s.mean};
    if (s.lower) point.lower = *s.lower;
    if (s.upper) point.upper = *s.upper;
    curve.points.push_back(point);
  }
  return curve;
}

std::vector<Curve> curves_of(const Run& run) {
  if (run.trainings().size() > few_seeds) return {curve_over_seeds(run)};
  std::vector<Curve> curves;
  for (const Training& training : run.trainings()) curves.push_back(curve_of(training));
  return curves;
}

}  // namespace quoll::cli

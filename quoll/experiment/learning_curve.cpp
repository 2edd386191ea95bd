#include "quoll/experiment/learning_curve.hpp"

namespace quoll {

bool LearningCurve::advance(std::uint64_t step, std::uint64_t episodes, double return_sum) {
  episodes_ = episodes;
  return_sum_ = return_sum;
  bool closed = false;
  while (step >= boundary()) {
    closed = step < boundary() + width_;
    push(closed ? open() : Bin());
    if (!closed) continue;
    closed_episodes_ = episodes_;
    closed_return_sum_ = return_sum_;
  }
  return closed;
}

void LearningCurve::push(const Bin& bin) {
  bins_.push_back(bin);
  if (bins_.size() < most_bins) return;
  for (std::size_t i = 0; i < most_bins / 2; ++i) {
    const Bin& left = bins_[2 * i];
    const Bin& right = bins_[2 * i + 1];
    bins_[i] = {left.episodes + right.episodes, left.return_sum + right.return_sum};
  }
  bins_.resize(most_bins / 2);
  width_ *= 2;
}

void LearningCurve::persist(Archive& archive) {
  archive("width", width_);
  archive("bins", bins_);
  archive("episodes", episodes_);
  archive("closed_episodes", closed_episodes_);
  archive("return_sum", return_sum_);
  archive("closed_return_sum", closed_return_sum_);
  if (width_ < first_width || bins_.size() >= most_bins) {
    *this = LearningCurve();
    archive.fail("a curve that cannot be");
  }
}

}  // namespace quoll

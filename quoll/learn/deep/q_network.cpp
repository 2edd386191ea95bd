#include "quoll/learn/deep/q_network.hpp"

#include <algorithm>
#include <optional>

#include "quoll/nn/noise.hpp"
#include "quoll/nn/pass.hpp"

namespace quoll {

nn::NetworkSpec network_spec(const DeepSetup& deep) {
  nn::NetworkSpec spec;
  spec.input = deep.input;
  const std::uint32_t actions = deep.actions;
  nn::LayerSpec out;
  out.activation = nn::Activation::none;
  out.units = deep.atoms;
  std::vector<nn::LayerSpec> chain = deep.hidden;
  if (deep.settings.layout == NetworkLayout::separate) {
    chain.push_back(out);
    spec.heads.assign(actions, chain);
    return spec;
  }
  if (deep.settings.layout == NetworkLayout::joint) {
    spec.input = {1, 1, static_cast<std::uint32_t>(deep.input.size() + actions)};
    spec.body = chain;
    spec.heads = {{out}};
    return spec;
  }
  if (!deep.settings.duelling) {
    out.units = actions * deep.atoms;
    spec.body = chain;
    spec.heads = {{out}};
    return spec;
  }
  std::vector<nn::LayerSpec> stream;
  if (!chain.empty() && !chain.back().convolution()) {
    stream.push_back(chain.back());
    chain.pop_back();
  }
  spec.body = chain;
  stream.push_back(out);
  spec.heads.push_back(stream);
  stream.back().units = actions * deep.atoms;
  spec.heads.push_back(stream);
  return spec;
}

namespace {

class QNetwork final : public QFunction {
 public:
  // `learned_rows` = most rows of predict(), none where it only answers.
  QNetwork(const DeepSetup& deep, std::shared_ptr<const nn::Network> network, std::size_t rows,
           std::size_t learned_rows, bool target)
      : deep_(deep),
        network_(std::move(network)),
        rows_(rows),
        layout_(deep.settings.layout),
        actions_(deep.actions),
        atoms_(deep.atoms),
        own_(deep.input.size()),
        online_(*network_, deep.settings.noisy, true),
        target_(*network_, deep.settings.noisy, target),
        gradients_(learned_rows > 0 ? online_.learned.size() : 0),
        optimiser_(deep.optimiser, gradients_.size()),
        traces_(deep.traces ? gradients_.size() : 0),
        pass_(*network_, layout_ == NetworkLayout::joint ? block() : rows, false),
        learning_(*network_, learned_rows, learned_rows > 0),
        chosen_(learned_rows) {
    if (layout_ != NetworkLayout::joint) return;
    wide_ = nn::Floats(block() * network_->inputs());
    wide_learning_ = nn::Floats(learned_rows * network_->inputs());
  }

  void initialise(std::uint64_t seed) {
    Rng rng = stream(seed, "weights");
    const std::span<float> all = online_.learned.span();
    network_->initialise(deep_.initial, rng, all.first(network_->parameters()));
    if (online_.noise) nn::initialise_sigma(*network_, all.subspan(network_->parameters()));
    draw_ = stream(seed, "noise");
    sync(1.0);
  }

  std::size_t inputs() const override { return own_; }
  std::size_t actions() const override { return actions_; }
  std::size_t atoms() const override { return atoms_; }

  void values(Weights which, const float* inputs, std::size_t rows, float* out) override {
    const float* const weights = side(which).weights();
    if (layout_ == NetworkLayout::joint) {
      const std::size_t width = network_->inputs(), pairs = rows * actions_;
      for (std::size_t begin = 0; begin < pairs; begin += block()) {
        const std::size_t count = std::min(block(), pairs - begin);
        for (std::size_t i = 0; i < count; ++i) {
          const std::size_t pair = begin + i;
          widen(inputs + pair / actions_ * own_, pair % actions_, wide_.data() + i * width);
        }
        pass_.forward(weights, wide_.data(), width, count);
        for (std::size_t i = 0; i < count; ++i, out += atoms_) read(pass_, i, 0, out);
      }
      return;
    }
    pass_.forward(weights, inputs, own_, rows);
    if (layout_ == NetworkLayout::shared && !deep_.settings.duelling) {
      // Side by side already.
      const float* from = pass_.output(0);
      const std::size_t row = pass_.output_row(0), width = actions_ * atoms_;
      for (std::size_t i = 0; i < rows; ++i, from += row, out += width) {
        for (std::size_t j = 0; j < width; ++j) out[j] = from[j];
      }
      return;
    }
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t a = 0; a < actions_; ++a, out += atoms_) read(pass_, i, a, out);
    }
  }

  void values(std::span<const std::uint32_t> ones, float* out) override {
    const bool joint = layout_ == NetworkLayout::joint;
    const float* const weights = online_.weights();
    ones_.assign(ones.begin(), ones.end());
    if (joint) ones_.push_back(0);
    for (std::size_t a = 0; a < actions_; ++a, out += atoms_) {
      if (joint) ones_.back() = static_cast<std::uint32_t>(own_ + a);
      if (joint || a == 0) pass_.forward(weights, ones_);
      read(pass_, 0, a, out);
    }
  }

  void predict(const float* inputs, std::size_t rows, const Action* actions, float* out) override {
    const float* from = inputs;
    std::size_t width = own_;
    if (layout_ == NetworkLayout::joint) {
      width = network_->inputs();
      for (std::size_t i = 0; i < rows; ++i) {
        widen(inputs + i * own_, actions[i], wide_learning_.data() + i * width);
      }
      from = wide_learning_.data();
    }
    learning_.forward(online_.weights(), from, width, rows);
    batch_ = rows;
    for (std::size_t i = 0; i < rows; ++i, out += atoms_) {
      chosen_[i] = actions[i];
      read(learning_, i, actions[i], out);
    }
  }

  double update(const float* slopes, double learning_rate) override {
    find_gradients(slopes);
    if (keeps_) add_up(gradients_, kept_);
    keeps_ = false;
    const double most = deep_.settings.clip_gradient;
    const double norm = most > 0.0 ? nn::clip_norm(gradients_.span(), most) : 0.0;
    optimiser_.step(online_.learned.span(), gradients_.span(), learning_rate);
    online_.composed = false;
    return norm;
  }

  void add(const float* slopes) override {
    find_gradients(slopes);
    if (kept_.size() == 0) kept_ = nn::Floats(gradients_.size());
    if (keeps_) {
      add_up(kept_, gradients_);
    } else {
      std::copy_n(gradients_.data(), kept_.size(), kept_.data());
    }
    keeps_ = true;
  }

  void forget_steps() override {
    optimiser_ = nn::Optimiser(deep_.optimiser, gradients_.size());
    keeps_ = false;
  }

  void follow_traces(const float* slopes, const nn::TraceStep& how) override {
    find_gradients(slopes);
    traces_.step(online_.learned.span(), gradients_.span(), how);
    online_.composed = false;
  }

  void clear_traces() override { traces_.clear(); }

  void redraw(Weights which) override {
    Side& of = side(which);
    if (!of.noise) return;
    of.noise->draw(draw_);
    of.composed = false;
  }

  void sync(double share) override {
    if (target_.learned.size() == 0) return;
    const nn::Floats& from = online_.learned;
    if (share >= 1.0) {
      std::copy_n(from.data(), from.size(), target_.learned.data());
    } else {
      nn::arithmetic().blend(target_.learned.data(), from.data(), from.size(),
                             static_cast<float>(share));
    }
    target_.composed = false;
  }

  std::unique_ptr<QFunction> snapshot() const override {
    DeepSetup calm = deep_;
    calm.settings.noisy = calm.traces = false;
    auto copy =
        std::make_unique<QNetwork>(calm, network_, std::min<std::size_t>(rows_, 128), 0, false);
    std::copy_n(online_.learned.data(), network_->parameters(), copy->online_.learned.data());
    return copy;
  }

  const nn::Network* network() const override { return network_.get(); }
  std::span<const float> weights() const override {
    return online_.learned.span().first(network_->parameters());
  }

  // The noise itself is no part of it: whoever looks at noisy weights draws before.
  void persist(Archive& archive) override {
    nn::persist_floats(archive, "online", online_.learned);
    nn::persist_floats(archive, "target", target_.learned);
    archive("optimiser", optimiser_);
    if (online_.noise) archive("noise", draw_);
    if (deep_.traces) archive("traces", traces_);
    online_.composed = target_.composed = false;
  }

 private:
  // The online or the target network: what is learned of it, and the weights of its passes.
  struct Side {
    nn::Floats learned;  // the weights, or with noise their means and spreads
    std::optional<nn::Noise> noise;
    nn::Floats drawn;
    bool composed = false;  // whether `drawn` is of what is learned now

    Side(const nn::Network& network, bool noisy, bool exists)
        : learned(exists ? network.parameters() * (noisy ? 2 : 1) : 0) {
      if (!exists || !noisy) return;
      noise.emplace(network);
      drawn = nn::Floats(network.parameters());
    }
    const float* weights() {
      if (!noise) return learned.data();
      if (!composed) noise->compose(learned.span(), drawn.span());
      composed = true;
      return drawn.data();
    }
  };
  Side& side(Weights which) { return which == Weights::online ? online_ : target_; }

  void find_gradients(const float* slopes) {
    for (std::size_t h = 0; h < network_->heads(); ++h) {
      std::fill_n(learning_.gradient(h), batch_ * learning_.output_row(h), 0.0F);
    }
    for (std::size_t i = 0; i < batch_; ++i) send(i, slopes + i * atoms_);
    learning_.backward(online_.weights(), gradients_.data());
    if (online_.noise) online_.noise->pass_on(gradients_.span());
  }

  static void add_up(nn::Floats& sum, const nn::Floats& one) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += one[i];
  }

  // Pairs of the joint layout that go through the network together.
  std::size_t block() const { return std::min<std::size_t>(rows_ * actions_, 4096); }

  // The input and which action it is about.
  void widen(const float* input, std::size_t action, float* out) const {
    std::copy_n(input, own_, out);
    std::fill_n(out + own_, actions_, 0.0F);
    out[own_ + action] = 1.0F;
  }

  // A row of the joint layout is of the action already.
  void read(const nn::Pass& pass, std::size_t row, std::size_t action, float* out) const {
    if (layout_ == NetworkLayout::joint) {
      std::copy_n(pass.output(0) + row * pass.output_row(0), atoms_, out);
    } else if (layout_ == NetworkLayout::separate) {
      std::copy_n(pass.output(action) + row * pass.output_row(action), atoms_, out);
    } else if (!deep_.settings.duelling) {
      std::copy_n(pass.output(0) + row * pass.output_row(0) + action * atoms_, atoms_, out);
    } else {
      const float* const value = pass.output(0) + row * pass.output_row(0);
      const float* const advantage = pass.output(1) + row * pass.output_row(1);
      for (std::size_t k = 0; k < atoms_; ++k) {
        float mean = 0.0F;
        for (std::size_t a = 0; a < actions_; ++a) mean += advantage[a * atoms_ + k];
        out[k] = value[k] + advantage[action * atoms_ + k] - mean / static_cast<float>(actions_);
      }
    }
  }

  // The slope of one row back to the outputs it was read from.
  void send(std::size_t row, const float* slope) {
    const std::size_t action = chosen_[row];
    if (layout_ == NetworkLayout::separate) {
      std::copy_n(slope, atoms_, learning_.gradient(action) + row * learning_.output_row(action));
      return;
    }
    float* const first = learning_.gradient(0) + row * learning_.output_row(0);
    if (layout_ == NetworkLayout::joint || deep_.settings.duelling) {
      std::copy_n(slope, atoms_, first);
    } else {
      std::copy_n(slope, atoms_, first + action * atoms_);
    }
    if (layout_ != NetworkLayout::shared || !deep_.settings.duelling) return;
    float* const advantage = learning_.gradient(1) + row * learning_.output_row(1);
    for (std::size_t a = 0; a < actions_; ++a) {
      const float share = (a == action ? 1.0F : 0.0F) - 1.0F / static_cast<float>(actions_);
      for (std::size_t k = 0; k < atoms_; ++k) advantage[a * atoms_ + k] = share * slope[k];
    }
  }

  DeepSetup deep_;
  std::shared_ptr<const nn::Network> network_;
  std::size_t rows_;
  NetworkLayout layout_;
  std::size_t actions_, atoms_, own_;
  Side online_, target_;
  nn::Floats gradients_;
  nn::Floats kept_;  // the sum of those of the parts of a batch, if keeps_
  bool keeps_ = false;
  Rng draw_;  // of noise
  nn::Optimiser optimiser_;
  nn::Traces traces_;
  nn::Pass pass_, learning_;
  nn::Floats wide_, wide_learning_;  // joint: inputs with their actions
  std::vector<std::uint32_t> ones_;
  std::vector<Action> chosen_;
  std::size_t batch_ = 0;
};

}  // namespace

Result<std::unique_ptr<QFunction>> make_q_network(const DeepSetup& deep, std::uint64_t seed,
                                                  std::size_t rows, bool target) {
  Result<nn::Network> network = nn::Network::make(network_spec(deep));
  if (!network) return network.error();
  auto made = std::make_unique<QNetwork>(
      deep, std::make_shared<const nn::Network>(std::move(*network)), rows, rows, target);
  made->initialise(seed);
  return std::unique_ptr<QFunction>(std::move(made));
}

}  // namespace quoll

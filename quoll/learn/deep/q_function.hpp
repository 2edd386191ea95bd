#pragma once
// The border to whatever approximates Q: networks of ours now, others later. A few calls per batch;
// learners know nothing of layers. Rows of inputs lie inputs() floats apart, rows of outputs
// actions() x atoms(), action by action.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "quoll/base/archive.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/nn/network.hpp"
#include "quoll/nn/traces.hpp"

namespace quoll {

class QFunction {
 public:
  enum class Weights : std::uint8_t { online, target };

  virtual ~QFunction() = default;
  virtual std::size_t inputs() const = 0;
  virtual std::size_t actions() const = 0;
  /// Numbers per action: 1, or those of a distribution.
  virtual std::size_t atoms() const = 0;

  /// All outputs of each row.
  virtual void values(Weights which, const float* inputs, std::size_t rows, float* out) = 0;
  /// All outputs, by the online weights, of one row that is 1 at `ones`, ascending, and 0
  /// elsewhere; its zeros cost nothing.
  virtual void values(std::span<const std::uint32_t> ones, float* out) = 0;
  /// The outputs of one action of each row, by the online weights: rows x atoms(). Remembers the
  /// batch; the inputs must stay until update().
  virtual void predict(const float* inputs, std::size_t rows, const Action* actions,
                       float* out) = 0;
  /// One step of the optimiser; `slopes` = the gradient of the loss by what predict() gave, rows x
  /// atoms(). Returns the norm of the gradient before it was clipped, 0 where
  /// none is.
  virtual double update(const float* slopes, double learning_rate) = 0;
  /// Keeps that gradient for the next update(), which adds what was kept: a batch in parts.
  virtual void add(const float* slopes) = 0;
  /// The optimiser begins anew, and nothing is kept of add(); the weights stay.
  virtual void forget_steps() = 0;
  /// Instead of update(): the traces decay, take up the gradient, and the weights follow them;
  /// `slopes` = the gradient of the value by what predict() gave. Only where DeepSetup::traces.
  virtual void follow_traces(const float* slopes, const nn::TraceStep& how) = 0;
  virtual void clear_traces() = 0;
  /// New noise for these weights, where the function is noisy: that of all that is asked until the
  /// next call.
  virtual void redraw(Weights which) = 0;
  /// Moves the target weights that share of the way to the online ones; 1 = copies them.
  virtual void sync(double share) = 0;
  /// The online weights as they are, without noise, to act with.
  virtual std::unique_ptr<QFunction> snapshot() const = 0;
  /// The layers and the online weights without noise, where it is made of such; else nullptr and
  /// nothing.
  virtual const nn::Network* network() const { return nullptr; }
  virtual std::span<const float> weights() const { return {}; }
  virtual void persist(Archive& archive) = 0;
};

}  // namespace quoll

#include "quoll/learn/deep/deep_settings.hpp"

namespace quoll {

void DeepSettings::describe(Describer& d) {
  d.choice("layout", layout, layout_names,
           "networks: one with an output per action, one network per action, or one that reads the "
           "action too");
  d("hidden", hidden, "networks: sizes of the hidden layers, such as 120,84; none = linear");
  d("filters", filters,
    "networks: convolutions before them, COUNTxSIZE or COUNTxSIZE/STRIDE each, such as 16x3; none");
  d("activation", activation, "networks: relu, elu, tanh or leaky-relu");
  d.choice("layer_norm", layer_norm, switch_names,
           "networks: layer normalisation before each activation");
  d("initial_weights", initial_weights, "networks: uniform, he, orthogonal or sparse");
  d.choice(
      "inputs", inputs, scaling_names,
      "networks: observed numbers as they are, or their ranges as [-1, 1]; auto of stream-q: by "
      "their mean and deviation so far; of a listed state an input of its own, or letters of its "
      "name");
  d("optimiser", optimiser, "networks: sgd, rmsprop, centred-rmsprop, adam, radam or rprop");
  d("learning_rate", learning_rate, "networks: step of the optimiser, or FROM:TO:STEPS");
  d("optimiser_epsilon", optimiser_epsilon, 0, 1,
    "adam, radam, rmsprop: what is added to the root in the denominator");
  d("gradient_decay", gradient_decay, 0, 1, "rmsprop: decay of the running means");
  d("loss", loss, "networks: squared, half-squared or huber");
  d("clip_gradient", clip_gradient, -1, 1e300,
    "networks: largest norm of a gradient; 0 = any, -1 = the method's");
  d("batch", batch, 0, 65536, "dqn: transitions of an update; 0 = the method's");
  d("reward_scale", reward_scale, 1e-9, 1e9, "networks: what rewards are multiplied by to learn");
  d("replay", replay, 0, 1e8, "dqn, nfq: transitions that are remembered; 0 = the method's");
  d("learning_starts", learning_starts, "dqn: steps before the first update");
  d("train_every", train_every, 0, 1e9,
    "dqn: steps between updates, nfq: between fits; 0 = the method's");
  d("gradient_steps", gradient_steps, 0, 1e6, "dqn: updates each time; 0 = the method's");
  d("target_every", target_every, 0, 1e12,
    "dqn: steps between changes of the target network; 0 = 500");
  d("target_share", target_share, 0, 1, "dqn: how far it then moves to the learning one; 1 = copy");
  d("double_q", double_q, "dqn: the learning network chooses, the target network values");
  d("duelling", duelling, "dqn, pqn: a value and advantages in the last layers");
  d("multi_step", multi_step, 1, 1000, "dqn, nfq: rewards in a target before the network's value");
  d("prioritised", prioritised, "dqn: replays what surprised more often");
  d("priority_exponent", priority_exponent, 0, 1, "prioritised: of the error; 0 = evenly");
  d("priority_correction", priority_correction,
    "prioritised: exponent of the weights that correct it, or FROM:TO:STEPS");
  d("munchausen", munchausen, "dqn: soft values, and the log-policy as a part of the reward");
  d("noisy", noisy, "dqn: weights with noise whose size is learned explore; no epsilon");
  d.choice("returns", returns, returns_names,
           "dqn: what is learned: mean, categorical (C51) or quantile (QR-DQN) distributions");
  d("atoms", atoms, 0, 1024, "categorical, quantile: numbers per action; 0 = 51, 32");
  d("lowest_return", lowest_return, -1e300, 1e300, "categorical: the first atom");
  d("highest_return", highest_return, -1e300, 1e300, "categorical: the last atom");
  d("fits", fits, 0, 1e6, "nfq: fits each time, each to new targets; 0 = the method's");
  d("walkers", walkers, 0, 65536, "networks: lanes walked together; 0 = the method's");
  d("rollout", rollout, 0, 65536, "pqn: steps of each lane between updates; 0 = the method's");
  d("minibatches", minibatches, 0, 65536,
    "pqn: parts into which they are shuffled; 0 = the method's");
  d("epochs", epochs, 0, 1e6,
    "pqn: passes over them, nfq: over all that is remembered; 0 = the method's");
  d("return_decay", return_decay, -1, 1, "pqn: lambda of its returns; -1 = 0.65");
  d("overshoot_bound", overshoot_bound, 1e-9, 1e9,
    "stream-q: kappa; a step corrects at most about 1 / kappa of an error");
}

}  // namespace quoll

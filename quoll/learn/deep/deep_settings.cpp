#include "quoll/learn/deep/deep_settings.hpp"

namespace quoll {

void DeepSettings::describe(Describer& d) {
  describe_network(d);
  describe_methods(d);
}

void DeepSettings::describe_network(Describer& d) {
  Describer::Part networks = d.of("networks");
  Describer::Part batched = d.of("nfq, dqn, pqn, distil");
  networks.choice("layout", layout, layout_names,
                  "one with an output per action, one network per action, or one that reads the "
                  "action too");
  networks("hidden", hidden, "sizes of the hidden layers, such as 120,84; none = linear");
  networks("filters", filters,
           "convolutions before them, COUNTxSIZE or COUNTxSIZE/STRIDE each, such as 16x3; none");
  networks("activation", activation, "relu, elu, tanh or leaky-relu");
  networks.choice("layer_norm", layer_norm, switch_names,
                  "layer normalisation before each activation");
  networks("initial_weights", initial_weights, "uniform, he, orthogonal or sparse");
  networks.choice(
      "inputs", inputs, scaling_names,
      "observed numbers as they are, or their ranges as [-1, 1]; auto of stream-q: by "
      "their mean and deviation so far; of a listed state an input of its own, or letters "
      "of its name");
  batched("optimiser", optimiser, "sgd, rmsprop, centred-rmsprop, adam, radam or rprop");
  networks("learning_rate", learning_rate, "step of the optimiser, or FROM:TO:STEPS");
  d.of("adam, radam, rmsprop, centred-rmsprop")("optimiser_epsilon", optimiser_epsilon, 1e-30, 1,
                                                "what is added to the root in the denominator");
  d.of("rmsprop, centred-rmsprop")("gradient_decay", gradient_decay, 0, 1,
                                   "decay of the running means");
  d.of("nfq, dqn, pqn, distil with mean")("loss", loss, "squared, half-squared or huber");
  batched("clip_gradient", clip_gradient, -1, 1e300,
          "largest norm of a gradient; 0 = any, -1 = the method's");
  d.of("dqn, distil")("batch", batch, 0, 65536, "transitions of an update; 0 = the method's");
  networks(
      "reward_scale", reward_scale, 0, 1e9,
      "what rewards are multiplied by to learn; 0 = 1, or where the world declares its rewards: "
      "what makes the largest 1 if it is below 0.01, 1000 if above, with loss huber at most 1");
}

void DeepSettings::describe_methods(Describer& d) {
  Describer::Part replaying = d.of("nfq, dqn");
  Describer::Part dqn = d.of("dqn");
  Describer::Part by_priority = d.of("prioritised");
  Describer::Part categories = d.of("categorical");
  Describer::Part pqn = d.of("pqn");
  replaying("replay", replay, 0, 1e8, "transitions that are remembered; 0 = the method's");
  dqn("learning_starts", learning_starts, "steps before the first update");
  replaying("train_every", train_every, 0, 1e9,
            "steps between updates, of nfq between fits; 0 = the method's");
  dqn("gradient_steps", gradient_steps, 0, 1e6, "updates each time; 0 = the method's");
  dqn("target_every", target_every, 0, 1e12,
      "steps between changes of the target network; 0 = 500");
  dqn("target_share", target_share, 0, 1, "how far it then moves to the learning one; 1 = copy");
  dqn("double_q", double_q, "the learning network chooses, the target network values");
  d.of("networks")("duelling", duelling, "a value and advantages in the last layers");
  replaying("multi_step", multi_step, 0, 1000,
            "rewards in a target before the network's value; 0 = the method's");
  dqn("prioritised", prioritised, "replays what surprised more often");
  by_priority("priority_exponent", priority_exponent, 0, 1, "of the error; 0 = evenly");
  by_priority("priority_correction", priority_correction,
              "exponent of the weights that correct it, or FROM:TO:STEPS");
  dqn("munchausen", munchausen, "soft values, and the log-policy as a part of the reward");
  dqn("noisy", noisy, "weights with noise whose size is learned explore, not epsilon");
  dqn.choice("returns", returns, returns_names,
             "what is learned: mean, categorical (C51) or quantile (QR-DQN) distributions");
  d.of("categorical, quantile")("atoms", atoms, 0, 1024, "numbers per action; 0 = 51, 32");
  categories("lowest_return", lowest_return, -1e300, 1e300,
             "the first atom; both 0 = what rewards and discount allow");
  categories("highest_return", highest_return, -1e300, 1e300, "the last atom");
  d.of("nfq")("fits", fits, 0, 1e6, "fits each time, each to new targets; 0 = the method's");
  d.of("nfq, dqn, pqn")("walkers", walkers, 0, 65536, "lanes walked together; 0 = the method's");
  pqn("rollout", rollout, 0, 65536, "steps of each lane between updates; 0 = the method's");
  pqn("minibatches", minibatches, 0, 65536,
      "parts into which a rollout is shuffled; 0 = the method's");
  d.of("nfq, pqn")("epochs", epochs, 0, 1e6,
                   "passes over a rollout, of nfq over all that is remembered; 0 = the method's");
  pqn("return_decay", return_decay, -1, 1, "lambda of its returns; -1 = 0.65");
  d.of("stream-q")("overshoot_bound", overshoot_bound, 1e-9, 1e9,
                   "kappa; a step corrects at most about 1 / kappa of an error");
}

}  // namespace quoll

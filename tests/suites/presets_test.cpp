// Every number of presets/ against the value its source publishes (named in the file itself), typed
// here a second time.

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "quoll/experiment/config.hpp"
#include "quoll/experiment/settings.hpp"

namespace quoll {
namespace {

using Values = std::map<std::string, std::string>;

// What all of CleanRL's, of the zoo's and of purejaxql's have in common.
Values with(Values values, const Values& more) {
  for (const auto& [key, value] : more) values[key] = value;
  return values;
}

const Values all = {{"discount", "0.99"}, {"inputs", "raw"}, {"explore", "epsilon-greedy"}};
// What none of them has, but Quoll's own settings.
const Values plain_dqn = with(all, {{"method", "dqn"}, {"layer_norm", "off"}, {"multi_step", "1"}});
const Values zoo = with(plain_dqn, {{"hidden", "256,256"},
                                    {"initial_weights", "uniform"},
                                    {"optimiser", "adam"},
                                    {"loss", "huber"},
                                    {"clip_gradient", "10"}});
const Values cleanrl = with(all, {{"hidden", "120,84"}, {"loss", "squared"}});
const Values purejaxql = with(all, {{"method", "pqn"},
                                    {"layer_norm", "on"},
                                    {"initial_weights", "he"},
                                    {"optimiser", "radam"},
                                    {"loss", "half-squared"},
                                    {"clip_gradient", "10"}});

// Dopamine's agent with all six parts of Rainbow.
const Values rainbow = {{"method", "dqn"},
                        {"layer_norm", "off"},
                        {"discount", "0.99"},
                        {"initial_weights", "uniform"},
                        {"optimiser", "adam"},
                        {"optimiser_epsilon", "0.0003125"},
                        {"clip_gradient", "0"},
                        {"gradient_steps", "1"},
                        {"double_q", "true"},
                        {"duelling", "true"},
                        {"multi_step", "3"},
                        {"prioritised", "true"},
                        {"priority_exponent", "0.5"},
                        {"priority_correction", "0.5"},
                        {"noisy", "true"},
                        {"returns", "categorical"},
                        {"atoms", "51"},
                        {"explore", "greedy"}};

std::map<std::string, Values> published() {
  return {
      {"cleanrl-cartpole-dqn", with(cleanrl, {{"method", "dqn"},
                                              {"layer_norm", "off"},
                                              {"multi_step", "1"},
                                              {"initial_weights", "uniform"},
                                              {"optimiser", "adam"},
                                              {"learning_rate", "0.00025"},
                                              {"clip_gradient", "0"},
                                              {"batch", "128"},
                                              {"replay", "10000"},
                                              {"learning_starts", "10000"},
                                              {"train_every", "10"},
                                              {"gradient_steps", "1"},
                                              {"target_every", "500"},
                                              {"epsilon", "1:0.05:250000"}})},
      {"cleanrl-cartpole-pqn", with(cleanrl, {{"method", "pqn"},
                                              {"layer_norm", "on"},
                                              {"initial_weights", "orthogonal"},
                                              {"optimiser", "radam"},
                                              {"learning_rate", "0.00025:0:500000"},
                                              {"clip_gradient", "10"},
                                              {"walkers", "4"},
                                              {"rollout", "128"},
                                              {"minibatches", "4"},
                                              {"epochs", "4"},
                                              {"return_decay", "0.65"},
                                              {"epsilon", "1:0.05:250000"}})},
      {"pqn-cartpole", with(purejaxql, {{"hidden", "256,256"},
                                        {"learning_rate", "0.0001:0:500000"},
                                        {"reward_scale", "0.1"},
                                        {"walkers", "32"},
                                        {"rollout", "64"},
                                        {"minibatches", "16"},
                                        {"epochs", "4"},
                                        {"return_decay", "0.95"},
                                        {"epsilon", "1:0.2:100000"}})},
      {"pqn-minatar", with(purejaxql, {{"filters", "16x3"},
                                       {"hidden", "128"},
                                       {"learning_rate", "0.0005:0:10000000"},
                                       {"walkers", "128"},
                                       {"rollout", "32"},
                                       {"minibatches", "32"},
                                       {"epochs", "2"},
                                       {"return_decay", "0.65"},
                                       {"epsilon", "1:0.05:1000000"}})},
      {"zoo-cartpole", with(zoo, {{"learning_rate", "0.0023"},
                                  {"batch", "64"},
                                  {"replay", "100000"},
                                  {"learning_starts", "1000"},
                                  {"train_every", "256"},
                                  {"gradient_steps", "128"},
                                  {"target_every", "10"},
                                  {"epsilon", "1:0.04:8000"}})},
      {"zoo-acrobot", with(zoo, {{"learning_rate", "0.00063"},
                                 {"batch", "128"},
                                 {"replay", "50000"},
                                 {"learning_starts", "0"},
                                 {"train_every", "4"},
                                 {"gradient_steps", "4"},
                                 {"target_every", "250"},
                                 {"epsilon", "1:0.1:12000"}})},
      {"zoo-mountaincar", with(zoo, {{"discount", "0.98"},
                                     {"learning_rate", "0.004"},
                                     {"batch", "128"},
                                     {"replay", "10000"},
                                     {"learning_starts", "1000"},
                                     {"train_every", "16"},
                                     {"gradient_steps", "8"},
                                     {"target_every", "600"},
                                     {"epsilon", "1:0.07:24000"}})},
      {"rainbow-minatar", with(rainbow, {{"inputs", "raw"},
                                         {"filters", "16x3"},
                                         {"hidden", "none"},
                                         {"learning_rate", "0.00025"},
                                         {"batch", "32"},
                                         {"replay", "100000"},
                                         {"learning_starts", "1000"},
                                         {"train_every", "4"},
                                         {"target_every", "1000"},
                                         {"lowest_return", "-100"},
                                         {"highest_return", "100"}})},
      {"rainbow-cartpole", with(rainbow, {{"inputs", "scaled"},
                                          {"hidden", "512,512"},
                                          {"learning_rate", "0.0001"},
                                          {"batch", "128"},
                                          {"replay", "50000"},
                                          {"learning_starts", "500"},
                                          {"train_every", "2"},
                                          {"target_every", "100"},
                                          {"lowest_return", "-200"},
                                          {"highest_return", "200"}})},
      {"minatar-paper", with(plain_dqn, {{"filters", "16x3"},
                                         {"hidden", "128"},
                                         {"initial_weights", "uniform"},
                                         {"optimiser", "centred-rmsprop"},
                                         {"learning_rate", "0.00025"},
                                         {"gradient_decay", "0.95"},
                                         {"optimiser_epsilon", "0.01"},
                                         {"loss", "huber"},
                                         {"clip_gradient", "0"},
                                         {"batch", "32"},
                                         {"replay", "100000"},
                                         {"learning_starts", "5000"},
                                         {"train_every", "1"},
                                         {"gradient_steps", "1"},
                                         {"target_every", "1000"},
                                         {"epsilon", "1:0.1:100000"}})},
  };
}

TEST(Presets, AreAsPublished) {
  const std::filesystem::path folder = std::filesystem::path(QUOLL_SOURCE) / "presets";
  std::map<std::string, Values> left = published();
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().stem().string();
    const auto found = left.find(name);
    ASSERT_NE(found, left.end()) << name << " is not compared with its source";
    RunSettings settings;
    std::vector<Setting> list = settings_of(settings);
    const Result<void> applied = read_config(entry.path().string(), list);
    ASSERT_TRUE(applied) << message(applied.error());
    RunSettings usual;
    std::vector<Setting> untouched = settings_of(usual);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto value = found->second.find(std::string(list[i].name));
      const std::string expected =
          value == found->second.end() ? text_of(untouched[i]) : value->second;
      EXPECT_EQ(text_of(list[i]), expected) << name << ", " << list[i].name;
    }
    left.erase(found);
  }
  for (const auto& [name, values] : left) ADD_FAILURE() << "no presets/" << name << ".toml";
}

}  // namespace
}  // namespace quoll

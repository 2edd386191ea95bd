#pragma once
// One pass of a batch through a network, forward and back: the room for everything between the
// layers, allocated once.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "quoll/nn/network.hpp"

namespace quoll::nn {

/// Floats that begin where a cache line does.
class Floats {
 public:
  Floats() = default;
  explicit Floats(std::size_t n);
  float* data() { return data_.get(); }
  const float* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  std::span<float> span() { return {data(), size_}; }
  std::span<const float> span() const { return {data(), size_}; }
  float& operator[](std::size_t i) { return data_[i]; }
  float operator[](std::size_t i) const { return data_[i]; }

 private:
  struct Free {
    void operator()(float* p) const;
  };
  std::unique_ptr<float[], Free> data_;
  std::size_t size_ = 0;
};

/// Saves them as a sequence of floats; loading wants as many as there are.
void persist_floats(Archive& archive, std::string_view name, Floats& floats);

class Pass {
 public:
  /// The network must stay where it is as long as the pass is in use.
  /// `most` = largest number of samples; `back` = whether gradients are wanted.
  Pass(const Network& network, std::size_t most, bool back);

  /// Computes all heads for `samples` rows of inputs, `row` floats apart. The inputs must stay as
  /// they are until backward().
  void forward(const float* parameters, const float* input, std::size_t row, std::size_t samples);
  /// The same for one sample that is 1 at `ones`, ascending, and 0 elsewhere: its zeros are neither
  /// written nor read. No backward() follows.
  void forward(const float* parameters, std::span<const std::uint32_t> ones);
  /// What head `head` gave: rows of outputs, output_row(head) floats apart.
  const float* output(std::size_t head) const;
  std::size_t output_row(std::size_t head) const;

  /// Where the caller writes the gradient of the loss by the outputs of the last forward(), all
  /// outputs(head) numbers of each row; the same rows, whose padding stays 0.
  float* gradient(std::size_t head);
  /// Writes the gradient of the loss by the parameters: every float of `gradients`.
  void backward(const float* parameters, float* gradients);

 private:
  struct Stage {
    const Layer* layer;
    Floats patches;     // convolutions: what each place reads
    Floats normalised;  // before gain and shift
    Floats scales;
    Floats outputs;
    Floats gradient;               // by the outputs, then by the sums
    std::vector<Readers> readers;  // of each input of the network, where that is what is read
  };
  struct Read {
    const float* data;
    std::size_t row;
  };
  // Samples, from one on.
  struct Part {
    std::size_t begin, count;
  };

  void add_up(Stage& stage, Read from, const float* parameters, float* sums);
  void forward(Stage& stage, Read from, const float* parameters);
  void forward_all(const float* parameters);
  void backward(Stage& stage, Read from, const float* parameters, float* gradients);
  void pass_on(std::span<const std::size_t> readers, const float* parameters, Stage& before);
  void turn(const Stage& reader, Part part, const float* parameters, bool add);
  void gather(const Layer& layer, Read from, float* patches) const;
  void scatter(const Layer& layer, const float* patches, Part part, Stage& before) const;
  std::size_t after(std::size_t index) const;
  Read read_by(std::size_t index) const;
  static Window window(const Stage& stage);
  void look_for_spots();
  bool sparse(Read from) const { return sparse_ && from.data == input_.data; }
  Spots spots(std::size_t sample) const;

  const Network& network_;
  std::size_t most_, samples_ = 0;
  std::vector<Stage> stages_;
  Read input_{};
  Floats zeros_;  // a sample, where forward() was told of ones
  // Where the inputs are not 0, if they mostly are: sample i's from spots_begin_[i] on.
  bool sparse_ = false;
  std::vector<std::uint32_t> spots_;
  std::vector<std::size_t> spots_begin_;
  std::vector<std::size_t> first_of_heads_;
  Floats turned_, turned_back_;  // gradients with samples as columns
};

}  // namespace quoll::nn

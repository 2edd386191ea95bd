#include "quoll/nn/pass.hpp"

#include <algorithm>
#include <cstring>
#include <new>

namespace quoll::nn {

namespace {
constexpr std::align_val_t line{64};
}

Floats::Floats(std::size_t n)
    : data_(n == 0 ? nullptr : static_cast<float*>(::operator new(n * sizeof(float), line))),
      size_(n) {
  std::fill_n(data_.get(), n, 0.0f);
}

void Floats::Free::operator()(float* p) const {
  ::operator delete(p, line);
}

void persist_floats(Archive& archive, std::string_view name, Floats& floats) {
  std::span<float> fixed = floats.span();
  archive(name, fixed);
}

namespace {

// Samples whose gradients are turned at a time: as many as keep what is turned in the near caches.
std::size_t turned_together(const Layer& layer) {
  constexpr std::size_t rows = 128;
  return std::max<std::size_t>(1, rows / layer.places);
}

// From one row of what is turned to the next: an odd number of cache lines, since rows a power of
// two apart would share few places of a cache.
std::size_t turned_row(std::size_t columns) {
  return (padded(columns) / vector_width | 1) * vector_width;
}

// Inputs of which at most one in this many is not 0 are read one by one.
constexpr std::size_t sparse_share = 4;

// Of each number of what a convolution reads.
std::vector<Readers> readers_of(const Layer& layer) {
  const std::uint32_t kernel = layer.spec.kernel, stride = layer.spec.stride;
  // The first of `places` that reads from x on, and one after the last.
  const auto first = [&](std::uint32_t x) { return x < kernel ? 0 : (x - kernel) / stride + 1; };
  const auto end = [&](std::uint32_t x, std::uint32_t places) {
    return std::max(first(x), std::min(places, x / stride + 1));
  };
  std::vector<Readers> readers;
  for (std::uint32_t y = 0; y < layer.in.height; ++y) {
    for (std::uint32_t x = 0; x < layer.in.width; ++x) {
      const std::uint32_t top = first(y), left = first(x);
      const std::uint32_t corner = (y - top * stride) * kernel + (x - left * stride);
      for (std::uint32_t channel = 0; channel < layer.in.channels; ++channel) {
        readers.push_back({top * layer.out.width + left, corner * layer.in.channels + channel,
                           static_cast<std::uint16_t>(end(y, layer.out.height) - top),
                           static_cast<std::uint16_t>(end(x, layer.out.width) - left)});
      }
    }
  }
  return readers;
}

}  // namespace

Pass::Pass(const Network& network, std::size_t most, bool back) : network_(network), most_(most) {
  std::size_t turned = 0, turned_back = 0;
  for (const Layer& layer : network.layers()) {
    const std::size_t rows = padded(most * layer.places);
    Stage stage{&layer, {}, {}, {}, Floats(rows * layer.row), {}, {}};
    if (layer.spec.convolution()) stage.patches = Floats(rows * padded(layer.inputs));
    if (layer.normalised()) {
      stage.normalised = Floats(rows * layer.row);
      stage.scales = Floats(rows);
    }
    if (back) {
      // A dense reader turns back 16 samples at a time, the layer itself turns 16 rows.
      stage.gradient = Floats(padded(most) * layer.width() + vector_width * layer.row);
      const std::size_t columns = turned_row(std::min(most, turned_together(layer)) * layer.places);
      turned = std::max(turned, layer.row * columns);
      turned_back = std::max(turned_back, padded(layer.inputs) * columns);
    }
    stages_.push_back(std::move(stage));
  }
  // Few inputs are not worth looking at.
  if (network.inputs() >= vector_width) {
    spots_.resize(most * network.inputs() / sparse_share);
    spots_begin_.resize(most + 1);
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      Stage& stage = stages_[i];
      if (after(i) == 0 && stage.layer->spec.convolution()) {
        stage.readers = readers_of(*stage.layer);
      }
    }
  }
  turned_ = Floats(turned);
  turned_back_ = Floats(turned_back);
}

// One more than the stage before this one in its chain; 0: it reads the input.
std::size_t Pass::after(std::size_t index) const {
  const std::size_t body = network_.body().size();
  if (index >= body) {
    const Layer* const first = &network_.layers()[index];
    for (std::size_t h = 0; h < network_.heads(); ++h) {
      if (network_.head(h).data() == first) return body;
    }
  }
  return index;
}

Pass::Read Pass::read_by(std::size_t index) const {
  const std::size_t before = after(index);
  if (before == 0) return input_;
  const Stage& stage = stages_[before - 1];
  return {stage.outputs.data(), stage.layer->width()};
}

void Pass::look_for_spots() {
  sparse_ = false;
  if (spots_.empty()) return;
  const std::size_t most = samples_ * network_.inputs() / sparse_share;
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples_; ++i) {
    spots_begin_[i] = count;
    count += arithmetic().find_spots(input_.data + i * input_.row, network_.inputs(),
                                     spots_.data() + count, most - count);
    if (count > most) return;
  }
  spots_begin_[samples_] = count;
  sparse_ = true;
}

Window Pass::window(const Stage& stage) {
  const Layer& layer = *stage.layer;
  const std::uint32_t right = layer.spec.stride * layer.in.channels;
  const bool dense = stage.readers.empty();
  return {.readers = dense ? nullptr : stage.readers.data(),
          .right = right,
          .down = right * layer.spec.kernel,
          .places = layer.places,
          .out_width = layer.out.width,
          .row = layer.row};
}

Spots Pass::spots(std::size_t sample) const {
  const std::size_t begin = spots_begin_[sample];
  return {input_.data + sample * input_.row, spots_.data() + begin,
          spots_begin_[sample + 1] - begin};
}

void Pass::gather(const Layer& layer, Read from, float* patches) const {
  const std::size_t kernel = layer.spec.kernel, stride = layer.spec.stride;
  const std::size_t channels = layer.in.channels, across = kernel * channels;
  const std::size_t row = padded(layer.inputs);
  for (std::size_t i = 0; i < samples_; ++i) {
    for (std::size_t y = 0; y < layer.out.height; ++y) {
      const float* corner = from.data + i * from.row + y * stride * layer.in.width * channels;
      for (std::size_t x = 0; x < layer.out.width; ++x, corner += stride * channels) {
        for (std::size_t k = 0; k < kernel; ++k) {
          std::memcpy(patches + k * across, corner + k * layer.in.width * channels,
                      across * sizeof(float));
        }
        patches += row;
      }
    }
  }
}

// Adds what each place of a part of the samples read to where it came from.
void Pass::scatter(const Layer& layer, const float* patches, Part part, Stage& before) const {
  const std::size_t kernel = layer.spec.kernel, stride = layer.spec.stride;
  const std::size_t channels = layer.in.channels, across = kernel * channels;
  for (std::size_t i = part.begin; i < part.begin + part.count; ++i) {
    float* const sample = before.gradient.data() + i * before.layer->width();
    for (std::size_t y = 0; y < layer.out.height; ++y) {
      for (std::size_t x = 0; x < layer.out.width; ++x) {
        for (std::size_t k = 0; k < kernel; ++k) {
          float* const at = sample + ((y * stride + k) * layer.in.width + x * stride) * channels;
          for (std::size_t j = 0; j < across; ++j) at[j] += patches[k * across + j];
        }
        patches += padded(layer.inputs);
      }
    }
  }
}

// The sums of a stage, and its rectifier if that follows at once.
void Pass::add_up(Stage& stage, Read from, const float* parameters, float* sums) {
  const Layer& layer = *stage.layer;
  const bool relu = layer.spec.activation == Activation::relu && !layer.normalised();
  const float* const weights = parameters + layer.weights;
  const float* const bias = parameters + layer.bias;
  if (sparse(from)) {
    for (std::size_t i = 0; i < samples_; ++i) {
      arithmetic().sparse_forward(window(stage), spots(i), weights, bias, relu,
                                  sums + i * layer.width());
    }
    return;
  }
  if (layer.spec.convolution()) {
    gather(layer, from, stage.patches.data());
    from = {stage.patches.data(), padded(layer.inputs)};
  }
  arithmetic().product({.m = samples_ * layer.places,
                        .n = layer.row,
                        .k = layer.inputs,
                        .a = from.data,
                        .a_row = from.row,
                        .b = weights,
                        .b_row = layer.row,
                        .bias = bias,
                        .relu = relu,
                        .c = sums,
                        .c_row = layer.row});
}

void Pass::forward(Stage& stage, Read from, const float* parameters) {
  const Layer& layer = *stage.layer;
  const LayerSpec& spec = layer.spec;
  const std::size_t rows = samples_ * layer.places;
  float* const sums = layer.normalised() ? stage.normalised.data() : stage.outputs.data();
  add_up(stage, from, parameters, sums);
  const bool relu = spec.activation == Activation::relu;
  if (layer.normalised()) {
    const bool whole = spec.normalisation == Normalisation::sample;
    const std::size_t columns = whole ? layer.places * layer.outputs : layer.outputs;
    arithmetic().normalise({whole ? samples_ : rows, columns, layer.normalised_row()},
                           normalisation_epsilon, sums, parameters + layer.gain,
                           parameters + layer.shift, relu, stage.outputs.data(),
                           stage.scales.data());
  }
  if (relu || spec.activation == Activation::none) return;
  arithmetic().activate(spec.activation, stage.outputs.data(), rows * layer.row);
}

void Pass::forward(const float* parameters, const float* input, std::size_t row,
                   std::size_t samples) {
  samples_ = samples;
  input_ = {input, row};
  look_for_spots();
  forward_all(parameters);
}

void Pass::forward(const float* parameters, std::span<const std::uint32_t> ones) {
  if (zeros_.size() == 0) zeros_ = Floats(network_.inputs());
  samples_ = 1;
  input_ = {zeros_.data(), network_.inputs()};
  sparse_ = !spots_.empty() && ones.size() <= network_.inputs() / sparse_share;
  if (sparse_) {
    std::copy(ones.begin(), ones.end(), spots_.begin());
    spots_begin_[0] = 0;
    spots_begin_[1] = ones.size();
  }
  for (const std::uint32_t at : ones) zeros_[at] = 1.0f;
  forward_all(parameters);
  for (const std::uint32_t at : ones) zeros_[at] = 0.0f;
}

void Pass::forward_all(const float* parameters) {
  for (std::size_t i = 0; i < stages_.size(); ++i) forward(stages_[i], read_by(i), parameters);
}

const float* Pass::output(std::size_t head) const {
  const Layer* const last = &network_.head(head).back();
  return stages_[static_cast<std::size_t>(last - network_.layers().data())].outputs.data();
}

std::size_t Pass::output_row(std::size_t head) const {
  return network_.head(head).back().width();
}

float* Pass::gradient(std::size_t head) {
  const Layer* const last = &network_.head(head).back();
  return stages_[static_cast<std::size_t>(last - network_.layers().data())].gradient.data();
}

// Gradients of the stage's own parameters; leaves the gradient by its sums in stage.gradient.
void Pass::backward(Stage& stage, Read from, const float* parameters, float* gradients) {
  const Layer& layer = *stage.layer;
  const std::size_t rows = samples_ * layer.places;
  float* const gradient = stage.gradient.data();
  arithmetic().slope(layer.spec.activation, stage.outputs.data(), gradient, rows * layer.row);
  if (layer.normalised()) {
    const bool whole = layer.spec.normalisation == Normalisation::sample;
    const std::size_t columns = whole ? layer.places * layer.outputs : layer.outputs;
    arithmetic().normalise_back({whole ? samples_ : rows, columns, layer.normalised_row()},
                                stage.normalised.data(), stage.scales.data(),
                                parameters + layer.gain, gradient, gradients + layer.gain,
                                gradients + layer.shift);
    if (!layer.spec.gain) std::fill_n(gradients + layer.gain, 2 * layer.normalised_row(), 0.0f);
  }
  arithmetic().column_sums(gradient, rows, layer.row, layer.row, gradients + layer.bias);
  if (sparse(from)) {
    float* const by_weights = gradients + layer.weights;
    std::fill_n(by_weights, layer.inputs * layer.row, 0.0f);
    for (std::size_t i = 0; i < samples_; ++i) {
      arithmetic().sparse_back(window(stage), spots(i), gradient + i * layer.width(), by_weights);
    }
    return;
  }
  if (layer.spec.convolution()) from = {stage.patches.data(), padded(layer.inputs)};
  arithmetic().product({.m = layer.inputs,
                        .n = layer.row,
                        .k = rows,
                        .a = from.data,
                        .a_row = 1,
                        .a_column = from.row,
                        .b = gradient,
                        .b_row = layer.row,
                        .c = gradients + layer.weights,
                        .c_row = layer.row});
}

// The gradient by what `readers` of the same outputs read, some samples at a time, with samples as
// columns: the weights are read as they lie, and what is turned is small.
void Pass::pass_on(std::span<const std::size_t> readers, const float* parameters, Stage& before) {
  Stage& first = stages_[readers.front()];
  const Layer& layer = *first.layer;
  const std::size_t together = turned_together(layer);
  const bool scattered = layer.spec.convolution();
  if (scattered) std::fill_n(before.gradient.data(), samples_ * before.layer->width(), 0.0f);
  for (std::size_t begin = 0; begin < samples_; begin += together) {
    const Part part{begin, std::min(together, samples_ - begin)};
    for (const std::size_t reader : readers) {
      turn(stages_[reader], part, parameters, reader != readers.front());
    }
    const std::size_t columns = padded(part.count * layer.places), row = turned_row(columns);
    const std::size_t height = padded(layer.inputs), width = before.layer->width();
    float* const to = scattered ? first.patches.data() : before.gradient.data() + begin * width;
    arithmetic().transpose(turned_back_.data(), height, columns, row, to,
                           scattered ? height : width);
    if (scattered) scatter(layer, to, part, before);
  }
}

// Adds to turned_back_, or begins it, what one reader passes on of a part of the samples.
void Pass::turn(const Stage& reader, Part part, const float* parameters, bool add) {
  const Layer& layer = *reader.layer;
  const std::size_t columns = padded(part.count * layer.places), row = turned_row(columns);
  arithmetic().transpose(reader.gradient.data() + part.begin * layer.width(), columns, layer.row,
                         layer.row, turned_.data(), row);
  std::fill(turned_back_.data() + layer.inputs * row,
            turned_back_.data() + padded(layer.inputs) * row, 0.0f);
  arithmetic().product({.m = layer.inputs,
                        .n = columns,
                        .k = layer.outputs,
                        .a = parameters + layer.weights,
                        .a_row = layer.row,
                        .b = turned_.data(),
                        .b_row = row,
                        .add = add,
                        .c = turned_back_.data(),
                        .c_row = row});
}

void Pass::backward(const float* parameters, float* gradients) {
  const std::size_t body = network_.body().size();
  // The stages of a chain, last first; what the first one passes on is the caller's business.
  const auto chain = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = end; i-- > begin;) {
      backward(stages_[i], read_by(i), parameters, gradients);
      if (i > begin) pass_on({&i, 1}, parameters, stages_[i - 1]);
    }
  };
  first_of_heads_.clear();
  for (std::size_t h = 0, begin = body; h < network_.heads(); ++h) {
    chain(begin, begin + network_.head(h).size());
    first_of_heads_.push_back(begin);
    begin += network_.head(h).size();
  }
  if (body == 0) return;
  pass_on(first_of_heads_, parameters, stages_[body - 1]);
  chain(0, body);
}

}  // namespace quoll::nn

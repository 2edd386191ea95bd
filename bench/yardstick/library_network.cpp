// Compiled for the processor at hand, unlike everything else: see bench/CMakeLists.txt.
#include "bench/yardstick/library_network.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bench/yardstick/stopwatch.hpp"

#ifdef QUOLL_EIGEN
#include <Eigen/Dense>
#endif
#ifdef QUOLL_OPENBLAS
#include <cblas.h>
#endif
#ifdef QUOLL_XSMM
#include <libxsmm.h>
#endif
#ifdef QUOLL_ONEDNN
#include <dnnl.h>
#include <omp.h>
#endif

namespace yardstick {
namespace {

// C (m x n) = A B, or C += A B; all row-major, A and B as they lie or transposed.
struct Matrices {
  bool a_turned, b_turned, add;
  std::size_t m, n, k;
  const float *a, *b;
  float* c;
  int a_row() const { return static_cast<int>(a_turned ? m : k); }
  int b_row() const { return static_cast<int>(b_turned ? k : n); }
};

#ifdef QUOLL_EIGEN
struct EigenProduct {
  static std::string name() { return "Eigen"; }
  using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Row = Eigen::Matrix<float, 1, Eigen::Dynamic, Eigen::RowMajor>;
  using In = Eigen::Map<const Matrix>;

  template <class Out>
  static void put(Out& c, bool add, const auto& product) {
    if (add) {
      c.noalias() += product;
    } else {
      c.noalias() = product;
    }
  }
  static void run(const Matrices& p) {
    const auto m = static_cast<long>(p.m), n = static_cast<long>(p.n), k = static_cast<long>(p.k);
    const In a(p.a, p.a_turned ? k : m, p.a_turned ? m : k);
    const In b(p.b, p.b_turned ? n : k, p.b_turned ? k : n);
    if (p.m == 1 && !p.a_turned && !p.b_turned) {
      Eigen::Map<Row> c(p.c, n);
      return put(c, p.add, Eigen::Map<const Row>(p.a, k) * b);
    }
    Eigen::Map<Matrix> c(p.c, m, n);
    if (p.a_turned) return put(c, p.add, a.transpose() * b);
    if (p.b_turned) return put(c, p.add, a * b.transpose());
    put(c, p.add, a * b);
  }
};
#endif

#ifdef QUOLL_OPENBLAS
struct BlasProduct {
  static std::string name() {
    return std::string("OpenBLAS (kernels of ") + openblas_get_corename() + ")";
  }
  static void run(const Matrices& p) {
    cblas_sgemm(CblasRowMajor, p.a_turned ? CblasTrans : CblasNoTrans,
                p.b_turned ? CblasTrans : CblasNoTrans, static_cast<int>(p.m),
                static_cast<int>(p.n), static_cast<int>(p.k), 1.0f, p.a, p.a_row(), p.b, p.b_row(),
                p.add ? 1.0f : 0.0f, p.c, static_cast<int>(p.n));
  }
};
#endif

#ifdef QUOLL_XSMM
struct XsmmProduct {
  static std::string name() { return "libxsmm"; }
  // Column-major: the products of the transposed matrices, and none of these turned.
  static const float* turned(const float* x, std::size_t rows, std::size_t columns,
                             std::vector<float>& room) {
    room.resize(std::max(room.size(), rows * columns));
    libxsmm_otrans(room.data(), x, sizeof(float), static_cast<int>(columns), static_cast<int>(rows),
                   static_cast<int>(columns), static_cast<int>(rows));
    return room.data();
  }
  static void run(const Matrices& p) {
    static std::vector<float> room_a, room_b;
    const float* const a = p.a_turned ? turned(p.a, p.k, p.m, room_a) : p.a;
    const float* const b = p.b_turned ? turned(p.b, p.n, p.k, room_b) : p.b;
    const int m = static_cast<int>(p.m), n = static_cast<int>(p.n), k = static_cast<int>(p.k);
    const float alpha = 1.0f, beta = p.add ? 1.0f : 0.0f;
    libxsmm_smmdispatch(n, m, k, &n, &k, &n, &alpha, &beta, nullptr, nullptr)(b, a, p.c);
  }
};
#endif

#ifdef QUOLL_ONEDNN
struct OneDnnProduct {
  static std::string name() { return "oneDNN"; }
  static void run(const Matrices& p) {
    dnnl_sgemm(p.a_turned ? 'T' : 'N', p.b_turned ? 'T' : 'N', static_cast<long>(p.m),
               static_cast<long>(p.n), static_cast<long>(p.k), 1.0f, p.a, p.a_row(), p.b, p.b_row(),
               p.add ? 1.0f : 0.0f, p.c, static_cast<long>(p.n));
  }
};
#endif

struct Layer {
  std::size_t inputs, outputs, weights, bias;
};

template <class Product>
class Network : public LibraryNetwork {
 public:
  Network(const NetworkShape& shape, std::size_t most, const std::vector<float>& parameters)
      : shape_(shape), parameters_(parameters), target_(parameters) {
    std::size_t at = 0, inputs = shape.inputs;
    const auto add = [&](std::size_t in, std::size_t out, std::size_t rows) {
      layers_.push_back({in, out, at, at + in * out});
      at += (in + 1) * out;
      outputs_.emplace_back(rows * out);
      gradients_.emplace_back(rows * out);
    };
    if (shape.channels > 0) {
      patches_.resize(most * 64 * 9 * shape.channels);
      add(9 * shape.channels, 16, most * 64);
      inputs = 64 * 16;
    }
    for (const std::size_t outputs : shape.dense) {
      add(inputs, outputs, most);
      inputs = outputs;
    }
    gradient_.resize(at);
    mean_.resize(at);
    square_.resize(at);
  }

  std::string name() const override { return Product::name(); }

  const float* act(const float* inputs, std::size_t samples) override {
    return forward(parameters_, inputs, samples);
  }

  void train(const Transitions& batch) override {
    const std::size_t samples = batch.actions.size(), n = layers_.back().outputs;
    const float* const next = forward(target_, batch.after.data(), samples);
    std::vector<float> targets(samples);
    for (std::size_t i = 0; i < samples; ++i) {
      targets[i] = batch.rewards[i] + 0.99f * *std::max_element(next + i * n, next + (i + 1) * n);
    }
    const float* const q = forward(parameters_, batch.before.data(), samples);
    std::vector<float>& by_q = gradients_.back();
    std::fill_n(by_q.begin(), samples * n, 0.0f);
    for (std::size_t i = 0; i < samples; ++i) {
      const std::size_t at = i * n + batch.actions[i];
      by_q[at] = (q[at] - targets[i]) / static_cast<float>(samples);
    }
    backward(batch.before.data(), samples);
    adam();
  }

 private:
  bool convolution(std::size_t l) const { return l == 0 && shape_.channels > 0; }
  std::size_t rows(std::size_t l, std::size_t samples) const {
    return convolution(l) ? samples * 64 : samples;
  }

  void gather(const float* inputs, std::size_t samples) {
    float* to = patches_.data();
    const std::size_t c = shape_.channels;
    for (std::size_t i = 0; i < samples; ++i, inputs += 100 * c) {
      for (std::size_t y = 0; y < 8; ++y) {
        for (std::size_t x = 0; x < 8; ++x) {
          for (std::size_t k = 0; k < 3; ++k, to += 3 * c) {
            std::memcpy(to, inputs + ((y + k) * 10 + x) * c, 3 * c * sizeof(float));
          }
        }
      }
    }
  }

  const float* forward(const std::vector<float>& p, const float* inputs, std::size_t samples) {
    const float* x = inputs;
    for (std::size_t l = 0; l < layers_.size(); ++l) {
      const Layer& layer = layers_[l];
      if (convolution(l)) {
        gather(inputs, samples);
        x = patches_.data();
      }
      float* const y = outputs_[l].data();
      const std::size_t m = rows(l, samples), n = layer.outputs;
      for (std::size_t i = 0; i < m; ++i) std::copy_n(&p[layer.bias], n, y + i * n);
      Product::run({false, false, true, m, n, layer.inputs, x, &p[layer.weights], y});
      if (l + 1 < layers_.size()) {
        for (std::size_t i = 0; i < m * n; ++i) y[i] = y[i] > 0.0f ? y[i] : 0.0f;
      }
      x = y;
    }
    return x;
  }

  void backward(const float* inputs, std::size_t samples) {
    for (std::size_t l = layers_.size(); l-- > 0;) {
      const Layer& layer = layers_[l];
      float* const g = gradients_[l].data();
      const std::size_t m = rows(l, samples), n = layer.outputs;
      if (l + 1 < layers_.size()) {
        const float* const y = outputs_[l].data();
        for (std::size_t i = 0; i < m * n; ++i) g[i] = y[i] > 0.0f ? g[i] : 0.0f;
      }
      float* const bias = &gradient_[layer.bias];
      std::fill_n(bias, n, 0.0f);
      for (std::size_t i = 0; i < m; ++i) {
        for (std::size_t j = 0; j < n; ++j) bias[j] += g[i * n + j];
      }
      const float* const x = convolution(l) ? patches_.data()
                             : l > 0        ? outputs_[l - 1].data()
                                            : inputs;
      Product::run({true, false, false, layer.inputs, n, m, x, g, &gradient_[layer.weights]});
      if (l == 0) continue;
      Product::run({false, true, false, m, layer.inputs, n, g, &parameters_[layer.weights],
                    gradients_[l - 1].data()});
    }
  }

  void adam() {
    power1_ *= 0.9;
    power2_ *= 0.999;
    const auto step = static_cast<float>(2.5e-4 / (1.0 - power1_));
    const auto root = static_cast<float>(1.0 / std::sqrt(1.0 - power2_));
    float* __restrict const x = parameters_.data();
    float* __restrict const m = mean_.data();
    float* __restrict const v = square_.data();
    const float* __restrict const g = gradient_.data();
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      m[i] += 0.1f * (g[i] - m[i]);
      v[i] += 0.001f * (g[i] * g[i] - v[i]);
      x[i] -= step * m[i] / (std::sqrt(v[i]) * root + 1e-8f);
    }
  }

  NetworkShape shape_;
  std::vector<Layer> layers_;
  std::vector<float> parameters_, target_, gradient_, mean_, square_, patches_;
  std::vector<std::vector<float>> outputs_, gradients_;
  double power1_ = 1.0, power2_ = 1.0;
};

#ifdef __AVX512F__
constexpr std::size_t widest = 64;
#else
constexpr std::size_t widest = 32;
#endif
typedef float Widest __attribute__((vector_size(widest)));

}  // namespace

std::vector<std::unique_ptr<LibraryNetwork>> library_networks(
    [[maybe_unused]] const NetworkShape& shape, [[maybe_unused]] std::size_t most,
    [[maybe_unused]] const std::vector<float>& parameters) {
  std::vector<std::unique_ptr<LibraryNetwork>> all;
#ifdef QUOLL_EIGEN
  all.push_back(std::make_unique<Network<EigenProduct>>(shape, most, parameters));
#endif
#ifdef QUOLL_OPENBLAS
  openblas_set_num_threads(1);
  all.push_back(std::make_unique<Network<BlasProduct>>(shape, most, parameters));
#endif
#ifdef QUOLL_XSMM
  all.push_back(std::make_unique<Network<XsmmProduct>>(shape, most, parameters));
#endif
#ifdef QUOLL_ONEDNN
  omp_set_num_threads(1);
  all.push_back(std::make_unique<Network<OneDnnProduct>>(shape, most, parameters));
#endif
  return all;
}

double core_bound() {
  constexpr std::size_t rounds = 2000000, chains = 12;
  double best = 0.0;
  for (int block = 0; block < 5; ++block) {
    Widest sums[chains] = {};
    Widest factor = {}, term = {};
    factor += 0.999f;
    term += 1e-3f;
    // So that no two chains are known to be the same.
    for (Widest& sum : sums) asm volatile("" : "+x"(sum));
    const double taken = cpu_seconds([&] {
      for (std::size_t i = 0; i < rounds; ++i) {
#pragma GCC unroll 12
        for (std::size_t c = 0; c < chains; ++c) sums[c] = sums[c] * factor + term;
        asm volatile("" : "+x"(factor));
      }
    });
    for (std::size_t c = 0; c < chains; ++c) asm volatile("" : : "x"(sums[c]));
    const double flop = 2.0 * rounds * chains * widest / sizeof(float);
    best = std::max(best, flop / taken / 1e9);
  }
  return best;
}

}  // namespace yardstick

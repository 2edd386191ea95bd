#pragma once
// The arithmetic of networks: one matrix product and a few loops over flat arrays, written once
// with Google Highway and compiled for several instruction sets, of which the best one the
// processor has is taken when the program runs.
//
// Which bits come out depends only on whether the instruction set multiplies and adds with one
// rounding (fused). Every sum is taken in an order that no vector width changes: the k of a product
// one after the other, sums along a row in 16 columns that are added at the end. So AVX2 and
// AVX-512 give the same bits, and the base another.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace quoll::nn {

/// Floats in the largest vector; rows of matrices are padded with zeros to a multiple of it.
inline constexpr std::size_t vector_width = 16;
constexpr std::size_t padded(std::size_t n) {
  return (n + vector_width - 1) / vector_width * vector_width;
}

/// leaky_relu: what is below 0 counts a hundredth.
enum class Activation : std::uint8_t { none, relu, elu, tanh, leaky_relu };
inline constexpr std::string_view activation_names[] = {"none", "relu", "elu", "tanh",
                                                        "leaky-relu"};

/// C = A B, C = bias + A B (every row) or C += A B; then negative elements become 0 if `relu`
/// (what is no number stays so). With `add` no bias is read.
/// A is m x k, element (i, j) at a[i * a_row + j * a_column], one of the two steps being 1; B is k
/// x n with rows b_row apart (neither null, not even where k is 0); n is a multiple of
/// vector_width.
struct Product {
  std::size_t m = 0, n = 0, k = 0;
  const float* a = nullptr;
  std::size_t a_row = 0, a_column = 1;
  const float* b = nullptr;
  std::size_t b_row = 0;
  const float* bias = nullptr;  ///< n values, or nullptr
  bool add = false;             ///< to what C holds
  bool relu = false;
  float* c = nullptr;
  std::size_t c_row = 0;
};

/// Who reads one input of a convolution: `lines` of `across` places, the first of which is `place`
/// and reads it as its number `input`.
struct Readers {
  std::uint32_t place, input;
  std::uint16_t lines, across;
};
/// The places of a layer that reads mostly zeros: those of a convolution, or the one of a dense
/// layer. Rows of weights and of outputs are `row` floats.
struct Window {
  const Readers* readers;     ///< of each input; none: a dense layer
  std::uint32_t right, down;  ///< by how much an input's number is less a place, a line of them on
  std::size_t places, out_width;
  std::size_t row;
};
/// The numbers of a sample that are not 0.
struct Spots {
  const float* x;
  const std::uint32_t* at;  ///< indices into x, ascending
  std::size_t count;
};

/// Rows of a layer normalisation (Ba, Kiros, Hinton 2016, equations 3 and 4): `columns` numbers in
/// rows `row` apart, the rest of which is padding that stays 0.
struct Rows {
  std::size_t rows = 0, columns = 0, row = 0;
};

/// One step of an optimiser over flat arrays (optimiser.hpp says which formula).
struct AdamStep {
  float share1, share2;  ///< 1 - beta, rounded once
  float step, root_scale, epsilon;
};
struct RmsStep {
  float share;  ///< 1 - decay
  float step, epsilon;
  bool centred;
};
struct RpropStep {
  float up, down, largest, smallest;
};

/// The functions, compiled for one instruction set. Arrays of `n` floats: n is a multiple of
/// vector_width. None allocates.
struct Arithmetic {
  std::string_view target;  ///< "AVX-512", "AVX2", "NEON" or "base"
  bool fused;               ///< multiplies and adds with one rounding: the class of its bits

  void (*product)(const Product&);
  /// to[j * to_row + i] = from[i * from_row + j]; rows and columns are multiples of
  /// vector_width.
  void (*transpose)(const float* from, std::size_t rows, std::size_t columns, std::size_t from_row,
                    float* to, std::size_t to_row);
  /// Each x, which is at most 0, becomes e^x.
  void (*exponentials)(float* x, std::size_t n);
  void (*activate)(Activation kind, float* values, std::size_t n);
  /// gradient *= the derivative of the activation, told from its outputs.
  void (*slope)(Activation kind, const float* outputs, float* gradient, std::size_t n);
  /// sums[j] = sum over i of x[i * row + j], for columns that are a multiple of vector_width.
  void (*column_sums)(const float* x, std::size_t rows, std::size_t columns, std::size_t row,
                      float* sums);
  /// x becomes (x - mean) / sqrt(variance + epsilon) of its row, y = x * gain + shift, then as
  /// `relu` of Product says; keeps 1 / sqrt(...) of each row in `scales`.
  void (*normalise)(Rows shape, float epsilon, float* x, const float* gain, const float* shift,
                    bool relu, float* y, float* scales);
  /// The gradient by y in, by x out (in place); adds up those of gain and shift (both written).
  void (*normalise_back)(Rows shape, const float* normalised, const float* scales,
                         const float* gain, float* gradient, float* gain_gradient,
                         float* shift_gradient);
  /// Writes whether x is not 0 as bits, 64 in each word, the lowest first; whether every x is 0 or
  /// 1. n is any number.
  bool (*pack)(const float* x, std::size_t n, std::uint64_t* words);
  /// Writes each of n bits as 0 or 1.
  void (*unpack)(const std::uint64_t* words, std::size_t n, float* x);
  /// Writes where x is not 0, at most `most` of them: how many, or most + 1 if there are more. n is
  /// any number.
  std::size_t (*find_spots)(const float* x, std::size_t n, std::uint32_t* at, std::size_t most);
  /// y = bias + x times weights for one sample, then as `relu` of Product says, with its bits.
  void (*sparse_forward)(const Window& window, const Spots& spots, const float* weights,
                         const float* bias, bool relu, float* y);
  /// by_weights += the gradient by the weights for one sample.
  void (*sparse_back)(const Window& window, const Spots& spots, const float* by_y,
                      float* by_weights);
  double (*sum_of_squares)(const float* x, std::size_t n);
  void (*scale)(float* x, std::size_t n, float factor);
  /// z = decay * z + gradient; the sum of all |z|.
  double (*trace)(float* z, const float* gradient, std::size_t n, float decay);
  /// to += share * (from - to): Polyak averaging.
  void (*blend)(float* to, const float* from, std::size_t n, float share);
  /// out = mean + spread (by factors), or (by factors) spread without a mean; every product and sum
  /// rounded for itself.
  void (*perturb)(const float* mean, const float* spread, float by, const float* factors,
                  std::size_t n, float* out);
  void (*sgd)(float* x, const float* gradient, std::size_t n, float step);
  void (*adam)(float* x, const float* gradient, float* mean, float* square, std::size_t n,
               const AdamStep& how);
  void (*rmsprop)(float* x, const float* gradient, float* mean, float* square, std::size_t n,
                  const RmsStep& how);
  /// Riedmiller, Braun 1993, without taking steps back (iRprop-: Igel, Huesken 2000).
  void (*rprop)(float* x, const float* gradient, float* before, float* steps, std::size_t n,
                const RpropStep& how);
};

/// The one in use; the best the processor has unless use_arithmetic() chose.
const Arithmetic& arithmetic();
/// Those the processor can run, best first.
std::vector<std::string_view> arithmetics();
/// Chooses one of arithmetics(): for tests, and to repeat the bits of another machine. Not while
/// networks are at work. False: no such one.
bool use_arithmetic(std::string_view target);

}  // namespace quoll::nn

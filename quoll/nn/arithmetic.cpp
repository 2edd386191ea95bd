#include "quoll/nn/arithmetic.hpp"

// AVX-512, AVX2 and the base of the compiler's target; nothing between, and no vectors whose width
// is known only when the program runs.
#define HWY_DISABLED_TARGETS \
  (HWY_AVX3_DL | HWY_SSE4 | HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "quoll/nn/arithmetic.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "quoll/nn/bits.inl"
#include "quoll/nn/elementwise.inl"
#include "quoll/nn/normalisation.inl"
#include "quoll/nn/product.inl"
#include "quoll/nn/sparse.inl"
#include "quoll/nn/steps.inl"
#include "quoll/nn/transposition.inl"

HWY_BEFORE_NAMESPACE();
namespace quoll::nn::HWY_NAMESPACE {

const Arithmetic* functions() {
#if HWY_TARGET == HWY_AVX3
  static constexpr std::string_view target_name = "AVX-512";
#elif HWY_TARGET == HWY_AVX2
  static constexpr std::string_view target_name = "AVX2";
#elif HWY_ARCH_ARM
  static constexpr std::string_view target_name = "NEON";
#else
  static constexpr std::string_view target_name = "base";
#endif
  static constexpr bool fused = HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_ARCH_ARM;
  static const Arithmetic arithmetic{.target = target_name,
                                     .fused = fused,
                                     .product = product,
                                     .transpose = transpose,
                                     .exponentials = exponentials,
                                     .activate = activate,
                                     .slope = slope,
                                     .column_sums = column_sums,
                                     .normalise = normalise,
                                     .normalise_back = normalise_back,
                                     .pack = pack,
                                     .unpack = unpack,
                                     .find_spots = find_spots,
                                     .sparse_forward = sparse_forward,
                                     .sparse_back = sparse_back,
                                     .sum_of_squares = sum_of_squares,
                                     .scale = scale,
                                     .trace = trace,
                                     .blend = blend,
                                     .perturb = perturb,
                                     .sgd = sgd,
                                     .adam = adam,
                                     .rmsprop = rmsprop,
                                     .rprop = rprop};
  return &arithmetic;
}

}  // namespace quoll::nn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <atomic>

namespace quoll::nn {
namespace {

// Those that were compiled and that the processor can run, best first.
std::vector<const Arithmetic*> runnable() {
  std::vector<const Arithmetic*> list;
#if HWY_ARCH_X86
  // What Highway asks of the two (hwy/highway.h, HWY_TARGET_STR).
  __builtin_cpu_init();
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
#if (HWY_TARGETS & HWY_AVX3) && HWY_STATIC_TARGET != HWY_AVX3
  if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    list.push_back(N_AVX3::functions());
  }
#endif
#if (HWY_TARGETS & HWY_AVX2) && HWY_STATIC_TARGET != HWY_AVX2
  if (avx2) list.push_back(N_AVX2::functions());
#endif
#endif
  list.push_back(HWY_STATIC_DISPATCH(functions)());
  return list;
}

std::atomic<const Arithmetic*> chosen{nullptr};

}  // namespace

const Arithmetic& arithmetic() {
  const Arithmetic* now = chosen.load(std::memory_order_acquire);
  if (now == nullptr) {
    now = runnable().front();
    chosen.store(now, std::memory_order_release);
  }
  return *now;
}

std::vector<std::string_view> arithmetics() {
  std::vector<std::string_view> names;
  for (const Arithmetic* one : runnable()) names.push_back(one->target);
  return names;
}

bool use_arithmetic(std::string_view target) {
  for (const Arithmetic* one : runnable()) {
    if (one->target != target) continue;
    chosen.store(one, std::memory_order_release);
    return true;
  }
  return false;
}

}  // namespace quoll::nn
#endif

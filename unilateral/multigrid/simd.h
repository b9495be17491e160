// Vectors of 64 bytes: the compiler maps them to what the processor has.
#pragma once

#include <cstdint>
#include <cstring>

#ifdef __AVX512F__
#  include <immintrin.h>
#endif

namespace unilateral
{
  /// 8 doubles or 16 floats with the arithmetic of the built-in vectors of GCC and Clang.
  template <typename Number>
  struct Simd
  {
    typedef Number            Lanes __attribute__((vector_size(64), may_alias));
    static constexpr unsigned width = 64 / sizeof(Number);

    static Lanes load(const Number *const x)
    {
      Lanes lanes;
      std::memcpy(&lanes, x, sizeof(lanes));
      return lanes;
    }

    /// x[index[0]], x[index[1]], ...
    static Lanes gather(const Number *x, const std::uint32_t *index)
    {
#ifdef __AVX512F__
      if constexpr (width == 8)
        return reinterpret_cast<Lanes>(_mm512_i32gather_pd(_mm256_loadu_si256(reinterpret_cast<const __m256i *>(index)), x, 8));
      else
        return reinterpret_cast<Lanes>(_mm512_i32gather_ps(_mm512_loadu_si512(index), x, 4));
#else
      Lanes lanes;
      for (unsigned l = 0; l < width; ++l)
        lanes[l] = x[index[l]];
      return lanes;
#endif
    }
  };
} // namespace unilateral

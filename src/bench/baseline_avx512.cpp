// Compiled for AVX-512 (F, VL, DQ); only processors that have it get here.
#include "bench/baseline_simd.h"

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#include <immintrin.h>

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // GCC 12 warns of its own intrinsics (its bug 105593)
#endif

namespace shoal::bench {

namespace {

struct V512 {
    static constexpr int lanes = 16;
    using Mask = __mmask16;
    __m512 v;

    SHOAL_INLINE friend V512 operator+(V512 a, V512 b) { return {_mm512_add_ps(a.v, b.v)}; }
    SHOAL_INLINE friend V512 operator-(V512 a, V512 b) { return {_mm512_sub_ps(a.v, b.v)}; }
    SHOAL_INLINE friend V512 operator*(V512 a, V512 b) { return {_mm512_mul_ps(a.v, b.v)}; }

    SHOAL_INLINE static V512 broadcast(const float* p) { return {_mm512_set1_ps(*p)}; }
    SHOAL_INLINE static V512 load(const float* p) { return {_mm512_load_ps(p)}; }
    SHOAL_INLINE static void store(float* p, V512 a) { _mm512_store_ps(p, a.v); }
    SHOAL_INLINE static V512 fma(V512 a, V512 b, V512 c) { return {_mm512_fmadd_ps(a.v, b.v, c.v)}; }
    SHOAL_INLINE static V512 fnma(V512 a, V512 b, V512 c) { return {_mm512_fnmadd_ps(a.v, b.v, c.v)}; }
    SHOAL_INLINE static V512 fms(V512 a, V512 b, V512 c) { return {_mm512_fmsub_ps(a.v, b.v, c.v)}; }
    SHOAL_INLINE static V512 minimum(V512 a, V512 b) { return {_mm512_min_ps(a.v, b.v)}; }
    SHOAL_INLINE static V512 maximum(V512 a, V512 b) { return {_mm512_max_ps(a.v, b.v)}; }
    SHOAL_INLINE static V512 absolute(V512 a) { return {_mm512_abs_ps(a.v)}; }
    SHOAL_INLINE static V512 floored(V512 a) { return {_mm512_floor_ps(a.v)}; }
    // An estimate of 14 bits and one step of Newton's: within 1.1 ulp. Root and quotient (1.5 ulp) took as
    // long on the processor that this was measured on, and take longer on others.
    SHOAL_INLINE static V512 inverseRoot(V512 a) {
        const __m512 y = _mm512_rsqrt14_ps(a.v);
        const __m512 rest = _mm512_fnmadd_ps(_mm512_mul_ps(a.v, y), y, _mm512_set1_ps(1));
        return {_mm512_fmadd_ps(_mm512_mul_ps(y, _mm512_set1_ps(0.5f)), rest, y)};
    }
    SHOAL_INLINE static V512 inverse(V512 a) {
        const __m512 y = _mm512_rcp14_ps(a.v);
        return {_mm512_fmadd_ps(y, _mm512_fnmadd_ps(a.v, y, _mm512_set1_ps(1)), y)};
    }

    SHOAL_INLINE static Mask less(V512 a, V512 b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ); }
    SHOAL_INLINE static Mask maskAnd(Mask a, Mask b) { return _kand_mask16(a, b); }
    SHOAL_INLINE static Mask maskOr(Mask a, Mask b) { return _kor_mask16(a, b); }
    SHOAL_INLINE static Mask maskNot(Mask a) { return _knot_mask16(a); }
    SHOAL_INLINE static bool any(Mask a) { return a != 0; }
    SHOAL_INLINE static V512 select(Mask m, V512 a, V512 b) { return {_mm512_mask_blend_ps(m, b.v, a.v)}; }

    SHOAL_INLINE static V512 gather(const float* p, V512 indices) {
        return {_mm512_i32gather_ps(_mm512_cvtps_epi32(indices.v), p, 4)};
    }
    SHOAL_INLINE static void leave() { _mm256_zeroupper(); }
};

constexpr KernelSet kernels = kernelsOf<V512>();

}  // namespace

const KernelSet* const avx512Kernels = &kernels;

}  // namespace shoal::bench

#else

namespace shoal::bench {
const KernelSet* const avx512Kernels = nullptr;
}  // namespace shoal::bench

#endif

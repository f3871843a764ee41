// SPDX-License-Identifier: Apache-2.0
// Compiled for AVX2, without FMA. Nothing here may call an inline function that other files use: the linker keeps one copy of
// each, and it might be the one that only this processor can run.
#include <immintrin.h>

#include <cstddef>
#include <type_traits>

#include "nlgs/packet_sweep.h"

namespace nscdd {
namespace {

constexpr int kLanes = 4;

/// kCount contacts, the bodies that they move, and their impulses. Lanes beyond kCount compute what the last one does, and
/// store nothing.
template <class Row, int kCount>
struct Lanes {
  const Row* row;
  const double* inverse_mass;
  double* velocity;
  double* impulse;

  static constexpr std::ptrdiff_t kDofs = Dofs(Row::kModel), kInertias = Inertias(Row::kModel),
                                  kUnknowns = Unknowns(Row::kModel);
  static constexpr int Lane(int i) { return i < kCount ? i : kCount - 1; }
  const Row& At(int i) const { return row[Lane(i)]; }
  double* VelocityA(int i) const { return velocity + kDofs * std::ptrdiff_t{row[Lane(i)].a}; }
  double* VelocityB(int i) const { return velocity + kDofs * std::ptrdiff_t{row[Lane(i)].b}; }
  const double* InverseA(int i) const { return inverse_mass + kInertias * std::ptrdiff_t{row[Lane(i)].a}; }
  const double* InverseB(int i) const { return inverse_mass + kInertias * std::ptrdiff_t{row[Lane(i)].b}; }
  double* Impulse(int i) const { return impulse + kUnknowns * Lane(i); }
};

/// Lane i of `first` and `second`: the two numbers at p(i).
template <class Pointer>
inline void LoadPairs(Pointer p, __m256d* first, __m256d* second) {
  const __m256d even = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(p(0))), _mm_loadu_pd(p(2)), 1);
  const __m256d odd = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(p(1))), _mm_loadu_pd(p(3)), 1);
  *first = _mm256_unpacklo_pd(even, odd);
  *second = _mm256_unpackhi_pd(even, odd);
}

/// The first kCount lanes.
template <int kCount, class Pointer>
inline void StorePairs(__m256d first, __m256d second, Pointer p) {
  const __m256d even = _mm256_unpacklo_pd(first, second), odd = _mm256_unpackhi_pd(first, second);
  _mm_storeu_pd(p(0), _mm256_castpd256_pd128(even));
  if constexpr (kCount > 1) _mm_storeu_pd(p(1), _mm256_castpd256_pd128(odd));
  if constexpr (kCount > 2) _mm_storeu_pd(p(2), _mm256_extractf128_pd(even, 1));
  if constexpr (kCount > 3) _mm_storeu_pd(p(3), _mm256_extractf128_pd(odd, 1));
}

template <class Pointer>
inline __m256d LoadSingles(Pointer p) {
  const __m128d low = _mm_loadh_pd(_mm_load_sd(p(0)), p(1)), high = _mm_loadh_pd(_mm_load_sd(p(2)), p(3));
  return _mm256_insertf128_pd(_mm256_castpd128_pd256(low), high, 1);
}

template <int kCount, class Pointer>
inline void StoreSingles(__m256d x, Pointer p) {
  const __m128d low = _mm256_castpd256_pd128(x), high = _mm256_extractf128_pd(x, 1);
  _mm_storel_pd(p(0), low);
  if constexpr (kCount > 1) _mm_storeh_pd(p(1), low);
  if constexpr (kCount > 2) _mm_storel_pd(p(2), high);
  if constexpr (kCount > 3) _mm_storeh_pd(p(3), high);
}

inline __m256d Negative(__m256d x) { return _mm256_xor_pd(x, _mm256_set1_pd(-0.0)); }

/// std::max(0, x) and std::min(bound, std::max(-bound, x)), also for equal and unordered numbers.
inline __m256d Positive(__m256d x) { return _mm256_max_pd(x, _mm256_setzero_pd()); }
inline __m256d Clamp(__m256d x, __m256d bound) { return _mm256_min_pd(_mm256_max_pd(x, Negative(bound)), bound); }

/// v - dv and v + dv where the mask is set, v elsewhere, also if it is -0: v - (+0) = v.
inline __m256d Less(__m256d v, __m256d dv, __m256d mask) { return _mm256_sub_pd(v, _mm256_and_pd(mask, dv)); }
inline __m256d Plus(__m256d v, __m256d dv, __m256d mask) { return Less(v, Negative(dv), mask); }

template <int kCount>
[[gnu::always_inline]] inline void Solve(const Lanes<NormalRow, kCount>& c) {
  __m256d vax, vay, vbx, vby, nx, ny, inverse_wnn, offset;
  LoadPairs([&](int i) { return c.VelocityA(i); }, &vax, &vay);
  LoadPairs([&](int i) { return c.VelocityB(i); }, &vbx, &vby);
  LoadPairs([&](int i) { return &c.At(i).n.x; }, &nx, &ny);
  LoadPairs([&](int i) { return &c.At(i).inverse_wnn; }, &inverse_wnn, &offset);
  const __m256d r = LoadSingles([&](int i) { return c.Impulse(i); });

  const __m256d dx = _mm256_sub_pd(vbx, vax), dy = _mm256_sub_pd(vby, vay);
  const __m256d vn = _mm256_add_pd(_mm256_mul_pd(nx, dx), _mm256_mul_pd(ny, dy));
  const __m256d n = Positive(_mm256_sub_pd(r, _mm256_mul_pd(inverse_wnn, _mm256_add_pd(vn, offset))));
  StoreSingles<kCount>(n, [&](int i) { return c.Impulse(i); });

  const __m256d changed = _mm256_cmp_pd(n, r, _CMP_NEQ_UQ), dn = _mm256_sub_pd(n, r);
  const __m256d px = _mm256_mul_pd(nx, dn), py = _mm256_mul_pd(ny, dn);
  const __m256d ma = LoadSingles([&](int i) { return c.InverseA(i); });
  const __m256d mb = LoadSingles([&](int i) { return c.InverseB(i); });
  StorePairs<kCount>(Less(vax, _mm256_mul_pd(ma, px), changed), Less(vay, _mm256_mul_pd(ma, py), changed),
                     [&](int i) { return c.VelocityA(i); });
  StorePairs<kCount>(Plus(vbx, _mm256_mul_pd(mb, px), changed), Plus(vby, _mm256_mul_pd(mb, py), changed),
                     [&](int i) { return c.VelocityB(i); });
}

template <int kCount>
[[gnu::always_inline]] inline void Solve(const Lanes<FrictionRow, kCount>& c) {
  __m256d vax, vay, vbx, vby, nx, ny, ta, tb, inverse_wnn, inverse_wtt, offset, friction, rn, rt;
  LoadPairs([&](int i) { return c.VelocityA(i); }, &vax, &vay);
  LoadPairs([&](int i) { return c.VelocityB(i); }, &vbx, &vby);
  const __m256d wa = LoadSingles([&](int i) { return c.VelocityA(i) + 2; });
  const __m256d wb = LoadSingles([&](int i) { return c.VelocityB(i) + 2; });
  LoadPairs([&](int i) { return &c.At(i).n.x; }, &nx, &ny);
  LoadPairs([&](int i) { return &c.At(i).turn_ta; }, &ta, &tb);
  LoadPairs([&](int i) { return &c.At(i).inverse_wnn; }, &inverse_wnn, &inverse_wtt);
  LoadPairs([&](int i) { return &c.At(i).offset; }, &offset, &friction);
  LoadPairs([&](int i) { return c.Impulse(i); }, &rn, &rt);

  const __m256d dx = _mm256_sub_pd(vbx, vax), dy = _mm256_sub_pd(vby, vay);
  const __m256d vn = _mm256_add_pd(_mm256_mul_pd(nx, dx), _mm256_mul_pd(ny, dy));
  const __m256d slip = _mm256_sub_pd(_mm256_mul_pd(ny, dx), _mm256_mul_pd(nx, dy));
  const __m256d vt = _mm256_sub_pd(_mm256_add_pd(slip, _mm256_mul_pd(tb, wb)), _mm256_mul_pd(ta, wa));
  const __m256d n = Positive(_mm256_sub_pd(rn, _mm256_mul_pd(inverse_wnn, _mm256_add_pd(vn, offset))));
  const __m256d t = Clamp(_mm256_sub_pd(rt, _mm256_mul_pd(inverse_wtt, vt)), _mm256_mul_pd(friction, n));
  StorePairs<kCount>(n, t, [&](int i) { return c.Impulse(i); });

  const __m256d changed = _mm256_or_pd(_mm256_cmp_pd(n, rn, _CMP_NEQ_UQ), _mm256_cmp_pd(t, rt, _CMP_NEQ_UQ));
  const __m256d dn = _mm256_sub_pd(n, rn), dt = _mm256_sub_pd(t, rt);
  const __m256d px = _mm256_add_pd(_mm256_mul_pd(nx, dn), _mm256_mul_pd(ny, dt));
  const __m256d py = _mm256_sub_pd(_mm256_mul_pd(ny, dn), _mm256_mul_pd(nx, dt));
  __m256d ma, ja, mb, jb;
  LoadPairs([&](int i) { return c.InverseA(i); }, &ma, &ja);
  LoadPairs([&](int i) { return c.InverseB(i); }, &mb, &jb);
  StorePairs<kCount>(Less(vax, _mm256_mul_pd(ma, px), changed), Less(vay, _mm256_mul_pd(ma, py), changed),
                     [&](int i) { return c.VelocityA(i); });
  StoreSingles<kCount>(Less(wa, _mm256_mul_pd(ja, _mm256_mul_pd(ta, dt)), changed), [&](int i) { return c.VelocityA(i) + 2; });
  StorePairs<kCount>(Plus(vbx, _mm256_mul_pd(mb, px), changed), Plus(vby, _mm256_mul_pd(mb, py), changed),
                     [&](int i) { return c.VelocityB(i); });
  StoreSingles<kCount>(Plus(wb, _mm256_mul_pd(jb, _mm256_mul_pd(tb, dt)), changed), [&](int i) { return c.VelocityB(i) + 2; });
}

template <class Row>
inline void SweepAll(const Row* rows, const std::int32_t* begin, std::size_t packets, const double* inverse_mass,
                     double* velocity, double* impulse) {
  for (std::size_t p = 0; p < packets; ++p) {
    std::int32_t k = begin[p];
    const std::int32_t end = begin[p + 1];
    const auto solve = [&]<int kCount>(std::integral_constant<int, kCount>) {
      double* r = impulse + Unknowns(Row::kModel) * std::ptrdiff_t{k};
      Solve(Lanes<Row, kCount>{rows + k, inverse_mass, velocity, r});
    };
    for (; k + kLanes <= end; k += kLanes) solve(std::integral_constant<int, 4>{});
    if (end - k == 3) solve(std::integral_constant<int, 3>{});
    if (end - k == 2) solve(std::integral_constant<int, 2>{});
    if (end - k == 1) solve(std::integral_constant<int, 1>{});
  }
}

}  // namespace

void SweepPacketsAvx2(const NormalRow* rows, const std::int32_t* begin, std::size_t packets, const double* inverse_mass,
                      double* velocity, double* impulse) {
  SweepAll(rows, begin, packets, inverse_mass, velocity, impulse);
}

void SweepPacketsAvx2(const FrictionRow* rows, const std::int32_t* begin, std::size_t packets, const double* inverse_mass,
                      double* velocity, double* impulse) {
  SweepAll(rows, begin, packets, inverse_mass, velocity, impulse);
}

}  // namespace nscdd

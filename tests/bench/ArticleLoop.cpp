// Eight pixels per step, the formulas of effects/ssao-article.effect, positions gathered from RGBA floats. What a
// person would do by hand is done: matrices multiplied once, constants divided once, tiles that stay in the cache.
// Frozen: BenchTest.cpp knows this text's hash, so that the yardstick cannot drift.
#include "ArticleLoop.h"

#include <algorithm>
#include <array>
#include <cassert>

#if defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>
#endif

namespace crevice::bench {

#if defined(__AVX2__) && defined(__FMA__)

namespace {

using Lanes = __m256;

Lanes all(float value) { return _mm256_set1_ps(value); }
Lanes fma(Lanes a, Lanes b, Lanes c) { return _mm256_fmadd_ps(a, b, c); }

struct Lanes3 {
    Lanes x, y, z;
};

Lanes dot(const Lanes3& a, const Lanes3& b) { return fma(a.x, b.x, fma(a.y, b.y, _mm256_mul_ps(a.z, b.z))); }

/// a * scale + b
Lanes3 fma(const Lanes3& a, Lanes scale, const Lanes3& b) {
    return {fma(a.x, scale, b.x), fma(a.y, scale, b.y), fma(a.z, scale, b.z)};
}

Lanes3 cross(const Lanes3& a, const Lanes3& b) {
    return {_mm256_fmsub_ps(a.y, b.z, _mm256_mul_ps(a.z, b.y)), _mm256_fmsub_ps(a.z, b.x, _mm256_mul_ps(a.x, b.z)),
            _mm256_fmsub_ps(a.x, b.y, _mm256_mul_ps(a.y, b.x))};
}

Lanes floorLanes(Lanes x) { return _mm256_round_ps(x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC); }
Lanes fract(Lanes x) { return _mm256_sub_ps(x, floorLanes(x)); }

/// Sine: reduced to [-pi/2, pi/2] with pi in three parts, then its Taylor series up to x^11.
Lanes sine(Lanes x) {
    const Lanes turns =
        _mm256_round_ps(_mm256_mul_ps(x, all(0.318309886f)), _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
    Lanes r = _mm256_fnmadd_ps(turns, all(3.140625f), x);
    r = _mm256_fnmadd_ps(turns, all(9.67502593994e-4f), r);
    r = _mm256_fnmadd_ps(turns, all(1.50995799097e-7f), r);
    const Lanes r2 = _mm256_mul_ps(r, r);
    Lanes p = all(-2.50521084e-8f);
    p = fma(p, r2, all(2.75573192e-6f));
    p = fma(p, r2, all(-1.98412698e-4f));
    p = fma(p, r2, all(8.33333333e-3f));
    p = fma(p, r2, all(-1.66666667e-1f));
    p = fma(_mm256_mul_ps(p, r2), r, r);
    const __m256i odd = _mm256_slli_epi32(_mm256_cvtps_epi32(turns), 31);
    return _mm256_xor_ps(p, _mm256_castsi256_ps(odd));
}

/// The shader's random(): fract(sin(dot(uv, (12.9898, 78.233))) * 43758.5453).
Lanes hashOf(Lanes u, Lanes v) {
    // Not fused: the low bits of the angle decide, and the software driver does not fuse either.
    const Lanes angle = _mm256_add_ps(_mm256_mul_ps(u, all(12.9898f)), _mm256_mul_ps(v, all(78.233f)));
    return fract(_mm256_mul_ps(sine(angle), all(43758.5453f)));
}

/// (1, 0, 0) where the vector is zero.
Lanes3 safeNormalize(const Lanes3& v) {
    const Lanes squared = dot(v, v);
    const Lanes some = _mm256_cmp_ps(squared, _mm256_setzero_ps(), _CMP_GT_OQ);
    const Lanes scale = _mm256_div_ps(all(1), _mm256_sqrt_ps(squared));
    return {_mm256_blendv_ps(all(1), _mm256_mul_ps(v.x, scale), some), _mm256_and_ps(_mm256_mul_ps(v.y, scale), some),
            _mm256_and_ps(_mm256_mul_ps(v.z, scale), some)};
}

/// A row of a matrix, ready for points (w = 1).
struct Row {
    Lanes x, y, z, w;

    Row(const glm::mat4& m, int i, float scale = 1)
        : x(all(m[0][i] * scale)), y(all(m[1][i] * scale)), z(all(m[2][i] * scale)), w(all(m[3][i] * scale)) {}
    Lanes operator()(const Lanes3& p) const { return fma(x, p.x, fma(y, p.y, fma(z, p.z, w))); }
};

/// xyz of eight pixels; `index` counts pixels. Eight loads and a transposition beat the gather instruction.
[[gnu::always_inline]] inline Lanes3 gather(std::span<const glm::vec4> image, __m256i index) {
    alignas(32) std::uint32_t at[8];
    _mm256_store_si256(reinterpret_cast<__m256i*>(at), index);
    const auto pair = [&](int i) {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(&image[at[i]].x)),
                                    _mm_loadu_ps(&image[at[i + 4]].x), 1);
    };
    const Lanes a = pair(0), b = pair(1), c = pair(2), d = pair(3);
    const Lanes xyAb = _mm256_unpacklo_ps(a, b), xyCd = _mm256_unpacklo_ps(c, d);
    const Lanes zwAb = _mm256_unpackhi_ps(a, b), zwCd = _mm256_unpackhi_ps(c, d);
    return {_mm256_shuffle_ps(xyAb, xyCd, 0x44), _mm256_shuffle_ps(xyAb, xyCd, 0xee),
            _mm256_shuffle_ps(zwAb, zwCd, 0x44)};
}

/// Texel of a coordinate in 0..1 under nearest sampling with clamping, as a float.
Lanes texel(Lanes coordinate, std::uint32_t size) {
    const Lanes t = floorLanes(_mm256_mul_ps(coordinate, all(static_cast<float>(size))));
    return _mm256_min_ps(_mm256_max_ps(t, _mm256_setzero_ps()), all(static_cast<float>(size - 1)));
}

Lanes smoothstep01(Lanes x) {
    const Lanes t = _mm256_min_ps(_mm256_max_ps(x, _mm256_setzero_ps()), all(1));
    return _mm256_mul_ps(_mm256_mul_ps(t, t), _mm256_fnmadd_ps(all(2), t, all(3)));
}

/// What is the same for every pixel.
struct Frame {
    const ArticleInput& in;
    Row clipX, clipY, clipW;
    Row depth;  ///< View depth divided by far.
    Lanes radius = all(in.radius);

    explicit Frame(const ArticleInput& input)
        : in(input),
          clipX(in.projection * in.view, 0),
          clipY(in.projection * in.view, 1),
          clipW(in.projection * in.view, 3),
          depth(in.view, 2, -1.0f / in.far) {}
};

/// What eight pixels take their samples around: a block of four by two.
struct Surface {
    Lanes3 position, normal, tangent, bitangent;
    Lanes depth;
};

Surface surfaceAt(const Frame& frame, std::uint32_t x, std::uint32_t y) {
    const ArticleInput& in = frame.in;
    const Lanes column = _mm256_add_ps(all(static_cast<float>(x)), _mm256_setr_ps(0, 1, 2, 3, 0, 1, 2, 3));
    const Lanes line = _mm256_add_ps(all(static_cast<float>(y)), _mm256_setr_ps(0, 0, 0, 0, 1, 1, 1, 1));
    const Lanes width = all(static_cast<float>(in.width)), height = all(static_cast<float>(in.height));
    const __m256i index = _mm256_cvtps_epi32(fma(line, width, column));
    const Lanes u = _mm256_div_ps(_mm256_add_ps(column, all(0.5f)), width);
    const Lanes v = _mm256_div_ps(_mm256_add_ps(line, all(0.5f)), height);
    Surface s;
    s.position = gather(in.positions, index);
    s.normal = gather(in.normals, index);
    const Lanes3 random{_mm256_fmsub_ps(hashOf(u, _mm256_add_ps(v, all(1))), all(2), all(1)),
                        _mm256_fmsub_ps(hashOf(_mm256_add_ps(u, all(1)), v), all(2), all(1)), _mm256_setzero_ps()};
    const Lanes along = dot(random, s.normal);
    s.tangent =
        safeNormalize({_mm256_fnmadd_ps(s.normal.x, along, random.x), _mm256_fnmadd_ps(s.normal.y, along, random.y),
                       _mm256_fnmadd_ps(s.normal.z, along, random.z)});
    s.bitangent = cross(s.normal, s.tangent);
    s.depth = frame.depth(s.position);
    return s;
}

/// Where a sample of each of the eight pixels falls.
struct Sample {
    __m256i pixel;
    Lanes depth;    ///< Of the sample itself.
    Lanes inFront;  ///< Mask: in front of the camera.
};

Sample sampleOf(const Frame& frame, const Surface& s, const glm::vec4& k) {
    const Lanes3 along{_mm256_mul_ps(s.normal.x, all(k.z)), _mm256_mul_ps(s.normal.y, all(k.z)),
                       _mm256_mul_ps(s.normal.z, all(k.z))};
    const Lanes3 offset = fma(s.tangent, all(k.x), fma(s.bitangent, all(k.y), along));
    const Lanes3 world = fma(offset, frame.radius, s.position);
    const Lanes clipW = frame.clipW(world);
    const Lanes half = _mm256_div_ps(all(0.5f), clipW);
    const Lanes column = texel(fma(frame.clipX(world), half, all(0.5f)), frame.in.width);
    const Lanes line = texel(fma(frame.clipY(world), half, all(0.5f)), frame.in.height);
    return {_mm256_cvtps_epi32(fma(line, all(static_cast<float>(frame.in.width)), column)), frame.depth(world),
            _mm256_cmp_ps(clipW, _mm256_setzero_ps(), _CMP_GT_OQ)};
}

/// What a sample adds to the occlusion of its pixel.
Lanes occlusionOf(const Frame& frame, const Surface& s, const Sample& sample) {
    const Lanes stored = frame.depth(gather(frame.in.positions, sample.pixel));
    const Lanes apart = _mm256_andnot_ps(all(-0.0f), _mm256_sub_ps(s.depth, stored));
    const Lanes range = smoothstep01(_mm256_div_ps(frame.radius, _mm256_max_ps(apart, all(1e-9f))));
    return _mm256_and_ps(range, _mm256_and_ps(_mm256_cmp_ps(stored, sample.depth, _CMP_LE_OQ), sample.inFront));
}

/// The block's bytes into two rows of the picture.
void store(Lanes openness, std::uint8_t* out, std::uint32_t stride) {
    const Lanes clamped = _mm256_min_ps(_mm256_max_ps(openness, _mm256_setzero_ps()), all(1));
    alignas(32) int bytes[8];
    _mm256_store_si256(reinterpret_cast<__m256i*>(bytes), _mm256_cvtps_epi32(_mm256_mul_ps(clamped, all(255))));
    for (int i = 0; i < 8; ++i) out[std::size_t(i / 4) * stride + i % 4] = static_cast<std::uint8_t>(bytes[i]);
}

constexpr std::uint32_t kTile = 64;
constexpr std::size_t kMaxSamples = 64;

void occludeTile(const Frame& frame, std::uint32_t left, std::uint32_t top, std::span<std::uint8_t> result) {
    const ArticleInput& in = frame.in;
    const Lanes share = all(1.0f / static_cast<float>(in.kernel.size()));
    std::array<Sample, kMaxSamples> samples;
    for (std::uint32_t y = top; y < std::min(top + kTile, in.height); y += 2) {
        for (std::uint32_t x = left; x < std::min(left + kTile, in.width); x += 4) {
            const Surface surface = surfaceAt(frame, x, y);
            // First all places, then all look-ups: many loads are on their way at once.
            for (std::size_t i = 0; i < in.kernel.size(); ++i) samples[i] = sampleOf(frame, surface, in.kernel[i]);
            Lanes occlusion = _mm256_setzero_ps();
            for (std::size_t i = 0; i < in.kernel.size(); ++i)
                occlusion = _mm256_add_ps(occlusion, occlusionOf(frame, surface, samples[i]));
            store(_mm256_fnmadd_ps(occlusion, share, all(1)), &result[std::size_t(y) * in.width + x], in.width);
        }
    }
}

}  // namespace

bool hasArticleLoop() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }

std::vector<std::uint8_t> articleLoop(const ArticleInput& in) {
    assert(in.width % 4 == 0 && in.height % 2 == 0 && in.kernel.size() <= kMaxSamples);
    std::vector<std::uint8_t> result(std::size_t(in.width) * in.height);
    const Frame frame(in);
    for (std::uint32_t y = 0; y < in.height; y += kTile) {
        for (std::uint32_t x = 0; x < in.width; x += kTile) occludeTile(frame, x, y, result);
    }
    return result;
}

#else

bool hasArticleLoop() { return false; }

std::vector<std::uint8_t> articleLoop(const ArticleInput&) {
    assert(false && "ask hasArticleLoop() first");
    return {};
}

#endif

}  // namespace crevice::bench

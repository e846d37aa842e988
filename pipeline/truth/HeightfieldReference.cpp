// Slices through the view ray as in GTAO (Jimenez et al. 2016), each a fan of directions that columns of the depth
// buffer close, weighted by |sin h| cos(h - gamma) and by the slice's Jacobian v_z/|o|² (screen angle to azimuth).
#include "truth/HeightfieldReference.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <string>
#include <thread>

#include <glm/gtc/constants.hpp>

#include "truth/DepthSurface.h"
#include "truth/DirectionFan.h"
#include "truth/Sampling.h"
#include "truth/TruthCache.h"

namespace crevice {
namespace {

constexpr float kNearest = 0.25f;      // pixels; nearer, rounding would tilt the point's own surface
constexpr float kLargestAngle = 1.5f;  // between the ray to the point and the last one looked at, radians

/// A plane through the view ray: x along `across`, y towards the viewer, the point at the origin.
struct Slice {
    glm::vec3 across{0};  ///< View space, unit length.
    glm::vec2 pixels{0};  ///< Unit step on the screen.
    float jacobian = 1;
    float gamma = 0, length = 1;  ///< Of the projected normal: angle from the view ray towards `across`, and length.
};

struct Point {
    glm::vec2 pixel{0};
    glm::vec3 position{0}, normal{0}, toViewer{0};  ///< View space.
    float distance = 0;                             ///< To the camera; 0 = orthographic.
};

Slice makeSlice(const Point& point, float angle) {
    const glm::vec3 screen(std::cos(angle), std::sin(angle), 0);
    const glm::vec3 across = screen - glm::dot(screen, point.toViewer) * point.toViewer;
    const float squared = glm::dot(across, across);
    Slice slice;
    slice.across = across / std::sqrt(squared);
    slice.pixels = {screen.x, -screen.y};
    slice.jacobian = point.toViewer.z / squared;
    const glm::vec2 normal(glm::dot(point.normal, slice.across), glm::dot(point.normal, point.toViewer));
    slice.length = glm::length(normal);
    slice.gamma = std::atan2(normal.x, normal.y);
    return slice;
}

/// How far, in pixels, view rays come within the radius on that side, and are on the screen.
float reachPixels(const DepthSurface& surface, const Point& point, const Slice& slice, float side, float radius) {
    const glm::vec2 step = side * slice.pixels;
    float reach = surface.pixelsToBorder(point.pixel, step);
    if (point.distance <= 0) return std::min(reach, radius * surface.pixelsPerUnit());
    const float angle =
        radius < point.distance ? std::min(std::asin(radius / point.distance), kLargestAngle) : kLargestAngle;
    const glm::vec3 last = -std::cos(angle) * point.toViewer + side * std::sin(angle) * slice.across;
    if (last.z >= -1e-4f) return reach;
    return std::min(reach, glm::length(surface.project(last) - point.pixel));
}

class Tracer {
public:
    Tracer(const DepthSurface& surface, const HeightfieldSettings& settings) : surface_(surface), settings_(settings) {}

    float openness(const Point& point, std::uint32_t seed) {
        double open = 0, whole = 0;
        const glm::vec2 jitter = scrambledSobol(0, seed);
        for (std::uint32_t i = 0; i < settings_.slices; ++i) {
            const float turn = (static_cast<float>(i) + jitter.x) / static_cast<float>(settings_.slices);
            const Slice slice = makeSlice(point, glm::pi<float>() * turn);
            const glm::vec2 dither = scrambledSobol(i + 1, seed);
            fan_.clear(dither.x);
            march(point, slice, 1, dither.y);
            march(point, slice, -1, dither.y);
            const auto weight = static_cast<double>(slice.jacobian * slice.length);
            const DirectionFan::Shares shares = fan_.measure(slice.gamma);
            open += weight * shares.open;
            whole += weight * shares.whole;
        }
        return whole > 0 ? static_cast<float>(open / whole) : 1.0f;
    }

private:
    /// What a sample hides, in the slice's plane: the directions between two places of the fan.
    struct Column {
        bool closes = false;
        bool isNear = false;   ///< The surface is inside the ball.
        bool isBelow = false;  ///< Below the point's plane, however thick: only what joins it can rise above.
        glm::vec2 surface{0};
        float low = 0, high = 0;
        DepthSurface::Sample sample;

        void hide(const glm::vec2& a, const glm::vec2& b) {
            const float placeA = DirectionFan::place(a), placeB = DirectionFan::place(b);
            closes = true;
            low = std::min(placeA, placeB);
            high = std::max(placeA, placeB);
        }
    };

    /// One side of a slice.
    struct Side {
        float sign;
        glm::vec2 step, home;  ///< On the screen; of the camera (or the plane of depth 0) in the slice.
        glm::vec2 normal;      ///< Of the point, projected, in the slice.
        float horizon;         ///< Place of the point's own plane in the fan.
        DepthSurface::Line line;
    };

    Side makeSide(const Point& point, const Slice& slice, float sign) const {
        const float plane = std::clamp(sign * slice.gamma + glm::half_pi<float>(), 0.0f, glm::pi<float>());
        const glm::vec2 step = sign * slice.pixels;
        return {.sign = sign,
                .step = step,
                .home = {0, point.distance > 0 ? point.distance : -point.position.z},
                .normal = {std::sin(slice.gamma), std::cos(slice.gamma)},
                .horizon = DirectionFan::place({std::sin(plane), std::cos(plane)}),
                .line = surface_.lineThrough(point.pixel, step, slice.across, point.toViewer)};
    }

    void march(const Point& point, const Slice& slice, float sign, float jitter) {
        const float reach = reachPixels(surface_, point, slice, sign, settings_.radius);
        const float count = std::clamp(std::ceil(reach), 1.0f, static_cast<float>(settings_.steps));
        // One step a pixel, or, where that is too many, that long at first and growing evenly.
        const float even = std::min(1.0f, count / reach);
        const Side side = makeSide(point, slice, sign);
        Column last;
        for (float k = jitter; k < count + 1; k += 1) {
            const float share = std::min(k / count, 1.0f);
            const float pixels = reach * share * (even + (1 - even) * share);
            if (pixels < kNearest) continue;
            const Column column = lookAt(point, side, pixels);
            if (column.closes || last.closes) close(side.sign, column, last);
            last = column;
        }
    }

    Column lookAt(const Point& point, const Side& side, float pixels) const {
        Column column;
        column.sample = surface_.at(point.pixel + pixels * side.step);
        if (!column.sample.texel) return column;
        const glm::vec2 direction = side.line.direction + pixels * side.line.directionStep;
        column.surface = side.home + pixels * side.line.originStep + column.sample.depth * direction;
        column.isNear = glm::dot(column.surface, column.surface) < settings_.radius * settings_.radius;
        if (glm::dot(column.surface, side.normal) <= 0 && glm::dot(direction, side.normal) <= 0) {
            column.isBelow = true;
            column.closes = column.isNear;
            column.low = column.high = side.horizon;
        } else {
            limit(column, direction);
        }
        return column;
    }

    /// The part of surface + t·direction, 0 ≤ t ≤ thickness, inside the ball.
    void limit(Column& column, const glm::vec2& direction) const {
        const float radius = settings_.radius, room = radius * radius - glm::dot(column.surface, column.surface);
        if (std::isinf(settings_.thickness)) {
            if (column.isNear) column.hide(column.surface, {0, -radius});
            return;
        }
        const glm::vec2 away = direction / std::sqrt(glm::dot(direction, direction));
        const float half = glm::dot(column.surface, away);
        const float squared = half * half + room;
        if (squared <= 0) return;
        const float root = std::sqrt(squared);
        const float from = std::max(0.0f, -half - root), to = std::min(settings_.thickness * radius, root - half);
        if (to > from) column.hide(column.surface + from * away, column.surface + to * away);
    }

    void close(float side, const Column& column, const Column& last) {
        if (column.isBelow && last.isBelow) return;
        const Column& one = column.closes ? column : last;
        float low = one.low, high = one.high;
        // One surface: what lies between the samples is solid too, up to where it leaves the ball.
        if (surface_.isContinuous(last.sample, column.sample)) {
            if (column.closes && last.closes) {
                low = std::min(low, last.low);
                high = std::max(high, last.high);
            }
            if (column.isNear != last.isNear) {
                const float border = DirectionFan::place(column.isNear ? borderBetween(column.surface, last.surface)
                                                                       : borderBetween(last.surface, column.surface));
                low = std::min(low, border);
                high = std::max(high, border);
            }
        }
        fan_.close(side, low, high);
    }

    /// Where the line from a point inside the ball to one outside leaves it.
    glm::vec2 borderBetween(const glm::vec2& inside, const glm::vec2& outside) const {
        const glm::vec2 way = outside - inside;
        const float squared = glm::dot(way, way), half = glm::dot(inside, way);
        const float room = settings_.radius * settings_.radius - glm::dot(inside, inside);
        const float share = (std::sqrt(half * half + squared * room) - half) / squared;
        return inside + std::clamp(share, 0.0f, 1.0f) * way;
    }

    const DepthSurface& surface_;
    const HeightfieldSettings& settings_;
    DirectionFan fan_;
};

void traceRows(const HeightfieldInput& input, const HeightfieldSettings& settings, std::vector<float>& map) {
    const glm::uvec2 size = input.size;
    const DepthSurface surface(input);
    const glm::mat3 toView(input.camera.view);
    std::atomic<std::uint32_t> nextRow{0};
    const auto work = [&](bool reports) {
        Tracer tracer(surface, settings);
        for (std::uint32_t y = nextRow++; y < size.y; y = nextRow++) {
            if (reports && settings.progress) settings.progress(static_cast<float>(y) / static_cast<float>(size.y));
            for (std::uint32_t x = 0; x < size.x; ++x) {
                const std::size_t i = std::size_t(y) * size.x + x;
                if (surface.isSky(i) || (!input.isCounted.empty() && !input.isCounted[i])) continue;
                Point point;
                point.pixel = glm::vec2(x, y) + 0.5f;
                point.position = surface.position(point.pixel, input.viewDepth[i]);
                point.normal = toView * input.normal[i];
                point.distance = input.camera.orthographic ? 0 : glm::length(point.position);
                point.toViewer = input.camera.orthographic ? glm::vec3(0, 0, 1) : -point.position / point.distance;
                map[i] = tracer.openness(point, hashWithSeed(static_cast<std::uint32_t>(i), settings.seed));
            }
        }
    };
    const unsigned threads = settings.threads ? settings.threads : std::max(1u, std::thread::hardware_concurrency());
    {
        std::vector<std::jthread> helpers;
        for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(work, false);
        work(true);
    }
}

}  // namespace

std::vector<float> traceHeightfield(const HeightfieldInput& input, const HeightfieldSettings& settings) {
    assert(input.viewDepth.size() == std::size_t(input.size.x) * input.size.y);
    assert(input.normal.size() == input.viewDepth.size() && settings.radius > 0 && settings.thickness > 0);
    std::vector<float> map(input.viewDepth.size(), 1.0f);
    const std::string key = settings.cache ? heightfieldKey(input, settings) : std::string();
    if (settings.cache && loadHeightfield(*settings.cache, key, map)) return map;
    traceRows(input, settings, map);
    if (settings.cache) storeHeightfield(*settings.cache, key, map);
    return map;
}

}  // namespace crevice

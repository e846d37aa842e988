// Spheres into boxes: lights are entered into every cell that their range touches.
#include "flow/LightGrid.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "flow/ShadowView.h"

namespace crevice {
namespace {

constexpr float kPi = 3.14159265358979f;
constexpr float kLeastStep = 0.5f / 255.0f / 12.92f;  // half a step where sRGB is linear (IEC 61966-2-1)
constexpr std::size_t kCellsPerLight = 64;
constexpr std::size_t kMostCells = 1 << 16;
constexpr std::size_t kMostEntries = 1 << 21;
constexpr float kSlack = 0.01f;  // of a cell: positions in shaders are rounded

/// A light with an end, by its place in CCPunctualLights.
struct Sphere {
    std::uint32_t light = 0;
    glm::vec3 centre{0};
    float radius = 0;

    glm::vec3 low() const { return centre - radius; }
    glm::vec3 high() const { return centre + radius; }
};

struct Cells {
    glm::uvec3 first{0}, last{0};  ///< Inclusive.
};

bool reachesAll(const Sphere& sphere, const Aabb& bounds) {
    const glm::vec3 farthest = glm::max(glm::abs(bounds.min - sphere.centre), glm::abs(bounds.max - sphere.centre));
    return !(glm::length(farthest) > sphere.radius);
}

// Lights that end go into `spheres`, the others into `everywhere`.
void sortLights(const Scene& scene, const Aabb& bounds, float exposure, std::vector<Sphere>& spheres,
                std::vector<std::uint32_t>& everywhere) {
    const Light* main = mainLight(scene);
    const auto endless =
        static_cast<std::size_t>(std::count_if(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
            return light.type != LightType::Directional && !(light.range > 0);
        }));
    std::uint32_t index = 0;
    for (const Light& light : scene.lights) {
        if (&light == main) continue;
        Sphere sphere{index++, light.position, light.range};
        if (!(light.range > 0)) sphere.radius = negligibleDistance(light, exposure, endless);
        const bool ends = light.type != LightType::Directional && std::isfinite(sphere.radius);
        if (!ends || reachesAll(sphere, bounds))
            everywhere.push_back(sphere.light);
        else
            spheres.push_back(sphere);
    }
}

glm::uvec3 sizeFor(const glm::vec3& extent, std::size_t cells) {
    const float edge = std::cbrt(extent.x * extent.y * extent.z / static_cast<float>(cells));
    return glm::uvec3(glm::clamp(glm::ceil(extent / edge), glm::vec3(1), glm::vec3(128)));
}

// Where lights end within the bounds, and cells about as large as the number of lights is worth.
void layOut(LightGrid& grid, const std::vector<Sphere>& spheres, const Aabb& bounds, std::size_t cells) {
    Aabb lit;
    for (const Sphere& sphere : spheres) {
        lit.add(sphere.low());
        lit.add(sphere.high());
    }
    if (!bounds.empty) {
        lit.min = glm::min(glm::max(lit.min, bounds.min), bounds.max);
        lit.max = glm::max(glm::min(lit.max, bounds.max), bounds.min);
    }
    // Something to divide by, and surfaces on the very rim inside.
    const float margin = std::max(1e-3f * lit.diagonal(), 1e-6f);
    lit.min -= margin;
    lit.max += margin;
    const glm::vec3 extent = lit.max - lit.min;
    grid.origin = lit.min;
    grid.size = sizeFor(extent, cells);
    grid.cellsPerUnit = glm::vec3(grid.size) / extent;
}

// The cells that a sphere's box touches; nothing when it lies outside.
bool cellsOf(const LightGrid& grid, const Sphere& sphere, Cells& cells) {
    const glm::vec3 low = (sphere.low() - grid.origin) * grid.cellsPerUnit - kSlack;
    const glm::vec3 high = (sphere.high() - grid.origin) * grid.cellsPerUnit + kSlack;
    const glm::vec3 size(grid.size);
    if (glm::any(glm::lessThan(high, glm::vec3(0))) || glm::any(glm::greaterThanEqual(low, size))) return false;
    cells.first = glm::uvec3(glm::clamp(glm::floor(low), glm::vec3(0), size - 1.0f));
    cells.last = glm::uvec3(glm::clamp(glm::floor(high), glm::vec3(0), size - 1.0f));
    return true;
}

std::size_t entryLimit(const LightGrid& grid, const std::vector<Sphere>& spheres) {
    std::size_t entries = 0;
    for (const Sphere& sphere : spheres) {
        Cells cells;
        if (!cellsOf(grid, sphere, cells)) continue;
        const glm::uvec3 count = cells.last - cells.first + 1u;
        entries += std::size_t(count.x) * count.y * count.z;
    }
    return entries;
}

// Does the sphere touch the cell, a hair larger than it is? J. Arvo, "A Simple Method for Box-Sphere Intersection
// Testing" (Graphics Gems, 1990).
bool touches(const LightGrid& grid, const Sphere& sphere, const glm::uvec3& cell) {
    const glm::vec3 low = grid.origin + (glm::vec3(cell) - kSlack) / grid.cellsPerUnit;
    const glm::vec3 high = grid.origin + (glm::vec3(cell) + 1.0f + kSlack) / grid.cellsPerUnit;
    const glm::vec3 offset = sphere.centre - glm::clamp(sphere.centre, low, high);
    return glm::dot(offset, offset) <= sphere.radius * sphere.radius;
}

/// Calls visit(cell number, light) for every light of every cell, lights in their order.
template <class Visit>
void visitEntries(const LightGrid& grid, const std::vector<Sphere>& spheres, Visit visit) {
    for (const Sphere& sphere : spheres) {
        Cells cells;
        if (!cellsOf(grid, sphere, cells)) continue;
        for (std::uint32_t z = cells.first.z; z <= cells.last.z; ++z)
            for (std::uint32_t y = cells.first.y; y <= cells.last.y; ++y)
                for (std::uint32_t x = cells.first.x; x <= cells.last.x; ++x)
                    if (touches(grid, sphere, {x, y, z}))
                        visit(std::size_t(x) + grid.size.x * (y + std::size_t(grid.size.y) * z), sphere.light);
    }
}

void fillLists(LightGrid& grid, const std::vector<Sphere>& spheres, const std::vector<std::uint32_t>& everywhere) {
    const std::size_t cells = std::size_t(grid.size.x) * grid.size.y * grid.size.z;
    std::vector<std::uint32_t> counts(cells, 0);
    visitEntries(grid, spheres, [&](std::size_t cell, std::uint32_t) { ++counts[cell]; });
    grid.everywhere = static_cast<std::uint32_t>(everywhere.size());
    grid.words.assign(cells + 1, 0);
    auto place = static_cast<std::uint32_t>(cells + 1 + everywhere.size());
    for (std::size_t cell = 0; cell < cells; ++cell) {
        grid.words[cell] = place;
        place += counts[cell];
        counts[cell] = grid.words[cell];  // from now on where the next light goes
    }
    grid.words[cells] = place;
    grid.words.insert(grid.words.end(), everywhere.begin(), everywhere.end());
    grid.words.resize(place);
    visitEntries(grid, spheres, [&](std::size_t cell, std::uint32_t light) { grid.words[counts[cell]++] = light; });
}

}  // namespace

float negligibleDistance(const Light& light, float exposure, std::size_t count) {
    const float brightest = std::max({light.color.r, light.color.g, light.color.b, 0.0f}) * light.intensity;
    return std::sqrt(brightest * exposure * static_cast<float>(std::max<std::size_t>(count, 1)) / (kPi * kLeastStep));
}

LightGrid makeLightGrid(const Scene& scene, const Aabb& bounds, float exposure) {
    std::vector<Sphere> spheres;
    std::vector<std::uint32_t> everywhere;
    sortLights(scene, bounds, exposure, spheres, everywhere);
    LightGrid grid;
    if (!spheres.empty()) {
        std::size_t cells = std::min(kMostCells, kCellsPerLight * spheres.size());
        layOut(grid, spheres, bounds, cells);
        while (cells > 1 && entryLimit(grid, spheres) > kMostEntries) layOut(grid, spheres, bounds, cells /= 2);
    }
    fillLists(grid, spheres, everywhere);
    return grid;
}

std::vector<std::byte> lightGridBytes(const LightGrid& grid) {
    struct Header {
        glm::vec4 origin, cellsPerUnit;
        glm::uvec4 size;
    };
    const Header header{glm::vec4(grid.origin, 0), glm::vec4(grid.cellsPerUnit, 0),
                        glm::uvec4(grid.size, grid.everywhere)};
    std::vector<std::byte> bytes(sizeof header + grid.words.size() * sizeof(std::uint32_t));
    std::memcpy(bytes.data(), &header, sizeof header);
    std::memcpy(bytes.data() + sizeof header, grid.words.data(), grid.words.size() * sizeof(std::uint32_t));
    return bytes;
}

}  // namespace crevice

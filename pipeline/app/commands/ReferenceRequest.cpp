// Names of files that several radii and falloffs share, checked before the first ray.
#include "app/commands/ReferenceRequest.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "app/commands/ArgumentText.h"
#include "app/commands/OutputFiles.h"
#include "core/Error.h"
#include "core/Files.h"
#include "core/Limits.h"
#include "core/Text.h"

namespace crevice {
namespace {

constexpr std::uint32_t kMaxSamples = 1u << 20, kMaxSlices = 4096;

/// 0 = auto.
float readRadius(const std::string& text) {
    if (text == "auto") return 0;
    const double radius = parseNumber("--radius", text);
    if (radius <= 0 || radius > 1e30) {
        throw Error(fmt::format("--radius: '{}' is out of range", text), "write a length above 0, or auto");
    }
    return static_cast<float>(radius);
}

const Falloff& readFalloff(const std::string& text) {
    if (const Falloff* falloff = findFalloff(text)) return *falloff;
    throw Error(fmt::format("--falloff: '{}' is not a falloff", text), didYouMean(text, falloffNames(), "falloffs"));
}

float readThickness(const std::string& text) {
    if (text == "infinite") return std::numeric_limits<float>::infinity();
    const double thickness = parseNumber("--thickness", text);
    if (thickness <= 0 || thickness > 1e6) {
        throw Error(fmt::format("--thickness: '{}' is out of range", text), "write a share of the radius, or infinite");
    }
    return static_cast<float>(thickness);
}

Image readMap(const char* option, const std::string& path, const glm::uvec2& size, const Limits& limits) {
    Image image = readImage(path, limits);
    if (image.width == size.x && image.height == size.y) return image;
    throw Error(fmt::format("{}: '{}' is {}x{} and the reference {}x{}", option, path, image.width, image.height,
                            size.x, size.y),
                "render both with the same --size");
}

std::vector<float> redChannel(const Image& image) {
    std::vector<float> values;
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) values.push_back(image.at(x, y).x);
    }
    return values;
}

std::vector<WantedMap> readWanted(const ReferenceOptions& options) {
    const std::vector<std::string> radii = options.radius.empty() ? std::vector<std::string>{"auto"} : options.radius;
    const std::vector<std::string> falloffs =
        options.falloff.empty() ? std::vector<std::string>{"hard"} : options.falloff;
    std::vector<WantedMap> wanted;
    for (const std::string& radius : radii) {
        for (const std::string& falloff : falloffs)
            wanted.push_back({radius, {readRadius(radius), &readFalloff(falloff)}});
    }
    return wanted;
}

std::string replaceAll(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

/// "truth-{radius}-{falloff}.exr" with the names of a map.
std::string nameOf(const std::string& pattern, const WantedMap& wanted) {
    const std::string falloff = replaceAll(wanted.term.falloff->name, ":", "-");
    return replaceAll(replaceAll(pattern, "{radius}", wanted.radiusText), "{falloff}", falloff);
}

/// One name per map. Throws Error when two would get the same.
std::vector<std::string> namesOf(const char* option, const std::string& pattern, const std::vector<WantedMap>& wanted) {
    std::vector<std::string> names;
    for (const WantedMap& one : wanted) {
        names.push_back(nameOf(pattern, one));
        if (std::count(names.begin(), names.end(), names.back()) > 1) {
            throw Error(fmt::format("{}: two maps would both be written to '{}'", option, names.back()),
                        "name them by what differs: truth-{radius}-{falloff}.exr");
        }
        checkPicturePath(option, names.back());
    }
    return names;
}

}  // namespace

ReferenceRequest readRequest(const ReferenceOptions& options) {
    if (options.scene.empty()) throw Error("no scene given", "name one: crevice reference crease -o truth.exr");
    if (options.out.empty()) throw Error("no output given", "say where the map goes: -o truth.exr");
    ReferenceRequest request{.view = readView(options.view), .wanted = readWanted(options)};
    request.names = namesOf("-o", options.out, request.wanted);
    for (const WantedMap& one : request.wanted) {
        const bool known = std::any_of(request.radii.begin(), request.radii.end(),
                                       [&](const WantedMap& other) { return other.radiusText == one.radiusText; });
        if (!known) request.radii.push_back({one.radiusText, {one.term.radius, &hardFalloff()}});
    }
    if (!options.heightfield.empty())
        request.heightfieldNames = namesOf("--heightfield", options.heightfield, request.radii);
    request.settings.samples = parseCount("--samples", options.samples, 2, kMaxSamples);
    request.settings.seed = parseCount("--seed", options.seed, 0, std::numeric_limits<std::uint32_t>::max());
    if (!options.noCache) request.settings.cache = cacheFolder("truth");
    request.heightfield.thickness = readThickness(options.thickness);
    request.heightfield.slices = parseCount("--slices", options.slices, 1, kMaxSlices);
    for (const std::string& path : options.heat) checkPicturePath("--heat", path);
    if (options.heat.size() > options.measure.size()) {
        throw Error(fmt::format("--heat: '{}' has no map", options.heat[options.measure.size()]),
                    "give a --measure for each --heat, in the same order");
    }
    Limits limits;
    for (const std::string& limit : options.loading.limits) setLimit(limits, limit);
    for (const std::string& path : options.measure)
        request.measured.push_back(redChannel(readMap("--measure", path, request.view.size, limits)));
    if (!options.depth.empty()) request.depth = readMap("--depth", options.depth, request.view.size, limits);
    return request;
}

}  // namespace crevice

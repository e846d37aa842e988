// Animations: the pose of all nodes at one time, evaluated once when the file is loaded. glTF 2.0 specification,
// 3.11 and appendix C "Animation Sampler Interpolation Modes".
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

enum class Path { Translation, Rotation, Scale, Weights, Other };

Path pathOf(const Value& target) {
    const std::string path = textOr(target, "path");
    return path == "translation" ? Path::Translation
           : path == "rotation"  ? Path::Rotation
           : path == "scale"     ? Path::Scale
           : path == "weights"   ? Path::Weights
                                 : Path::Other;
}

std::size_t targetCount(const File& file, int node) {
    const int mesh = file.model.nodes[std::size_t(node)].mesh;
    if (mesh < 0 || file.model.meshes[std::size_t(mesh)].primitives.empty()) return 0;
    return file.model.meshes[std::size_t(mesh)].primitives[0].targets.size();
}

/// One channel's key frames.
struct Track {
    std::vector<float> times;
    Floats values;
    std::size_t width = 0;  ///< Numbers of one value.
    enum { Linear, Step, Cubic } interpolation = Linear;

    /// The value of a key; of cubic splines the middle one of three.
    const float* value(std::size_t key) const {
        return values.values.data() + (interpolation == Cubic ? 3 * key + 1 : key) * width;
    }
    const float* inTangent(std::size_t key) const { return values.values.data() + 3 * key * width; }
    const float* outTangent(std::size_t key) const { return values.values.data() + (3 * key + 2) * width; }
};

struct Channel {
    int node = -1;
    Path path = Path::Other;
    int input = -1, output = -1;
    std::string interpolation{};
};

std::optional<Channel> readChannel(const File& file, std::size_t animation, const Value& from) {
    const Value& item = file.item("animations", animation);
    const auto& samplers = listIn(item, "samplers");
    const std::size_t sampler = sizeOr(from, "sampler");
    if (sampler >= samplers.size())
        file.fail("animations", animation,
                  fmt::format("'sampler' names samplers[{}], the animation has {}", sampler, samplers.size()));
    const Value& target = *objectIn(&from, "target");
    Channel to{.node = intOr(target, "node"),
               .path = pathOf(target),
               .input = intOr(samplers[sampler], "input"),
               .output = intOr(samplers[sampler], "output"),
               .interpolation = textOr(samplers[sampler], "interpolation", "LINEAR")};
    if (to.path == Path::Other && to.node >= 0)
        file.note(fmt::format("animations[{}]: a channel of path '{}' is left out", animation, textOr(target, "path")));
    if (to.path == Path::Other || to.node < 0) return std::nullopt;
    return to;
}

// What is wrong with a channel that cannot be played; empty: nothing.
std::string refuse(const File& file, const Channel& channel) {
    const AccessorPart& input = file.model.accessors[std::size_t(channel.input)];
    const AccessorPart& output = file.model.accessors[std::size_t(channel.output)];
    if (input.components() != 1 || input.componentType != kFloat) return "'input' is not a float SCALAR";
    const int components = channel.path == Path::Weights ? 1 : channel.path == Path::Rotation ? 4 : 3;
    if (output.columns != 1 || output.rows != components) return "the type of 'output' does not fit its path";
    const bool normalised = output.normalized && output.componentType != kUInt;
    const bool numbers = channel.path == Path::Rotation || channel.path == Path::Weights;
    if (output.componentType != kFloat && !(numbers && normalised))
        return "the numbers of 'output' are neither floats nor normalised integers";
    if (channel.interpolation != "LINEAR" && channel.interpolation != "STEP" && channel.interpolation != "CUBICSPLINE")
        return fmt::format("'interpolation' is '{}'", channel.interpolation);
    std::size_t perKey = channel.interpolation == "CUBICSPLINE" ? 3 : 1;
    if (channel.path == Path::Weights) perKey *= targetCount(file, channel.node);
    if (perKey == 0) return "'weights' needs a mesh with morph targets";
    if (output.count % perKey || output.count / perKey != input.count)
        return fmt::format("'output' has {} elements, {} times {} are needed", output.count, input.count, perKey);
    return {};
}

Track readTrack(const File& file, std::size_t animation, const Channel& channel) {
    if (const std::string why = refuse(file, channel); !why.empty()) file.fail("animations", animation, why);
    Track track;
    track.times = readFloats(file, channel.input).values;
    track.values = readFloats(file, channel.output);
    track.interpolation = channel.interpolation == "STEP"          ? Track::Step
                          : channel.interpolation == "CUBICSPLINE" ? Track::Cubic
                                                                   : Track::Linear;
    const std::size_t values = track.times.size() * (track.interpolation == Track::Cubic ? 3 : 1);
    track.width = track.values.values.size() / values;
    for (std::size_t i = 0; i < track.times.size(); ++i)
        if (track.times[i] < 0 || (i > 0 && track.times[i] <= track.times[i - 1]))
            file.fail("animations", animation,
                      fmt::format("time {} of key {} is below 0 or not above the one before", track.times[i], i));
    return track;
}

glm::quat quatOf(const float* v) {
    const glm::quat q(v[3], v[0], v[1], v[2]);
    const float length = glm::length(q);
    return length > 0 ? q / length : glm::quat(1, 0, 0, 0);
}

std::vector<float> fromQuat(const glm::quat& q) { return {q.x, q.y, q.z, q.w}; }

// Appendix C.5: Hermite splines; tangents count in units per second.
std::vector<float> cubic(const Track& track, std::size_t key, float t, float seconds) {
    const float t2 = t * t, t3 = t2 * t;
    std::vector<float> result(track.width);
    for (std::size_t i = 0; i < track.width; ++i)
        result[i] = (2 * t3 - 3 * t2 + 1) * track.value(key)[i] +
                    seconds * (t3 - 2 * t2 + t) * track.outTangent(key)[i] +
                    (3 * t2 - 2 * t3) * track.value(key + 1)[i] + seconds * (t3 - t2) * track.inTangent(key + 1)[i];
    return result;
}

std::vector<float> sample(const Track& track, float time, bool rotation) {
    const auto copy = [&](std::size_t key) {
        return std::vector<float>(track.value(key), track.value(key) + track.width);
    };
    // Before the first and after the last key its value holds.
    const auto after = std::upper_bound(track.times.begin(), track.times.end(), time);
    if (after == track.times.begin()) return copy(0);
    const std::size_t key = std::size_t(after - track.times.begin()) - 1;
    if (after == track.times.end() || track.interpolation == Track::Step) return copy(key);
    const float seconds = track.times[key + 1] - track.times[key];
    const float t = (time - track.times[key]) / seconds;
    if (track.interpolation == Track::Cubic) return cubic(track, key, t, seconds);
    // glm::slerp takes the shorter way, as appendix C.4 asks.
    if (rotation) return fromQuat(glm::slerp(quatOf(track.value(key)), quatOf(track.value(key + 1)), t));
    std::vector<float> result(track.width);
    for (std::size_t i = 0; i < track.width; ++i)
        result[i] = (1 - t) * track.value(key)[i] + t * track.value(key + 1)[i];
    return result;
}

void pose(const File& file, std::size_t animation, const Channel& channel, float time, Pose& pose) {
    const Track track = readTrack(file, animation, channel);
    const std::vector<float> v = sample(track, time, channel.path == Path::Rotation);
    switch (channel.path) {
        case Path::Translation:
            pose.translations[channel.node] = {v[0], v[1], v[2]};
            return;
        case Path::Scale:
            pose.scales[channel.node] = {v[0], v[1], v[2]};
            return;
        case Path::Rotation:
            pose.rotations[channel.node] = quatOf(v.data());
            return;
        case Path::Weights:
            pose.weights[channel.node] = v;
            return;
        case Path::Other:
            return;
    }
}

// What only the animation suffers from is told, and an error once it is played.
void checkChannel(const File& file, std::size_t animation, const Channel& channel,
                  std::set<std::pair<int, Path>>& targets) {
    if (!targets.insert({channel.node, channel.path}).second)
        file.fault("animations", animation, fmt::format("two channels move the same of nodes[{}]", channel.node));
    if (file.model.nodes[std::size_t(channel.node)].matrix && channel.path != Path::Weights)
        file.fault("animations", animation, fmt::format("it moves nodes[{}], which has a 'matrix'", channel.node));
    const std::string why = refuse(file, channel);
    if (!why.empty()) file.fault("animations", animation, why);
}

}  // namespace

void checkAnimations(const File& file) {
    for (std::size_t i = 0; i < listIn(file.json, "animations").size(); ++i) {
        std::set<std::pair<int, Path>> targets;
        for (const Value& item : listIn(file.item("animations", i), "channels"))
            if (const auto channel = readChannel(file, i, item)) checkChannel(file, i, *channel, targets);
    }
}

Pose readPose(const File& file) {
    Pose result;
    const LoadOptions& options = file.options;
    if (options.animation.empty() && !options.time) return result;
    const std::size_t animation =
        std::size_t(findNamed(file, "animations", "animation", options.animation.empty() ? "0" : options.animation));
    for (const Value& item : listIn(file.item("animations", animation), "channels"))
        if (const auto channel = readChannel(file, animation, item))
            pose(file, animation, *channel, options.time.value_or(0), result);
    return result;
}

}  // namespace crevice::gltf

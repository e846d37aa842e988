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

glm::quat quatOf(const float* v) {
    const glm::quat q(v[3], v[0], v[1], v[2]);
    const float length = glm::length(q);
    return length > 0 ? q / length : glm::quat(1, 0, 0, 0);
}

std::vector<float> fromQuat(const glm::quat& q) { return {q.x, q.y, q.z, q.w}; }

// Appendix C.5: Hermite splines; tangents count in units per second. `keys`: in-tangent, value and out-tangent of two.
std::vector<float> cubic(const float* keys, std::size_t width, float t, float seconds) {
    const float t2 = t * t, t3 = t2 * t;
    const float *from = keys + width, *out = keys + 2 * width, *in = keys + 3 * width, *to = keys + 4 * width;
    std::vector<float> result(width);
    for (std::size_t i = 0; i < width; ++i)
        result[i] = (2 * t3 - 3 * t2 + 1) * from[i] + seconds * (t3 - 2 * t2 + t) * out[i] + (3 * t2 - 2 * t3) * to[i] +
                    seconds * (t3 - t2) * in[i];
    return result;
}

std::vector<float> linear(const float* keys, std::size_t width, float t, bool rotation) {
    // glm::slerp takes the shorter way, as appendix C.4 asks.
    if (rotation) return fromQuat(glm::slerp(quatOf(keys), quatOf(keys + width), t));
    std::vector<float> result(width);
    for (std::size_t i = 0; i < width; ++i) result[i] = (1 - t) * keys[i] + t * keys[width + i];
    return result;
}

/// Plays one animation at one time. Accessors that many channels share are checked once; of each channel the keys
/// around the time are read.
class Player {
public:
    Player(const File& file, std::size_t animation) : file_(file), animation_(animation) {}

    std::vector<float> sample(const Channel& channel, float time) {
        if (const std::string why = refuse(file_, channel); !why.empty()) file_.fail("animations", animation_, why);
        const std::size_t keys = accessorOf(channel.input).count;
        const bool isCubic = channel.interpolation == "CUBICSPLINE";
        const std::size_t elements = accessorOf(channel.output).count / keys;  // of one key
        const std::size_t width = channel.path == Path::Weights ? elements / (isCubic ? 3 : 1)
                                                                : std::size_t(accessorOf(channel.output).components());
        checkTimes(channel.input);
        checkOutput(channel.output);
        file_.spend(width);
        // Before the first and after the last key its value holds.
        const std::size_t after = firstAfter(channel.input, time, keys);
        const std::size_t key = after == 0 ? 0 : after - 1;
        const bool holds = after == 0 || after == keys || channel.interpolation == "STEP";
        const Floats values = readSomeFloats(file_, channel.output, key * elements, elements * (holds ? 1 : 2));
        const float* first = values.values.data();
        if (holds && isCubic) first += width;
        if (holds) return {first, first + width};
        const float start = timeOf(channel.input, key), seconds = timeOf(channel.input, key + 1) - start;
        const float t = (time - start) / seconds;
        return isCubic ? cubic(first, width, t, seconds) : linear(first, width, t, channel.path == Path::Rotation);
    }

private:
    const AccessorPart& accessorOf(int index) const { return file_.model.accessors[std::size_t(index)]; }
    float timeOf(int input, std::size_t key) const { return readSomeFloats(file_, input, key, 1).values[0]; }

    void checkTimes(int input) {
        if (!checked_.insert({input, true}).second) return;
        file_.spend(accessorOf(input).count);
        const std::vector<float> times = readFloats(file_, input).values;
        for (std::size_t i = 0; i < times.size(); ++i)
            if (times[i] < 0 || (i > 0 && times[i] <= times[i - 1]))
                file_.fail("animations", animation_,
                           fmt::format("time {} of key {} is below 0 or not above the one before", times[i], i));
    }

    void checkOutput(int output) {
        if (!checked_.insert({output, false}).second) return;
        file_.spend(accessorOf(output).count);
        readFloats(file_, output);
    }

    // The first key later than a time.
    std::size_t firstAfter(int input, float time, std::size_t keys) const {
        std::size_t low = 0, high = keys;
        while (low < high) {
            const std::size_t middle = low + (high - low) / 2;
            if (timeOf(input, middle) <= time)
                low = middle + 1;
            else
                high = middle;
        }
        return low;
    }

    const File& file_;
    std::size_t animation_;
    std::set<std::pair<int, bool>> checked_;  ///< Accessors, and whether as times.
};

void pose(Player& player, const Channel& channel, float time, Pose& pose) {
    const std::vector<float> v = player.sample(channel, time);
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
    if (options.animation.empty() && listIn(file.json, "animations").empty()) {
        file.note("no animation that 'time' could count in: shown in its rest pose");
        return result;
    }
    const std::size_t animation =
        std::size_t(findNamed(file, "animations", "animation", options.animation.empty() ? "0" : options.animation));
    Player player(file, animation);
    for (const Value& item : listIn(file.item("animations", animation), "channels"))
        if (const auto channel = readChannel(file, animation, item))
            pose(player, *channel, options.time.value_or(0), result);
    return result;
}

}  // namespace crevice::gltf

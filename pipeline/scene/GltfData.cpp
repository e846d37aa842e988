// Stored values that the format bounds: unit vectors, weights, colours, times, declared minima and maxima. None of it
// stops a picture: the loader makes unit vectors and sums of weights right itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

/// Elements of each accessor that are looked at, so that a big file loads as fast as it can; with --strict all are.
constexpr std::size_t kFirst = 4096;
/// Elements of all accessors together, without --strict: they may share bytes, so that a file can name far more of them
/// than it holds. With --strict such a file is refused: File::spend().
constexpr std::size_t kTogether = 10'000'000;

// How far values may be off: floats as exporters round them, integers by the half of their smallest step and more.
constexpr float kUnitFloat = 0.0068f, kUnitInteger = 0.03f;
constexpr float kSumFloat = 5e-4f, kSumInteger = 2e-3f;

/// Checks accessors once each, whatever number of meshes share them.
class Check {
public:
    explicit Check(const File& file)
        : file_(file), most_(file.options.strict ? std::size_t(-1) : kFirst), left_(kTogether) {}

    void checkPrimitive(const PrimitivePart& primitive) {
        for (const auto& [name, accessor] : primitive.attributes) {
            if (name == "NORMAL" && isNew(accessor)) checkUnit(accessor, 3);
            if (name == "TANGENT" && isNew(accessor)) checkUnit(accessor, 4);
            if (name.starts_with("COLOR_") && isNew(accessor)) checkColours(accessor);
        }
        checkWeights(primitive);
        if (primitive.indices >= 0 && isNew(primitive.indices)) checkRestart(primitive.indices);
    }

    void checkSkin(std::size_t index) {
        const int accessor = intOr(file_.item("skins", index), "inverseBindMatrices");
        if (accessor < 0 || !isNew(accessor) || !mayRead(accessor)) return;
        const Floats matrices = readFirstFloats(file_, accessor, most_);
        for (std::size_t i = 0; i < matrices.count() && matrices.components == 16; ++i) {
            const float* m = matrices.at(i);
            if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
                return file_.fault("accessors", std::size_t(accessor),
                                   fmt::format("the last row of matrix {} is not 0 0 0 1", i));
        }
    }

    // Joints of weight 0, too: the others are an error once the mesh is bent. Each mesh is held against the smallest of
    // its skins.
    void checkJoints() {
        std::map<int, std::pair<std::size_t, int>> skins;  // of a mesh: joints, skin
        for (const NodePart& node : file_.model.nodes) {
            if (node.mesh < 0 || node.skin < 0) continue;
            const std::pair skin(listIn(file_.item("skins", std::size_t(node.skin)), "joints").size(), node.skin);
            const auto entry = skins.emplace(node.mesh, skin).first;
            entry->second = std::min(entry->second, skin);
        }
        for (const auto& [mesh, skin] : skins)
            for (const PrimitivePart& primitive : file_.model.meshes[std::size_t(mesh)].primitives)
                for (const auto& [name, accessor] : primitive.attributes)
                    if (name.starts_with("JOINTS_") && largestOf(accessor) >= float(skin.first))
                        file_.fault("accessors", std::size_t(accessor),
                                    fmt::format("it names joint {}, skins[{}] has {}", largestOf(accessor), skin.second,
                                                skin.first));
    }

    void checkAnimation(const Value& animation) {
        const auto& samplers = listIn(animation, "samplers");
        for (const Value& sampler : samplers) checkTimes(sampler);
        for (const Value& channel : listIn(animation, "channels")) {
            const std::size_t sampler = sizeOr(channel, "sampler");
            if (sampler < samplers.size() && textOr(*objectIn(&channel, "target"), "path") == "rotation")
                checkTurns(samplers[sampler]);
        }
    }

    // Integers and numbers that nobody reads, as well: the rest is compared when it is read.
    void checkValues(std::size_t index) {
        const AccessorPart& accessor = file_.model.accessors[index];
        if (accessor.count > most_ || !mayRead(int(index))) return;
        const Floats values = readRaw(int(index));
        for (std::size_t i = 0; i < values.values.size(); ++i)
            if (!std::isfinite(values.values[i]))
                return file_.fault(
                    "accessors", index,
                    fmt::format("element {} is not a finite number", i / std::size_t(values.components)));
        checkBounds(index, values);
    }

private:
    void checkBounds(std::size_t index, const Floats& values) {
        Range range;
        const std::size_t components = std::size_t(values.components);
        for (std::size_t c = 0; c < components; ++c) range.low[c] = range.high[c] = values.at(0)[c];
        for (std::size_t i = 0; i < values.values.size(); ++i) {
            range.low[i % components] = std::min(range.low[i % components], values.values[i]);
            range.high[i % components] = std::max(range.high[i % components], values.values[i]);
        }
        checkDeclared(file_, index, range);
    }

    bool isNew(int accessor) { return seen_.insert(accessor).second; }

    // Whether there is something to look at, within what may be looked at. Elements without bytes are zeros but for the
    // sparse ones: a count of a milliard costs a file nothing, so long ones are left out.
    bool mayRead(int index) {
        if (!hasData(file_, index)) return false;
        const AccessorPart& accessor = accessorOf(index);
        const std::size_t count = std::min(accessor.count, most_);
        if (accessor.bufferView < 0 && count > kFirst) return false;
        if (file_.options.strict) return file_.spend(count), true;
        if (count > left_) return false;
        left_ -= count;
        return true;
    }

    // The largest number, read once.
    float largestOf(int accessor) {
        const auto [entry, isFirst] = largest_.emplace(accessor, -1.0f);
        if (isFirst && mayRead(accessor)) {
            const Floats numbers = readFirstFloats(file_, accessor, most_);
            file_.work.jointNumbers += numbers.values.size();
            for (const float number : numbers.values) entry->second = std::max(entry->second, number);
        }
        return entry->second;
    }

    bool isFloat(int accessor) const { return accessorOf(accessor).componentType == kFloat; }
    const AccessorPart& accessorOf(int index) const { return file_.model.accessors[std::size_t(index)]; }

    // Stored numbers: bounds are not normalised.
    Floats readRaw(int index) const {
        Floats values = readFirstFloats(file_, index, most_);
        const AccessorPart& accessor = accessorOf(index);
        if (!accessor.normalized) return values;
        const float scale = accessor.componentType == kUByte    ? 255.0f
                            : accessor.componentType == kByte   ? 127.0f
                            : accessor.componentType == kUShort ? 65535.0f
                            : accessor.componentType == kShort  ? 32767.0f
                                                                : 1.0f;
        for (float& value : values.values) value = std::round(value * scale);
        return values;
    }

    void checkUnit(int accessor, int components) {
        if (accessorOf(accessor).components() != components || !mayRead(accessor)) return;
        const Floats vectors = readFirstFloats(file_, accessor, most_);
        const float tolerance = isFloat(accessor) ? kUnitFloat : kUnitInteger;
        for (std::size_t i = 0; i < vectors.count(); ++i) {
            const float* v = vectors.at(i);
            const float length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
            if (!(std::abs(length - 1) <= tolerance))
                return file_.fault("accessors", std::size_t(accessor),
                                   fmt::format("vector {} is not of unit length but {}", i, length));
            if (components == 4 && std::abs(v[3]) != 1)
                return file_.fault("accessors", std::size_t(accessor),
                                   fmt::format("the sign of tangent {} is {}, neither 1 nor -1", i, v[3]));
        }
    }

    void checkColours(int accessor) {
        if (!isFloat(accessor) || !mayRead(accessor)) return;
        const Floats colours = readFirstFloats(file_, accessor, most_);
        for (std::size_t i = 0; i < colours.values.size(); ++i)
            if (!(colours.values[i] >= 0 && colours.values[i] <= 1))
                return file_.fault("accessors", std::size_t(accessor),
                                   fmt::format("colour {} is {}, outside 0 … 1", i / std::size_t(colours.components),
                                               colours.values[i]));
    }

    // Of each vertex all sets together sum up to 1, and no joint counts twice.
    void checkWeights(const PrimitivePart& primitive) {
        std::vector<std::pair<int, int>> sets;  // accessors of weights and joints
        for (;;) {
            const auto weight = primitive.attributes.find(fmt::format("WEIGHTS_{}", sets.size()));
            const auto joint = primitive.attributes.find(fmt::format("JOINTS_{}", sets.size()));
            if (weight == primitive.attributes.end() || joint == primitive.attributes.end()) break;
            const AccessorPart &w = accessorOf(weight->second), &j = accessorOf(joint->second);
            const bool plain = j.componentType == kUByte || j.componentType == kUShort;
            if (w.components() != 4 || j.components() != 4 || w.count != j.count || !plain) return;
            if (!sets.empty() && accessorOf(sets[0].first).count != w.count) return;
            sets.emplace_back(weight->second, joint->second);
        }
        // All sets are in memory at once: no more of them than vertices may be.
        if (sets.empty() ||
            std::min(accessorOf(sets[0].first).count, most_) > file_.options.limits.maxVertices / sets.size())
            return;
        const int first = sets[0].first;
        if (!isNew(first)) return;
        std::vector<Floats> weights, joints;
        float tolerance = kSumFloat;
        for (const auto& [weight, joint] : sets) {
            if (!mayRead(weight) || !mayRead(joint)) return;
            weights.push_back(readFirstFloats(file_, weight, most_));
            joints.push_back(readFirstFloats(file_, joint, most_));
            if (!isFloat(weight)) tolerance = kSumInteger;
        }
        for (std::size_t i = 0; i < weights[0].count(); ++i)
            if (!checkVertex(weights, joints, i, tolerance, std::size_t(first))) return;
    }

    bool checkVertex(const std::vector<Floats>& weights, const std::vector<Floats>& joints, std::size_t vertex,
                     float tolerance, std::size_t accessor) const {
        float sum = 0;
        std::vector<float> used;
        for (std::size_t set = 0; set < weights.size(); ++set)
            for (std::size_t k = 0; k < 4; ++k) {
                const float weight = weights[set].at(vertex)[k];
                if (weight < 0)
                    return file_.fault("accessors", accessor,
                                       fmt::format("a weight of vertex {} is {}", vertex, weight)),
                           false;
                sum += weight;
                if (weight > 0) used.push_back(joints[set].at(vertex)[k]);
            }
        if (std::abs(sum - 1) > tolerance)
            return file_.fault("accessors", accessor,
                               fmt::format("the weights of vertex {} sum up to {}", vertex, sum)),
                   false;
        std::sort(used.begin(), used.end());
        const auto twice = std::adjacent_find(used.begin(), used.end());
        if (twice != used.end())
            return file_.fault("accessors", accessor,
                               fmt::format("joint {} of vertex {} has two weights", *twice, vertex)),
                   false;
        return true;
    }

    // The largest number of a type separates strips on some devices.
    void checkRestart(int accessor) {
        const int type = accessorOf(accessor).componentType;
        if ((type != kUByte && type != kUShort && type != kUInt) || accessorOf(accessor).count > most_) return;
        if (!mayRead(accessor)) return;
        const std::uint32_t restart = type == kUByte ? 255u : type == kUShort ? 65535u : 4294967295u;
        const std::vector<std::uint32_t> indices = readIntegers(file_, accessor);
        if (std::find(indices.begin(), indices.end(), restart) != indices.end())
            file_.fault("accessors", std::size_t(accessor),
                        fmt::format("index {} is the mark of primitive restart", restart));
    }

    void checkTimes(const Value& sampler) {
        const int accessor = intOr(sampler, "input");
        if (textOr(sampler, "interpolation") == "CUBICSPLINE" && accessorOf(accessor).count < 2)
            file_.fault("accessors", std::size_t(accessor), "a cubic spline needs two keys or more");
        if (!isNew(accessor)) return;
        const Value& item = file_.item("accessors", std::size_t(accessor));
        if (!item.find("min") || !item.find("max"))
            file_.fault("accessors", std::size_t(accessor), "times of animations need 'min' and 'max'");
        if (accessorOf(accessor).components() != 1 || !mayRead(accessor)) return;
        const Floats times = readFirstFloats(file_, accessor, most_);
        for (std::size_t i = 0; i < times.count(); ++i)
            if (times.values[i] < 0 || (i > 0 && times.values[i] <= times.values[i - 1]))
                return file_.fault(
                    "accessors", std::size_t(accessor),
                    fmt::format("time {} of key {} is below 0 or not above the one before", times.values[i], i));
    }

    void checkTurns(const Value& sampler) {
        const int accessor = intOr(sampler, "output");
        if (accessorOf(accessor).components() != 4 || !isNew(accessor) || !mayRead(accessor)) return;
        const Floats turns = readFirstFloats(file_, accessor, most_);
        const bool cubic = textOr(sampler, "interpolation") == "CUBICSPLINE";  // tangents are no turns
        for (std::size_t i = cubic ? 1 : 0; i < turns.count(); i += cubic ? 3 : 1) {
            const float* q = turns.at(i);
            const float length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
            if (!(std::abs(length - 1) <= (isFloat(accessor) ? kUnitFloat : kUnitInteger)))
                return file_.fault("accessors", std::size_t(accessor),
                                   fmt::format("rotation {} is not of unit length but {}", i, length));
        }
    }

    const File& file_;
    const std::size_t most_;
    std::size_t left_;  ///< Elements that may still be looked at, without --strict.
    std::set<int> seen_;
    std::map<int, float> largest_;
};

}  // namespace

void checkData(const File& file) {
    Check check(file);
    for (const MeshPart& mesh : file.model.meshes)
        for (const PrimitivePart& primitive : mesh.primitives) check.checkPrimitive(primitive);
    for (std::size_t i = 0; i < listIn(file.json, "skins").size(); ++i) check.checkSkin(i);
    check.checkJoints();
    for (const Value& animation : listIn(file.json, "animations")) check.checkAnimation(animation);
    for (std::size_t i = 0; i < file.model.accessors.size(); ++i) check.checkValues(i);
}

}  // namespace crevice::gltf

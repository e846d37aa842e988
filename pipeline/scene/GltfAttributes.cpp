// Names, numbers and types of vertex attributes: glTF 2.0 specification, 3.7.2.1 and 3.7.2.2, and
// KHR_mesh_quantization.
#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

// What an attribute's numbers may be, as bits: floats, normalised and plain integers.
enum Numbers : unsigned {
    kFloats = 1,
    kUnitUByte = 2,
    kUnitUShort = 4,
    kUnitByte = 8,
    kUnitShort = 16,
    kPlainUByte = 32,
    kPlainUShort = 64,
    kPlainByte = 128,
    kPlainShort = 256
};
constexpr unsigned kUnitSigned = kUnitByte | kUnitShort, kUnitUnsigned = kUnitUByte | kUnitUShort;
constexpr unsigned kPlain = kPlainUByte | kPlainUShort | kPlainByte | kPlainShort;

struct Semantic {
    const char* name;
    bool numbered;      ///< "TEXCOORD_0"
    int least, most;    ///< Components
    unsigned numbers;   ///< Of the mesh itself
    unsigned inTarget;  ///< Of a morph target; 0: it cannot be morphed.
    unsigned quantized;
};
constexpr Semantic kSemantics[] = {
    {"POSITION", false, 3, 3, kFloats, kFloats, kUnitSigned | kUnitUnsigned | kPlain},
    {"NORMAL", false, 3, 3, kFloats, kFloats, kUnitSigned},
    {"TANGENT", false, 4, 4, kFloats, kFloats, kUnitSigned},
    {"TEXCOORD_", true, 2, 2, kFloats | kUnitUnsigned, kFloats | kUnitSigned | kUnitUnsigned, kUnitSigned | kPlain},
    {"COLOR_", true, 3, 4, kFloats | kUnitUnsigned, kFloats | kUnitSigned | kUnitUnsigned, 0},
    {"JOINTS_", true, 4, 4, kPlainUByte | kPlainUShort, 0, 0},
    {"WEIGHTS_", true, 4, 4, kFloats | kUnitUnsigned, 0, 0}};

// "0", "12"; not "", "01", "x".
bool isCount(std::string_view digits) {
    return !digits.empty() && digits.size() < 6 && (digits.size() == 1 || digits[0] != '0') &&
           std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
}

const Semantic* findSemantic(std::string_view name) {
    const auto* found = std::find_if(std::begin(kSemantics), std::end(kSemantics), [&](const Semantic& s) {
        const std::string_view own = s.name;
        return s.numbered ? name.starts_with(own) && isCount(name.substr(own.size())) : name == own;
    });
    return found == std::end(kSemantics) ? nullptr : found;
}

unsigned numbersOf(const AccessorPart& accessor) {
    const bool unit = accessor.normalized;
    switch (accessor.componentType) {
        case kFloat:
            return kFloats;
        case kUByte:
            return unit ? kUnitUByte : kPlainUByte;
        case kUShort:
            return unit ? kUnitUShort : kPlainUShort;
        case kByte:
            return unit ? kUnitByte : kPlainByte;
        case kShort:
            return unit ? kUnitShort : kPlainShort;
        default:
            return 0;
    }
}

/// Checks the primitives of one mesh.
class Check {
public:
    Check(const File& file, std::size_t mesh, bool quantized) : file_(file), mesh_(mesh), quantized_(quantized) {}

    void checkPrimitive(const PrimitivePart& primitive) const {
        checkNames(primitive.attributes);
        checkSets(primitive.attributes);
        checkPosition(primitive.attributes);
        for (const auto& [name, accessor] : primitive.attributes) checkFormat(name, accessor, false);
        for (const AttributeMap& target : primitive.targets)
            for (const auto& [name, accessor] : target) {
                checkFormat(name, accessor, true);
                if (name == "POSITION") checkBounds(accessor);
            }
    }

private:
    const AccessorPart& accessorOf(int index) const { return file_.model.accessors[std::size_t(index)]; }

    void checkNames(const AttributeMap& attributes) const {
        for (const auto& [name, accessor] : attributes)
            if (!name.starts_with('_') && !findSemantic(name))
                file_.fault("meshes", mesh_, fmt::format("attribute '{}' has no meaning", name.substr(0, 80)));
    }

    // Numbered attributes begin at 0 and leave none out; joints come with weights.
    void checkSets(const AttributeMap& attributes) const {
        std::map<std::string, std::size_t> counts;
        for (const Semantic& semantic : kSemantics) {
            if (!semantic.numbered) continue;
            std::size_t& count = counts[semantic.name];
            for (const auto& [name, accessor] : attributes) count += findSemantic(name) == &semantic;
            for (std::size_t i = 0; i < count; ++i)
                if (!attributes.contains(semantic.name + std::to_string(i))) {
                    file_.fault("meshes", mesh_, fmt::format("attributes {} do not count from 0 on", semantic.name));
                    break;
                }
        }
        if (counts["JOINTS_"] != counts["WEIGHTS_"])
            file_.fail("meshes", mesh_, "JOINTS and WEIGHTS do not come in pairs");
    }

    void checkPosition(const AttributeMap& attributes) const {
        if (attributes.contains("TANGENT") && !attributes.contains("NORMAL"))
            file_.note(fmt::format("meshes[{}]: TANGENT without NORMAL does not count", mesh_));
        const auto position = attributes.find("POSITION");
        if (position == attributes.end())
            return file_.note(fmt::format("meshes[{}]: a primitive without POSITION is not drawn", mesh_));
        checkBounds(position->second);
        const std::size_t count = accessorOf(position->second).count;
        for (const auto& [name, accessor] : attributes)
            if (accessorOf(accessor).count != count)
                file_.fault("accessors", std::size_t(accessor),
                            fmt::format("'count' of {} is {}, but POSITION of meshes[{}] has {}", name,
                                        accessorOf(accessor).count, mesh_, count));
    }

    void checkBounds(int accessor) const {
        const Value& item = file_.item("accessors", std::size_t(accessor));
        if (!item.find("min") || !item.find("max"))
            file_.fault("accessors", std::size_t(accessor), "POSITION needs 'min' and 'max'");
    }

    // What the loader cannot make use of it refuses when it reads the attribute.
    void checkFormat(const std::string& name, int index, bool inTarget) const {
        const AccessorPart& accessor = accessorOf(index);
        const Semantic* semantic = findSemantic(name);
        if (!semantic) {
            if (accessor.componentType == kUInt)
                file_.fault("accessors", std::size_t(index), fmt::format("32-bit integers as attribute {}", name));
            return;
        }
        const unsigned allowed =
            (inTarget ? semantic->inTarget : semantic->numbers) | (quantized_ ? semantic->quantized : 0u);
        const int least = inTarget && name == "TANGENT" ? 3 : semantic->least;
        const int most = inTarget && name == "TANGENT" ? 3 : semantic->most;
        const bool fits = accessor.columns == 1 && accessor.rows >= least && accessor.rows <= most;
        if (fits && (numbersOf(accessor) & allowed)) return;
        const bool wantsExtension = fits && (numbersOf(accessor) & semantic->quantized);
        const std::string what =
            fits ? fmt::format("'componentType' {}{}", accessor.componentType,
                               accessor.normalized ? ", normalized," : "")
                 : fmt::format("'type' {}", textOr(file_.item("accessors", std::size_t(index)), "type"));
        file_.fault("accessors", std::size_t(index),
                    fmt::format("{} is not for {}{} of meshes[{}]{}", what, inTarget ? "a target of " : "", name, mesh_,
                                wantsExtension ? " without KHR_mesh_quantization" : ""));
    }

    const File& file_;
    std::size_t mesh_;
    bool quantized_;
};

}  // namespace

void checkAttributes(const File& file) {
    const auto has = [&](const char* list, const char* name) {
        const auto& names = listIn(file.json, list);
        return std::any_of(names.begin(), names.end(),
                           [&](const Value& v) { return v.isString() && v.string() == name; });
    };
    const bool quantized = has("extensionsUsed", "KHR_mesh_quantization");
    for (std::size_t i = 0; i < file.model.meshes.size(); ++i)
        for (const PrimitivePart& primitive : file.model.meshes[i].primitives)
            Check(file, i, quantized).checkPrimitive(primitive);
    // Readers without it would misread the file.
    if (quantized && !has("extensionsRequired", "KHR_mesh_quantization"))
        file.fault(file.json.where(), "'KHR_mesh_quantization' is used, so it must be in 'extensionsRequired'");
}

}  // namespace crevice::gltf

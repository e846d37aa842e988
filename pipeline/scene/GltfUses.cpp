// What accessors and buffer views serve for: each for one kind of thing, laid out as that kind asks. glTF 2.0
// specification, 3.6.2.4 "Data Alignment" and 5.11 "Buffer View". All of it can be read whatever is said here.
#include <fmt/format.h>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

enum class Use { None, Vertices, Indices, Instances, Animation, Matrices, Picture };

const char* nameOf(Use use) {
    switch (use) {
        case Use::Vertices:
            return "vertex attributes";
        case Use::Indices:
            return "indices";
        case Use::Instances:
            return "instances";
        case Use::Animation:
            return "animation";
        case Use::Matrices:
            return "matrices of a skin";
        case Use::Picture:
            return "a picture";
        case Use::None:
            break;
    }
    return "nothing";
}

constexpr int kVertexTarget = 34962, kIndexTarget = 34963;  // ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER

/// Collects the uses in the order of the file and tells the first contradictions.
class Uses {
public:
    explicit Uses(const File& file)
        : file_(file),
          accessors_(file.model.accessors.size()),
          views_(file.model.bufferViews.size()),
          firstVertices_(file.model.bufferViews.size(), -1) {}

    void useAccessor(int index, Use use) {
        if (index < 0) return;
        const std::size_t accessor = std::size_t(index);
        if (accessors_[accessor] == use) return;
        if (accessors_[accessor] != Use::None)
            file_.fault("accessors", accessor,
                        fmt::format("it serves for {} and for {}", nameOf(accessors_[accessor]), nameOf(use)));
        accessors_[accessor] = use;
        const AccessorPart& part = file_.model.accessors[accessor];
        if (part.bufferView < 0) return;
        useView(part.bufferView, use);
        if (use == Use::Vertices) checkVertices(index, part);
    }

    void useView(int index, Use use) {
        const std::size_t view = std::size_t(index);
        const BufferViewPart& part = file_.model.bufferViews[view];
        if (views_[view] == use) return;
        if (views_[view] != Use::None)
            file_.fault("bufferViews", view, fmt::format("it holds {} and {}", nameOf(views_[view]), nameOf(use)));
        views_[view] = use;
        const int target = intOr(file_.item("bufferViews", view), "target", 0);
        const int wanted = use == Use::Vertices ? kVertexTarget : use == Use::Indices ? kIndexTarget : 0;
        if (target && target != wanted && use != Use::Instances)
            file_.fault("bufferViews", view, fmt::format("'target' {} is not for {}", target, nameOf(use)));
        if (part.byteStride && use != Use::Vertices && use != Use::Instances)
            file_.fault("bufferViews", view, fmt::format("'byteStride' is not for {}", nameOf(use)));
    }

private:
    // Vertices begin at multiples of 4 bytes; several attributes in one view say how far they are apart.
    void checkVertices(int index, const AccessorPart& part) {
        const BufferViewPart& view = file_.model.bufferViews[std::size_t(part.bufferView)];
        const std::size_t size = componentSize(part.componentType) * std::size_t(part.components());
        const std::size_t apart = view.byteStride ? view.byteStride : size;
        if (part.byteOffset % 4 || (view.byteOffset + part.byteOffset) % 4 || apart % 4)
            file_.fault("accessors", std::size_t(index), "its vertices do not begin at multiples of 4 bytes");
        int& first = firstVertices_[std::size_t(part.bufferView)];
        if (first >= 0 && view.byteStride == 0)
            file_.fault("bufferViews", std::size_t(part.bufferView),
                        fmt::format("accessors[{}] and [{}] share it, so it needs 'byteStride'", first, index));
        if (first < 0) first = index;
    }

    const File& file_;
    std::vector<Use> accessors_, views_;
    std::vector<int> firstVertices_;  ///< Of each view
};

void useMeshes(const File& file, Uses& uses) {
    for (const MeshPart& mesh : file.model.meshes)
        for (const PrimitivePart& primitive : mesh.primitives) {
            uses.useAccessor(primitive.indices, Use::Indices);
            for (const auto& [name, accessor] : primitive.attributes) uses.useAccessor(accessor, Use::Vertices);
            for (const AttributeMap& target : primitive.targets)
                for (const auto& [name, accessor] : target) uses.useAccessor(accessor, Use::Vertices);
        }
}

void useAnimations(const File& file, Uses& uses) {
    for (const Value& animation : listIn(file.json, "animations"))
        for (const Value& sampler : listIn(animation, "samplers")) {
            uses.useAccessor(intOr(sampler, "input"), Use::Animation);
            uses.useAccessor(intOr(sampler, "output"), Use::Animation);
        }
}

}  // namespace

void checkUses(const File& file) {
    Uses uses(file);
    useMeshes(file, uses);
    for (const NodePart& node : file.model.nodes)
        for (const auto& [name, accessor] : node.instancing) uses.useAccessor(accessor, Use::Instances);
    useAnimations(file, uses);
    for (const Value& skin : listIn(file.json, "skins"))
        uses.useAccessor(intOr(skin, "inverseBindMatrices"), Use::Matrices);
    for (const ImagePart& image : file.model.images)
        if (image.bufferView >= 0) uses.useView(image.bufferView, Use::Picture);
}

}  // namespace crevice::gltf

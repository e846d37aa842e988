// Internal to the glTF loader: the opened file and the steps that turn its parts into a Scene.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/Document.h"
#include "core/Files.h"
#include "scene/GltfLoader.h"
#include "scene/GltfModel.h"

namespace crevice::gltf {

/// Sparse indices that are known to increase: bytes that many accessors share are walked once.
class IncreasingRuns {
public:
    /// The first of `count` integers that is not above the one before; `count`: there is none.
    std::size_t findBreak(const unsigned char* data, int componentType, std::size_t count);
    std::size_t visited() const { return visited_; }

private:
    using Runs = std::map<const unsigned char*, const unsigned char*>;  // begin, end
    std::map<std::pair<int, std::size_t>, Runs> runs_;  ///< Of a type, and of addresses modulo its size.
    std::size_t visited_ = 0;
};

/// What was done so far of that which files can ask for again and again: it grows with the file, and tests hold it to
/// that.
struct WorkDone {
    std::size_t jointMatrices = 0;  ///< Made of skins.
    std::size_t jointNumbers = 0;   ///< Of JOINTS_n, held against the sizes of skins.
    std::size_t treeSteps = 0;      ///< From node to node, and questions about two nodes.
};

/// An opened file: its JSON with places for messages, the same as structs, and the bytes they lie in.
struct File {
    std::string name;  ///< As given by the caller.
    const LoadOptions& options;
    bool binary = false;
    std::vector<std::byte> content{};          ///< The .gltf or .glb itself.
    std::span<const std::byte> binaryChunk{};  ///< Of a .glb, inside `content`.
    bool hasBinaryChunk = false;
    std::deque<std::vector<std::byte>> storage{};  ///< Files, decoded URIs and decompressed views.
    Value json{};
    Model model{};
    mutable std::set<std::string> faults{};  ///< Formal faults told so far: each is told once.
    mutable IncreasingRuns increasing{};
    std::size_t bytesHeld = 0;      ///< The file itself, and what it names.
    mutable std::size_t spent = 0;  ///< By spend().
    mutable WorkDone work{};

    /// The place of `list[index]`, as exact as the format allows.
    SourceLoc where(std::string_view list, std::size_t index) const;
    /// Throws an Error at `list[index]`; the message begins with that path.
    [[noreturn]] void fail(std::string_view list, std::size_t index, const std::string& message,
                           const std::string& help = {}) const;
    /// A breach of the format that does no harm: a warning, or an Error when LoadOptions::strict.
    void fault(std::string_view list, std::size_t index, const std::string& message) const;
    void fault(const SourceLoc& where, const std::string& message) const;
    /// Something optional that cannot be had: a warning, or an Error when LoadOptions::strict.
    void lack(std::string_view list, std::size_t index, const std::string& message) const;
    void warn(std::string_view list, std::size_t index, const std::string& message) const;
    void note(const std::string& message) const;
    /// To LoadOptions::progress, if it is there.
    void tell(std::string_view what, double share) const;
    /// Counts numbers that are looked at. Throws Error when they are many times more than the file has bytes: accessors
    /// may share bytes, so that a small file can name any number of them.
    void spend(std::size_t numbers) const;
    /// `list[index]` in the JSON; must exist.
    const Value& item(std::string_view list, std::size_t index) const;
};

/// Reads the file and everything it names except image pixels. Every accessor, buffer view and buffer is checked here.
File open(const std::filesystem::path& path, const LoadOptions& options);

/// Splits a .glb: fills binaryChunk, returns the JSON text. Throws Error.
std::string_view readContainer(File& file);
bool isSupportedExtension(const std::string& name);
/// Types, ranges and references of everything in the JSON. Throws Error with the first breach that does harm.
void checkSchema(const File& file);
/// Drops what the tables do not name, so that nobody searches or copies it again; writes 1.0 as 1 where it is an
/// integer.
void normalise(Value& json);
/// What spans several objects: trees, attributes, skins, animations, cameras.
void checkRules(const File& file);
/// What accessors and buffer views serve for: each for one thing, laid out as that thing asks.
void checkUses(const File& file);
/// Names, numbers and types of vertex attributes.
void checkAttributes(const File& file);
/// Lights that no node holds, too.
void checkLights(const File& file);
/// Roots of skins, and scenes that hold their joints.
void checkSkins(const File& file);
/// Stored values: units, ranges and bounds; of long accessors the first few thousand, with LoadOptions::strict all.
void checkData(const File& file);

/// Reads files that the glTF names: inside the allowed folders, within the limits.
class Resources {
public:
    Resources(File& file, const std::filesystem::path& folder);
    void readBuffers();
    void readBufferViews();
    /// Encoded pictures. Those that cannot be had stay empty, with a warning.
    void readImages();

private:
    std::filesystem::path placeOf(std::string_view list, std::size_t index, const std::string& uri) const;
    std::span<const std::byte> keep(std::vector<std::byte> bytes);
    void readBuffer(std::size_t index, BufferPart& buffer);
    void checkDataUri(std::size_t index, const BufferPart& buffer);

    File& file_;
    std::filesystem::path folder_;
    AssetRoots allowed_;
    std::size_t bytesLeft_;
    std::map<std::filesystem::path, std::span<const std::byte>> read_;
};

/// "%20" → " " (RFC 3986, 2.1); a percent sign without two hex digits stands for itself.
std::string decodePercent(std::string_view text);
/// The bytes of a "data:" URI, or nothing when it is broken.
std::optional<std::vector<std::byte>> decodeDataUri(std::string_view uri);
/// EXT_meshopt_compression. Throws Error.
std::vector<std::byte> decompress(const File& file, std::size_t view, std::span<const std::byte> source);

/// Bytes of one component, 0 for types that glTF 2.0 does not have.
std::size_t componentSize(int componentType);

/// Numbers of an accessor, converted to float: normalised integers to [0,1] or [-1,1].
struct Floats {
    std::vector<float> values;
    int components = 0;
    std::size_t count() const { return components ? values.size() / std::size_t(components) : 0; }
    const float* at(std::size_t element) const { return values.data() + element * std::size_t(components); }
};
void checkAccessor(const File& file, std::size_t index);
/// Throws Error: numbers that are not finite, an accessor without data.
Floats readFloats(const File& file, int accessor);
/// Elements from `first` on, which must be there. Throws Error as readFloats() does.
Floats readSomeFloats(const File& file, int accessor, std::size_t first, std::size_t count);
/// The first `most` elements, unchecked: they may be beyond declared bounds or not finite. Integers that are no
/// indices, as well; exact up to 2^24.
Floats readFirstFloats(const File& file, int accessor, std::size_t most);
/// The smallest and largest number of each component.
struct Range {
    std::array<float, 16> low{}, high{};
};
/// Throws Error when a number is not finite; holds declared 'min' and 'max' against the rest. `bytes`: floats, packed
/// within an element.
void checkFloats(const File& file, std::size_t accessor, const unsigned char* bytes, std::size_t stride);
/// Declared bounds are the smallest and largest numbers stored: nothing that is drawn depends on them.
void checkDeclared(const File& file, std::size_t accessor, const Range& stored);
/// The accessor's data is there and could be read.
bool hasData(const File& file, int accessor);

/// Vectors of floats as a mesh takes them, one after the other: read where they lie in the file's buffer when they are
/// floats already, so that big meshes are not copied twice. Must not outlive the file.
class FloatStream {
public:
    int components = 0;  ///< 0: the attribute is not there.
    std::size_t count = 0;

    template <int N>
    glm::vec<N, float> at(std::size_t index) const {
        glm::vec<N, float> value;
        std::memcpy(&value, data_ + index * stride_, sizeof value);
        return value;
    }
    /// The numbers of all elements, to be changed; copied when they lay in the file.
    std::vector<float>& edit();

private:
    friend FloatStream readFloatStream(const File& file, int accessor);
    void useOwn();

    const unsigned char* data_ = nullptr;
    std::size_t stride_ = 0;
    std::vector<float> own_{};  ///< What data_ points to, unless that is the file. Moves keep the place.
};
/// Checked like readFloats().
FloatStream readFloatStream(const File& file, int accessor);
/// Unsigned integers of a scalar or vector accessor (indices, joints), one after the other.
std::vector<std::uint32_t> readIntegers(const File& file, int accessor);

/// The textures that materials asked for; pixels are decoded at the end, all at once.
class Images {
public:
    explicit Images(const File& file);
    /// Index of the scene texture for a glTF texture in one colour space, or -1.
    int use(int texture, bool srgb, std::string_view user);
    /// Decodes every image in use on all cores; a broken one becomes white, with a warning.
    std::vector<SceneTexture> decode();
    /// Scene textures without a picture of their own, after decode().
    const std::set<int>& broken() const { return broken_; }
    /// What decode() left of LoadLimits::maxImageBytes.
    std::size_t bytesLeft() const { return bytesLeft_; }

private:
    using Key = std::tuple<int, int, bool>;  // image, sampler, srgb: the first of their kind
    int samplerLike(int sampler);
    void checkTotal() const;

    const File& file_;
    std::vector<std::pair<SamplerDesc, int>> samplers_;
    std::size_t bytesLeft_;
    std::map<std::pair<const std::byte*, std::size_t>, int> sources_;  ///< The first image of the same bytes.
    std::map<Key, int> indices_;
    std::vector<Key> keys_;
    std::set<int> broken_;
};

/// A material whose diffuse and specular-glossiness textures become base colour and metallic-roughness after decoding.
struct SpecularGlossiness {
    std::size_t material = 0;
    glm::vec4 diffuse{1};
    glm::vec3 specular{1};
    float glossiness = 1;
    TextureRef diffuseMap{}, specularGlossinessMap{};
};

struct Materials {
    std::vector<SceneMaterial> scene;
    /// Of each glTF material: the sets of texture coordinates that its textures read, at most four, in stream order.
    std::vector<std::vector<int>> texcoords;
    std::vector<SpecularGlossiness> toConvert;
};
Materials readMaterials(const File& file, Images& images);
/// Replaces what readMaterials() left for after decoding. Adds textures of at most `bytesLeft`; where there is no room
/// for them, the textures are left out with a warning.
void convertSpecularGlossiness(const File& file, const std::vector<SpecularGlossiness>& materials,
                               std::size_t bytesLeft, Scene& scene);

/// Blended materials whose factor, texture and vertex colours are opaque become opaque. Needs pixels and vertices.
/// Returns how many texels and vertices it looked at.
std::size_t drawOpaqueWhatIs(Scene& scene);

/// The numbers that an animation gives at one time; what it does not move stays as the file has it.
struct Pose {
    std::map<int, glm::vec3> translations{}, scales{};
    std::map<int, glm::quat> rotations{};
    std::map<int, std::vector<float>> weights{};
};
/// Empty when LoadOptions asks for no animation. Throws Error: no such animation.
Pose readPose(const File& file);
/// References, formats and times of all animations.
void checkAnimations(const File& file);

/// How a glTF primitive is drawn.
struct Part {
    int mesh = 0;
    int material = -1;   ///< -1: the default material
    bool unlit = false;  ///< Points and lines without normals
    bool noMap = false;  ///< Points and lines without tangents: no normal map
};

/// What bends a mesh: the joints' matrices (empty: none) and the weights of its morph targets, where they are not the
/// mesh's own.
struct Deformation {
    int skin = -1;
    std::span<const glm::mat4> joints{};
    std::vector<float> weights{};
};

/// A primitive's attributes, read and morphed; vertices are made of them.
struct Attributes {
    FloatStream position, normal, tangent, uv[4], color;
    std::vector<std::vector<std::uint32_t>> joints;
    std::vector<FloatStream> weights;
};
/// Adds the primitive's morph targets. `sets`: the texture coordinates in uv.
void morph(const File& file, int mesh, const PrimitivePart& primitive, std::span<const float> weights,
           std::span<const int> sets, Attributes& attributes);
/// Linear blend skinning, glTF 2.0 specification, 3.7.3.3.
void bend(const File& file, int mesh, const Attributes& from, std::span<const glm::mat4> joints,
          std::vector<Vertex>& vertices);
glm::vec3 unitOr(const glm::vec3& vector, const glm::vec3& otherwise);

class Release;

/// Meshes read once for each deformation, when a node first wants them.
class Meshes {
public:
    /// `release` gets the file's bytes back that no mesh needs any more.
    Meshes(const File& file, const Materials& materials, Release& release, std::vector<Mesh>& meshes)
        : file_(file), materials_(materials), release_(release), meshes_(meshes) {}
    /// All that parts() will be asked for: meshes as nodes deform them. To be called once, before the first.
    void expect(const std::vector<std::pair<int, Deformation>>& wanted);
    /// The drawable primitives of a mesh.
    const std::vector<Part>& parts(int mesh, const Deformation& deformation);
    /// Of primitives and of their targets, so far.
    std::size_t readings() const { return readings_; }

private:
    std::optional<Mesh> readPrimitive(int mesh, std::size_t primitive, const Deformation& deformation, Part& part);
    /// `passedOver`: targets and attributes that are only looked at.
    void countReadings(std::size_t times, std::size_t passedOver, int mesh);
    /// `times`: attributes of that many vertices are read besides each other.
    void countVertices(std::size_t vertices, std::size_t times, std::size_t indices, int mesh);

    const File& file_;
    using Key = std::tuple<int, int, std::vector<float>>;  // mesh, skin, weights
    const Materials& materials_;
    Release& release_;
    std::vector<Mesh>& meshes_;
    std::map<Key, std::vector<Part>> parts_;
    std::size_t vertexCount_ = 0, indexCount_ = 0;
    std::size_t readings_ = 0;             ///< Of primitives, and of their targets.
    std::size_t made_ = 0, expected_ = 0;  ///< Vertices, for LoadOptions::progress.
};

/// A node of the shown scene.
struct Placed {
    int node = 0, depth = 0;
    glm::mat4 world{1};
    bool visible = true;  ///< It and all above it: KHR_node_visibility.
};
/// The nodes of the scene that LoadOptions::scene names, posed, parents first.
std::vector<Placed> placeNodes(const File& file, const Pose& pose);

/// Instances, lights and cameras in world space.
void readNodes(const File& file, Meshes& meshes, Scene& scene);
/// Throws Error. The light of a node in world space.
Light readLight(const File& file, int light, const glm::mat4& world, const std::string& otherName);
/// Nothing, with a warning, when no picture can be taken with it.
std::optional<Camera> readCamera(const File& file, int camera, const glm::mat4& world, const std::string& otherName);
/// EXT_mesh_gpu_instancing: one matrix per copy, in the node's space.
std::vector<glm::mat4> readInstancing(const File& file, const NodePart& node, int index);

/// `scenes[…]` or `animations[…]` by name or index. Throws Error that lists what there is.
int findNamed(const File& file, const char* list, const char* option, const std::string& wanted);

}  // namespace crevice::gltf

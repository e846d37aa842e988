// Fuzzes scene documents, with a glTF beside them that they may name.
#include "FuzzTargets.h"
#include "scene/SceneAsset.h"

namespace crevice::fuzz {
namespace {

constexpr std::string_view kTriangle =
    R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "scene": 0,
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

}  // namespace

void scene(std::string_view input) {
    static const ScratchFolder kFolder;
    static const std::filesystem::path kBeside = kFolder.write("triangle.gltf", kTriangle);
    static const Log kLog(LogLevel::Note, [](LogLevel, std::string_view) {});
    const LoadOptions options{.log = kLog, .limits = smallLimits()};
    expectAnswer([&] { (void)readSceneAsset(parseJson(input, "fuzz.scene.json"), kFolder.path(), options); });
}

}  // namespace crevice::fuzz

// A project of a test's own with one effect, one material and one model, and scenes that use them.
#pragma once

#include "cocos/scene/SceneImport.h"

#include <gtest/gtest.h>

#include "SceneTestTools.h"
#include "cocos/scene/SceneComponents.h"
#include "cocos/scene/Shapes.h"
#include "core/Files.h"

namespace crevice::cocos {

namespace fs = std::filesystem;
using test::contains;
using test::errorOf;
using test::TempFolder;

inline constexpr const char* kStandard = "1baf0fc9-befa-459c-8bdd-af1a450a0319";
inline constexpr const char* kPaint = "10ff50d1-0000-4000-8000-000000f1736b";
inline constexpr const char* kModel = "20ff50d1-0000-4000-8000-000000f1736b";

/// Two triangles, one a node's mesh 0 and one mesh 1, with a red material each; the buffer is written beside it.
inline constexpr const char* kGltf =
    R"({ "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0, 1 ] } ],
  "nodes": [ { "mesh": 0, "name": "a" }, { "mesh": 1, "name": "b", "translation": [ 5, 0, 0 ] } ],
  "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 }, "material": 0 } ] },
              { "primitives": [ { "attributes": { "POSITION": 0 }, "material": 1 } ] } ],
  "materials": [ { "name": "m0" }, { "name": "m1", "pbrMetallicRoughness": { "roughnessFactor": 0.25 } } ],
  "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [ 0, 0, 0 ], "max": [ 1, 1, 0 ] } ],
  "bufferViews": [ { "buffer": 0, "byteLength": 36 } ], "buffers": [ { "byteLength": 36, "uri": "m.bin" } ] })";

struct SceneFolder {
    TempFolder folder;
    std::string notes;

    SceneFolder() {
        write("engine/effects/builtin-standard.effect", R"(CCEffect %{
  techniques:
  - name: opaque
    passes:
    - { vert: v, frag: f, properties: { mainColor: { value: [1, 1, 1, 1] }, metallic: { value: 0.6 }, mainTexture: { value: grey } } }
    - { vert: v, frag: f, phase: forward-add, propertyIndex: 0, properties: { mainColor: { value: [1, 1, 1, 1] } } }
  - name: transparent
    passes:
    - { vert: v, frag: f, properties: { mainColor: { value: [1, 1, 1, 1] } } }
}%
)");
        write("engine/effects/builtin-standard.effect.meta", meta(kStandard, "effect"));
        write(
            "project/paint.mtl",
            std::string(R"({ "__type__": "cc.Material", "_name": "paint", "_effectAsset": { "__uuid__": ")") +
                kStandard +
                R"(" }, "_props": [ { "metallic": 0.25, "mainColor": { "__type__": "cc.Color", "r": 0, "g": 204, "b": 255, "a": 255 } } ] })");
        write("project/paint.mtl.meta", meta(kPaint, "material"));
        write("project/m.gltf", kGltf);
        const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
        folder.write("project/m.bin", std::string_view(reinterpret_cast<const char*>(corners), sizeof corners));
        const auto part = [](const char* id, const char* importer, int index) {
            return std::string("\"") + id + R"(":{"importer":")" + importer + R"(","uuid":")" + kModel + "@" + id +
                   R"(","userData":{"gltfIndex":)" + std::to_string(index) + "}}";
        };
        write("project/m.gltf.meta", R"({"importer":"gltf","uuid":")" + std::string(kModel) + R"(","subMetas":{)" +
                                         part("aaaaa", "gltf-mesh", 0) + "," + part("bbbbb", "gltf-mesh", 1) + "," +
                                         part("ccccc", "gltf-material", 1) + "," + part("ddddd", "gltf-scene", 0) +
                                         "}}");
    }
    static std::string meta(const std::string& uuid, const std::string& importer) {
        return R"({"importer":")" + importer + R"(","uuid":")" + uuid + "\"}";
    }
    void write(const std::string& name, const std::string& text) const { folder.write(name, text); }
    ImportedScene load(const std::string& text, MaterialForm form = MaterialForm::Effects) {
        write("project/x.scene", text);
        Problems problems;
        const EffectReader effects = [](const fs::path& path, const std::string& name, Problems& found) {
            return parseEffect(readText(path), name, path.string(), found, EffectReading::Tolerant);
        };
        Project project({.chunks = {}, .project = folder.path() / "project", .engine = folder.path() / "engine"},
                        effects, problems);
        const Log quiet(LogLevel::Error, [](LogLevel, std::string_view) {});
        ImportedScene imported =
            importScene(folder.path() / "project/x.scene", project, form, {.log = quiet}, problems);
        problems.throwIfErrors();
        for (const Problem& problem : problems.all()) notes += formatProblem(problem) + "\n";
        return imported;
    }
    std::string errors(const std::string& text) {
        return errorOf([&] { load(text); });
    }
};

/// A scene of one node with this component; `node` adds fields of the node, `globals` of the scene.
inline std::string withComponent(const std::string& component, const std::string& node = "",
                                 const std::string& globals = "{}") {
    return R"([ { "__type__": "cc.SceneAsset", "scene": { "__id__": 1 } },
      { "__type__": "cc.Scene", "_children": [ { "__id__": 2 } ], "_globals": )" +
           globals + R"( },
      { "__type__": "cc.Node", "_name": "thing", "_components": [ { "__id__": 3 } ])" +
           node + "}, " + component + "]";
}

inline std::string renderer(const std::string& mesh, const std::string& materials) {
    return R"({ "__type__": "cc.MeshRenderer", "_mesh": { "__uuid__": ")" + mesh + R"(" }, "_materials": )" +
           materials + "}";
}

inline const std::string kSphere = std::string(kPrimitivesUuid) + "@17020";

}  // namespace crevice::cocos

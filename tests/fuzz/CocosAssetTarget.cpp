// Fuzzes the other files of a Cocos project: the input's first line says which kind it is (mtl, meta, rpp, scene), the
// rest is the file, in a project that has an effect, a material and a model to refer to.
#include "FuzzTargets.h"
#include "cocos/assets/MtlInstance.h"
#include "cocos/import/Import.h"
#include "cocos/scene/SceneImport.h"
#include "core/Files.h"
#include "core/Image.h"
#include "effect/EffectAsset.h"

namespace crevice::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEffect = R"(CCEffect %{
  techniques:
  - name: opaque
    passes:
    - vert: v
      frag: f
      phase: ssao
      properties:
        mainColor: { value: [1, 1, 1, 1], linear: true, target: albedo }
        metallic: { value: 0.6, target: pbr.x }
        roughness: { value: 0.5, target: pbr.y }
        mainTexture: { value: grey }
    - { vert: v, frag: f, phase: forward-add, propertyIndex: 0, embeddedMacros: { ADD: true } }
  - name: transparent
    passes:
    - { vert: v, frag: f, switch: USE_IT, properties: { mainColor: { value: [1, 1, 1, 1] } } }
}%
)";
constexpr std::string_view kMaterial =
    R"({ "__type__": "cc.Material", "_effectAsset": { "__uuid__": "1baf0fc9-befa-459c-8bdd-af1a450a0319" },
  "_props": [ { "metallic": 0.25, "mainTexture": { "__uuid__": "30ff50d1-0000-4000-8000-000000f1736b@6c48a" } } ] })";
constexpr std::string_view kModel =
    R"({ "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0, 1 ] } ],
  "nodes": [ { "mesh": 0 }, { "mesh": 1, "scale": [ -1, 1, 1 ] } ],
  "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 }, "material": 0 } ] },
              { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ],
  "materials": [ { "normalTexture": { "index": 0 } } ], "textures": [ { "source": 0 } ],
  "images": [ { "uri": "t.png" } ],
  "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [ 0, 0, 0 ], "max": [ 1, 1, 0 ] } ],
  "bufferViews": [ { "buffer": 0, "byteLength": 36 } ], "buffers": [ { "byteLength": 36,
    "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" } ] })";

struct AssetFolder {
    ScratchFolder folder;

    AssetFolder() {
        write("package.json", R"({ "creator": { "version": "3.6.1" } })");
        write("assets/effects/builtin-standard.effect", kEffect);
        write("assets/effects/builtin-standard.effect.meta",
              R"({ "importer": "effect", "uuid": "1baf0fc9-befa-459c-8bdd-af1a450a0319" })");
        write("assets/paint.mtl", kMaterial);
        write("assets/paint.mtl.meta", R"({ "importer": "material", "uuid": "10ff50d1-0000-4000-8000-000000f1736b" })");
        write("assets/m.gltf", kModel);
        write("assets/other.gltf", kModel);
        write("assets/m.gltf.meta",
              R"({ "importer": "gltf", "uuid": "20ff50d1-0000-4000-8000-000000f1736b", "subMetas": {
  "a": { "importer": "gltf-mesh", "uuid": "20ff50d1-0000-4000-8000-000000f1736b@a", "userData": { "gltfIndex": 0 } },
  "b": { "importer": "gltf-material", "uuid": "20ff50d1-0000-4000-8000-000000f1736b@b", "userData": { "gltfIndex": 0 } },
  "c": { "importer": "gltf-scene", "uuid": "20ff50d1-0000-4000-8000-000000f1736b@c", "userData": { "gltfIndex": 0 } },
  "d": { "importer": "gltf-mesh", "uuid": "20ff50d1-0000-4000-8000-000000f1736b@d", "userData": { "gltfIndex": 7 } } } })");
        writeImage(folder.path() / "assets/t.png", Image(4, 2, Format::RGBA8));
        write("assets/t.png.meta",
              R"({ "importer": "image", "uuid": "30ff50d1-0000-4000-8000-000000f1736b", "subMetas": {
  "6c48a": { "importer": "texture", "uuid": "30ff50d1-0000-4000-8000-000000f1736b@6c48a", "userData": {
    "wrapModeS": "clamp-to-edge", "wrapModeT": "mirrored-repeat", "minfilter": "nearest", "mipfilter": "linear" } },
  "b47c0": { "importer": "erp-texture-cube", "uuid": "30ff50d1-0000-4000-8000-000000f1736b@b47c0",
    "userData": { "isRGBE": true } } } })");
        write("assets/p.prefab", R"([ { "__type__": "cc.Prefab", "data": { "__id__": 1 } },
  { "__type__": "cc.Node", "_components": [ { "__type__": "cc.MeshRenderer",
    "_mesh": { "__uuid__": "20ff50d1-0000-4000-8000-000000f1736b@a" }, "_materials": [ null ],
    "__prefab": { "fileId": "look" } } ], "_children": [ { "__type__": "cc.Node", "_prefab": { "fileId": "inner" } } ] } ])");
        write("assets/p.prefab.meta", R"({ "importer": "prefab", "uuid": "40ff50d1-0000-4000-8000-000000f1736b" })");
    }
    fs::path write(const std::string& name, std::string_view text) const {
        fs::create_directories((folder.path() / name).parent_path());
        return folder.write(name, text);
    }
};

EffectAsset readEffect(const fs::path& path, const std::string& name, Problems& problems) {
    return parseEffect(readText(path), name, path.string(), problems, EffectReading::Tolerant);
}

void readMaterial(std::string_view text) {
    Problems problems;
    static const EffectAsset kAsset = parseEffect(kEffect, "builtin-standard", "e", problems, EffectReading::Tolerant);
    const cocos::Mtl mtl = cocos::parseMtl(text, "fuzz.mtl", problems);
    const cocos::TextureUser textures = [](const cocos::AssetRef&, const EffectProperty&) {
        return Value::makeInteger(0);
    };
    const MaterialEffect made = cocos::instantiate(mtl, kAsset, "builtin-standard", textures, problems);
    (void)made;
    problems.throwIfErrors();
}

void readProjectFile(const AssetFolder& assets, const std::string& kind, std::string_view text) {
    static const Log kLog(LogLevel::Note, [](LogLevel, std::string_view) {});
    Problems problems;
    const fs::path file = assets.write(kind == "meta" ? "assets/other.gltf.meta" : "assets/fuzz." + kind, text);
    if (kind != "meta") assets.write("assets/other.gltf.meta", "{}");
    cocos::Project project({.chunks = {}, .project = assets.folder.path(), .engine = {}}, readEffect, problems);
    if (kind == "rpp")
        (void)cocos::importPipeline({.rpp = file, .classes = {{"SsaoStage", {"seed"}, {"cc_ssaoMap"}}}}, project,
                                    problems);
    const LoadOptions options{.log = kLog, .limits = smallLimits()};
    if (kind == "scene")
        for (const cocos::MaterialForm form : {cocos::MaterialForm::Effects, cocos::MaterialForm::Plain})
            (void)cocos::importScene(file, project, form, options, problems);
    if (kind == "meta") {
        for (const cocos::MetaAsset* part : project.metas().parts("20ff50d1-0000-4000-8000-000000f1736b", "gltf-mesh"))
            (void)project.metas().find(part->uuid);
        (void)project.metas().findFile(assets.folder.path() / "assets/other.gltf");
        (void)project.effectName(assets.folder.path() / "assets/effects/builtin-standard.effect");
        (void)project.findEffect("builtin-standard");
        (void)project.metas().parts("20ff50d1-0000-4000-8000-000000f1736b", "gltf-mesh");
        (void)project.metas().findNearest("20ff50d1-0000-4000-8000-000000f1736b@zzz");
    }
    problems.throwIfErrors();
}

}  // namespace

void cocosAsset(std::string_view input) {
    static const AssetFolder kAssets;
    const std::size_t line = input.find('\n');
    const std::string kind(input.substr(0, line));
    const std::string_view text = line == std::string_view::npos ? std::string_view{} : input.substr(line + 1);
    if (kind == "mtl") expectAnswer([&] { readMaterial(text); });
    if (kind == "rpp" || kind == "scene" || kind == "meta") expectAnswer([&] { readProjectFile(kAssets, kind, text); });
}

}  // namespace crevice::fuzz

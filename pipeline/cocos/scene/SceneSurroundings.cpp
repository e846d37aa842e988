// Each part may be missing: old scenes lack some, and new ones renamed them.
#include "cocos/scene/SceneSurroundings.h"

#include <fmt/format.h>

#include "cocos/scene/SceneGlobals.h"
#include "cocos/scene/SceneSky.h"

namespace crevice::cocos {
namespace {

const Value* section(const ObjectGraph& graph, const Value* globals, std::initializer_list<const char*> keys,
                     Problems& problems) {
    if (!globals) return nullptr;
    for (const char* key : keys) {
        const Value* value = globals->find(key);
        if (value && !value->isNull()) return graph.resolve(*value, fmt::format("'{}'", key), problems);
    }
    return nullptr;
}

class Surroundings {
public:
    Surroundings(const SceneFacts& facts, Project& project, const LoadOptions& options, ImportedScene& out,
                 std::map<std::string, std::size_t>& skipped, Problems& problems)
        : facts_(facts), project_(project), options_(options), out_(out), skipped_(skipped), problems_(problems) {}

    void read(const ObjectGraph& graph, const Value* globals) {
        const Value none = Value::makeObject();
        const Value* shadows = section(graph, globals, {"shadows", "_shadows"}, problems_);
        takeShadows(readShadows(shadows ? *shadows : none, problems_));
        const Value* ambient = section(graph, globals, {"ambient", "_ambient"}, problems_);
        const Value& light = ambient ? *ambient : none;
        out_.scene.ambient = readAmbient(light, facts_.hdr, facts_.exposure, problems_);
        if (const Value* fog = section(graph, globals, {"fog", "_fog"}, problems_))
            out_.scene.fog = readFog(*fog, facts_.exposure, problems_);
        if (const Value* skybox = section(graph, globals, {"_skybox", "skybox"}, problems_))
            takeSky(*skybox, readSkyIlluminance(light, facts_.hdr, facts_.exposure, problems_));
        noteDarkness(light);
    }

private:
    /// The exposure of a .scene is that of daylight: nothing else would say why the picture is black.
    void noteDarkness(const Value& ambient) {
        const Ambient& around = *out_.scene.ambient;
        const bool dark = around.sky == glm::vec3(0) && around.ground == glm::vec3(0) && !litByEnvironment(out_.scene);
        if (!out_.scene.lights.empty() || problems_.hasErrors()) return;
        if (dark)
            problems_.warning(ambient.where(),
                              "nothing lights this scene: it has no lights, and its ambient light is 0",
                              "add a light, or raise '_skyIllum'");
        else
            problems_.note({}, "the scene has no lights: its ambient light or its sky alone lights it");
    }

    void takeShadows(const ImportedShadows& shadows) {
        if (shadows.planar) ++skipped_["planar shadows"];
        if (shadows.maps && shadows.size != glm::uvec2(0)) out_.shadowMap = shadows.size;
        if (shadows.maps && facts_.cascades) ++skipped_["cascades of shadow maps: the light has one map"];
        for (Light& light : out_.scene.lights) {
            light.castsShadow = light.castsShadow && shadows.maps;
            if (!light.shadow) light.shadow = shadows.look;
        }
    }

    void takeSky(const Value& info, double illuminance) {
        const ImportedSky sky = readSkybox(info, facts_.hdr, problems_);
        if (!sky.enabled || (!sky.lights && !facts_.showsSky)) return;
        if (sky.ownEffect) ++skipped_["the material of the sky"];
        const MetaAsset* asset = sky.picture ? project_.metas().find(sky.picture.uuid) : nullptr;
        if (!asset || !isSky(*asset)) {
            noteSky(sky, asset);
            return;
        }
        try {
            out_.scene.environment = readSky(*asset, project_.metas(), options_.log, options_.limits);
            out_.scene.environment->intensity = float(illuminance);
            out_.scene.environment->rotation = float(glm::radians(sky.rotation));
            out_.scene.environment->visible = facts_.showsSky;
            out_.scene.environment->lights = sky.lights;
        } catch (const Error& error) {
            const Problem& why = error.problems().front();
            problems_.warning(sky.picture.where, fmt::format("the sky is left out: {}", why.message), why.help);
        }
    }

    void noteSky(const ImportedSky& sky, const MetaAsset* asset) {
        const std::string what = asset         ? fmt::format("'{}' is no sky", asset->path.filename().string())
                                 : sky.picture ? fmt::format("no .meta has its uuid '{}'", sky.picture.uuid)
                                               : "it has no picture";
        problems_.note(sky.picture.where, fmt::format("the sky is left out: {}", what),
                       asset || !sky.picture ? "skies are .hdr, .exr, .png, .jpg or .webp: panoramas, or six faces"
                                             : "the engine's own skies are in its folder: --engine DIR");
    }

    const SceneFacts& facts_;
    Project& project_;
    const LoadOptions& options_;
    ImportedScene& out_;
    std::map<std::string, std::size_t>& skipped_;
    Problems& problems_;
};

}  // namespace

bool isHdr(const ObjectGraph& graph, const Value* globals, Problems& problems) {
    const Value* skybox = section(graph, globals, {"_skybox", "skybox"}, problems);
    if (!skybox) return true;
    const FieldReader fields(*skybox, problems);
    return fields.boolean(fields.firstOf({"_useHDR", "_isHDR"}), true);
}

void readSurroundings(const ObjectGraph& graph, const Value* globals, const SceneFacts& facts, Project& project,
                      const LoadOptions& options, ImportedScene& out, std::map<std::string, std::size_t>& skipped,
                      Problems& problems) {
    Surroundings(facts, project, options, out, skipped, problems).read(graph, globals);
}

}  // namespace crevice::cocos

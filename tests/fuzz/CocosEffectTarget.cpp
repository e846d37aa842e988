// Fuzzes Cocos effects as a project holds them: header, includes, macros, conditions, numbering and reflection of every
// pass. Behind a mark the input is the text of a chunk that the effect may include as <fuzz>.
#include "FuzzTargets.h"
#include "cocos/CocosEffects.h"
#include "cocos/reflection/EffectReflection.h"

namespace crevice::fuzz {
namespace {

constexpr std::string_view kChunkMark = "\n%%\n";

/// A project with one chunk of each kind that effects lean on.
struct Project {
    ScratchFolder folder;
    std::filesystem::path effect;

    Project() {
        write("assets/chunks/legacy/input.chunk",
              "#define CCVertInput(p) vec3 p = a_position\nin vec3 a_position;\nin vec2 a_texCoord;\n");
        write("assets/chunks/common.chunk",
              "#pragma define CCFragOutput(c) fragColor = c\n#define saturate(x) clamp(x, 0.0, 1.0)\n"
              "layout(location = 0) out vec4 fragColor;\n#include <legacy/input>\n");
        write("assets/chunks/global.chunk",
              "#pragma builtin(global)\nlayout(set = 0, binding = 0) uniform CCGlobal { highp vec4 cc_time; mat4 "
              "cc_matView; };\n"
              "#if CC_USE_FOG == 1\nuniform sampler2D cc_fog;\n#endif\n");
        effect = write("assets/effects/fuzz.effect", "");
    }
    std::filesystem::path write(const std::string& name, std::string_view text) const {
        std::filesystem::create_directories((folder.path() / name).parent_path());
        return folder.write(name, text);
    }
};

void readPass(cocos::CocosEffects& effects, const EffectAsset& asset, const EffectPass& pass) {
    Problems problems;
    VariantRequest request;
    request.effect = asset.name;
    for (const DefineInfo& info : effects.defines(asset, pass, problems)) {
        checkDefine(info, "1", info.where, problems);
        if (info.type != DefineType::String) request.defines[info.name] = "1";
    }
    if (problems.hasErrors()) return;
    const BindingMap none;
    (void)effects.stages(asset, pass, request, none, problems);
    request.defines.clear();
    (void)effects.stages(asset, pass, request, none, problems);
    problems.throwIfErrors();
}

}  // namespace

void cocosEffect(std::string_view input) {
    static const Project kProject;
    const std::size_t mark = input.find(kChunkMark);
    kProject.write("assets/effects/fuzz.effect", input.substr(0, mark));
    kProject.write("assets/chunks/fuzz.chunk",
                   mark == std::string_view::npos ? std::string_view{} : input.substr(mark + kChunkMark.size()));
    expectAnswer([&] {
        cocos::CocosEffects effects(cocos::Roots{{}, kProject.folder.path(), {}});
        Problems problems;
        const EffectAsset asset = effects.parse(kProject.effect, "fuzz", problems);
        problems.throwIfErrors();
        for (const EffectTechnique& technique : asset.techniques)
            for (const EffectPass& pass : technique.passes) expectAnswer([&] { readPass(effects, asset, pass); });
        (void)cocos::reflectEffect(effects, asset, problems).toJson(-1);
        problems.throwIfErrors();
    });
}

}  // namespace crevice::fuzz

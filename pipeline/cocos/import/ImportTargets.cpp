// Formats and clear values are those of the engine's own stages.
#include "cocos/import/ImportTargets.h"

#include <fmt/format.h>

#include "cocos/assets/ObjectGraph.h"

namespace crevice::cocos {
namespace {

Value word(const std::string& text) { return Value::makeString(text); }

Value numbers(std::initializer_list<double> values) {
    Value list = Value::makeArray();
    for (const double value : values) list.items().push_back(Value::makeNumber(value));
    return list;
}

struct FormatWord {
    int number;
    const char* name;
};
/// cocos/gfx/base/define.ts of 3.6; numbers above 53 are depth formats.
constexpr FormatWord kFormats[] = {
    {4, "R8"},       {8, "R16F"},        {11, "R32F"},  {12, "R32UI"},      {14, "RG8"},
    {18, "RG16F"},   {21, "RG32F"},      {35, "RGBA8"}, {37, "RGBA8_SRGB"}, {41, "RGBA16F"},
    {44, "RGBA32F"}, {48, "R11G11B10F"}, {54, "D32F"},  {55, "D32F"},
};

}  // namespace

std::string formatName(std::int64_t gfxFormat) {
    for (const FormatWord& known : kFormats) {
        if (known.number == gfxFormat) return known.name;
    }
    return {};
}

ImportTargets::ImportTargets(bool v33, bool deferred) {
    if (deferred) addGbuffer(v33);
    add("depth", "D32F", "");
    list_.find("depth")->set("clear", Value::makeNumber(1));
    if (deferred) add(v33 ? "cc_lighting_resultMap" : "lightingResult", "RGBA16F", "the lit picture");
    add("finalColor", "RGBA8", "the picture");
}

void ImportTargets::addGbuffer(bool v33) {
    if (v33) {
        add("cc_gbuffer_albedoMap", "RGBA16F", "base colour; its clear value is the background");
        add("cc_gbuffer_positionMap", "RGBA16F", "world position, roughness");
        add("cc_gbuffer_normalMap", "RGBA16F", "world normal, metallic");
        add("cc_gbuffer_emissiveMap", "RGBA16F", "emissive, occlusion of the material");
    } else {
        add("gbufferAlbedo", "RGBA16F", "base colour; its clear value is the background");
        add("gbufferNormal", "RGBA16F", "octahedral world normal, roughness, metallic");
        add("gbufferEmissive", "RGBA16F", "emissive, occlusion of the material");
    }
}

void ImportTargets::add(const std::string& name, const std::string& format, const std::string& help) {
    if (has(name)) return;
    Value target = Value::makeObject();
    target.set("format", word(format));
    if (!help.empty()) target.set("help", word(help));
    list_.set(name, std::move(target));
}

void ImportTargets::addSized(const std::string& name, const std::string& format, double width, double height,
                             const std::string& help) {
    add(name, format, help);
    if (width >= 1 && height >= 1 && width <= 16384 && height <= 16384)
        list_.find(name)->set("size", numbers({width, height}));
}

void ImportTargets::addShadowMap(const std::string& name, const std::string& depth) {
    constexpr double kSize = 1024;  // the engine's default
    addSized(name, "R32F", kSize, kSize, "depth as the light sees it");
    list_.find(name)->set("clear", numbers({1, 1, 1, 1}));
    list_.find(name)->set("sampler", word("point-clamp"));
    addSized(depth, "D32F", kSize, kSize, "");
    list_.find(depth)->set("clear", Value::makeNumber(1));
}

void ImportTargets::addOcclusion(const std::string& name, bool v33) {
    if (has(name)) return;
    add(name, v33 ? "R8" : "RGBA8", "1 = open, 0 = occluded");
    list_.find(name)->set("clear", numbers({1, 1, 1, 1}));
    list_.find(name)->set("sampler", word("point-clamp"));
}

void ImportTargets::addOf(const RppPipeline& pipeline, Project& project, Problems& problems) {
    for (const RppTextureDesc& desc : pipeline.textures) {
        const std::string format = formatName(desc.format);
        if (format.empty())
            problems.note(desc.where, fmt::format("format {} of texture '{}' becomes RGBA8", desc.format, desc.name));
        addSized(desc.name, format.empty() ? "RGBA8" : format, double(desc.width), double(desc.height),
                 "a texture of the pipeline");
    }
    for (const RppRenderTexture& config : pipeline.renderTextures) {
        if (config.name.empty() || !config.texture) continue;
        const MetaAsset* asset =
            project.find(config.texture, fmt::format("render texture '{}'", config.name), problems);
        if (!asset) continue;
        const FieldReader sizes(asset->userData, problems);
        addSized(config.name, "RGBA8", sizes.number("width", 0), sizes.number("height", 0),
                 fmt::format("render texture '{}'", asset->path.filename().string()));
    }
}

}  // namespace crevice::cocos

// Every technique and pass of every shipped effect compiles with its default macros and the contract's binding numbers.
#include <gtest/gtest.h>

#include "EffectTestTools.h"

namespace crevice {
namespace {

/// Compiles one variant; true when nothing in it went wrong.
bool compiles(EffectLibrary& library, const VariantRequest& request, EffectVariant& out) {
    try {
        out = library.get(request, contractBindings());
        const Material material(library.get(request, contractBindings()));
        return true;
    } catch (const Error& error) {
        ADD_FAILURE() << formatError(error);
        return false;
    }
}

/// The sizes that C++ fills and the rule that set 1 holds nothing of the pipeline's own.
void expectContract(const ShaderInfo& info, const Defines& defines) {
    const auto version = defines.find("COCOS_VERSION");
    const std::uint32_t camera = version != defines.end() && version->second == "36" ? 592 : 544;
    const std::map<std::string, std::uint32_t> sizes = {{"CCGlobal", 48},     {"CCCamera", camera}, {"CCShadow", 304},
                                                        {"CCSpotShadow", 96}, {"CCSsao", 1040},     {"CCLocal", 144}};
    for (const ShaderResource& resource : info.resources) {
        const auto size = sizes.find(resource.name);
        EXPECT_TRUE(size == sizes.end() || size->second == resource.size) << resource.name << ": " << resource.size;
        EXPECT_FALSE(resource.slot.set == 1 && resource.name.starts_with("CC")) << resource.name;
        EXPECT_GT(resource.where.line, 0) << resource.name;
    }
}

/// The default macros, then each macro alone at each of its other values.
std::vector<Defines> variations(const std::vector<DefineInfo>& infos) {
    std::vector<Defines> all = {{}};
    for (const DefineInfo& info : infos) {
        if (info.ownDefault) continue;
        if (info.type == DefineType::Bool) all.push_back({{info.name, info.defaultValue == "0" ? "1" : "0"}});
        for (const std::string& option : info.options) all.push_back({{info.name, option}});
        if (info.range) {
            all.push_back({{info.name, std::to_string(info.range->first)}});
            all.push_back({{info.name, std::to_string(info.range->second)}});
        }
    }
    return all;
}

void compileVariations(EffectLibrary& library, VariantRequest request, const EffectPass& pass) {
    for (const Defines& defines :
         variations(library.discoverDefines(request.effect, request.technique, request.pass))) {
        const std::string macro = defines.empty() ? "" : defines.begin()->first;
        if (pass.embeddedMacros.contains(macro)) continue;  // Fixed by the pass.
        SCOPED_TRACE(defines.empty() ? "default macros" : macro + "=" + defines.begin()->second);
        request.defines = defines;
        EffectVariant variant;
        if (compiles(library, request, variant)) expectContract(variant.info, defines);
    }
}

TEST(EffectShipped, EveryPassCompilesWithEveryMacroAlone) {
    keepCompilerWarm();
    const AssetRoots roots = AssetRoots::standard();
    EffectLibrary library(roots, Log(LogLevel::Error), {.useDiskCache = false});
    // Stands for the kernel that SsaoStage bakes; its length is that of the default SSAO_SAMPLES.
    std::string kernel = "const vec3 kSsaoKernel[64] = vec3[64](vec3(0.0)";
    for (int i = 1; i < 64; ++i) kernel += ", vec3(0.0)";
    library.setChunk("ssao-kernel", kernel + ");\n");
    const std::vector<std::string> names = roots.list(AssetKind::Effect);
    ASSERT_FALSE(names.empty());
    for (const std::string& name : names) {
        SCOPED_TRACE(name);
        VariantRequest request;
        request.effect = name;
        try {
            const EffectAsset& asset = library.asset(name);
            for (request.technique = 0; request.technique < asset.techniques.size(); ++request.technique)
                for (request.pass = 0; request.pass < asset.techniques[request.technique].passes.size(); ++request.pass)
                    compileVariations(library, request, asset.techniques[request.technique].passes[request.pass]);
        } catch (const Error& error) {
            ADD_FAILURE() << formatError(error);
        }
    }
}

}  // namespace
}  // namespace crevice

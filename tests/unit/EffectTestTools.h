// What the tests of effects share: effects as strings in a private folder, and the contract's binding numbers.
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>

#include "effect/EffectLibrary.h"
#include "effect/Material.h"
#include "effect/ShaderCompiler.h"

namespace crevice {

/// Set 0 and 2 as the standard pipelines number them.
inline BindingMap contractBindings() {
    BindingMap map = {{"CCGlobal", {0, 0}},
                      {"CCCamera", {0, 1}},
                      {"CCShadow", {0, 2}},
                      {"cc_shadowMap", {0, 3}},
                      {"cc_environment", {0, 4}},
                      {"cc_spotLightingMap", {0, 5}},
                      {"cc_gbuffer_albedoMap", {0, 6}},
                      {"cc_gbuffer_positionMap", {0, 7}},
                      {"cc_gbuffer_normalMap", {0, 8}},
                      {"cc_gbuffer_emissiveMap", {0, 9}},
                      {"cc_lighting_resultMap", {0, 10}},
                      {"cc_ssaoMap", {0, 11}},
                      {"CCSsao", {0, 12}},
                      {"cc_ssaoBlurMap", {0, 13}},
                      {"CCSpotShadow", {0, 28}},
                      {"CCPunctualLights", {0, 30}},
                      {"CCLightGrid", {0, 31}},
                      {"CCEnvironment", {0, 60}},
                      {"cc_environmentBrdf", {0, 61}},
                      {"CCLocal", {2, 0}},
                      {"CCForwardLight", {2, 1}}};
    return map;
}

/// A folder of its own that goes away with the test.
class EffectFolder {
public:
    EffectFolder() {
        static std::atomic<int> count{0};
        path_ = std::filesystem::temp_directory_path() /
                ("crevice-effect-" + std::to_string(getpid()) + "-" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~EffectFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    EffectFolder(const EffectFolder&) = delete;
    EffectFolder& operator=(const EffectFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    void write(const std::string& name, const std::string& text) const {
        const auto file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file) << text;
    }

private:
    std::filesystem::path path_;
};

/// glslang's tables take 60 ms to build and go with the last compiler: one that stays keeps the tests quick.
inline void keepCompilerWarm() {
    static ShaderCompiler warm;
    static const bool once = [] {
        StageSource source;
        source.stage = kComputeBit;
        source.head = "#version 450\n";
        source.text = "void main() {}\n";
        Problems problems;
        warm.compile({&source, 1}, {}, problems);
        return !problems.hasErrors();
    }();
    (void)once;
}

/// An asset root with effects written by the test, and a library over it without a disk cache.
class EffectBench {
public:
    EffectBench() { keepCompilerWarm(); }

    EffectFolder folder;
    EffectLibrary effects{AssetRoots({folder.path()}), Log(LogLevel::Error), {.useDiskCache = false}};

    void effect(const std::string& text) const { folder.write("effects/e.effect", text); }
    void chunk(const std::string& name, const std::string& text) const {
        folder.write("effects/chunks/" + name + ".chunk", text);
    }
    /// A full-screen effect: header lines of the pass (6 spaces deep) and the fragment program's text.
    void fullscreen(const std::string& fragment, const std::string& passLines = "") const {
        effect("CCEffect %{\n  techniques:\n  - passes:\n    - vert: vs\n      frag: fs\n" + passLines +
               "}%\nCCProgram vs %{\n  out vec2 v_uv;\n  void main() { v_uv = vec2(gl_VertexIndex); gl_Position = "
               "vec4(v_uv, 0.0, 1.0); }\n}%\n"
               "CCProgram fs %{\n" +
               fragment + "}%\n");
    }
    std::string file() const { return (folder.path() / "effects/e.effect").string(); }

    const EffectVariant& get(const Defines& defines = {}, const BindingMap& bindings = contractBindings()) {
        VariantRequest request;
        request.effect = "e";
        request.defines = defines;
        request.where = {"ask.json", 7, 3, 1};
        return effects.get(request, bindings);
    }
    /// The problem that get() reports; an empty message when it succeeds.
    Problem problem(const Defines& defines = {}) {
        try {
            get(defines);
        } catch (const Error& error) {
            return error.problems().front();
        }
        return {};
    }
};

}  // namespace crevice

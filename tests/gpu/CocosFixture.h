// The article's project in our own words (tests/cocos/article-v33 and article-v36), imported and rendered.
#pragma once

#include "FrameFixture.h"

#include <regex>

#include "cocos/CocosEffects.h"
#include "cocos/import/Import.h"

namespace crevice {

class CocosTest : public FrameTest {
protected:
    static constexpr const char* kBoth[] = {"article-v33", "article-v36"};

    static cocos::Roots rootsOf(const std::string& article);

    /// The project's .rpp as a document of ours. Its warnings are kept in `importWarnings_`.
    std::string imported(const std::string& article) {
        const cocos::Roots roots = rootsOf(article);
        cocos::CocosEffects effects(roots);
        Problems problems;
        cocos::Project project(
            roots,
            [&](const std::filesystem::path& path, const std::string& name, Problems& own) {
                return effects.parse(path, name, own);
            },
            problems);
        cocos::ImportRequest request{.rpp = roots.project / "assets/pipeline/ssao-deferred-pipeline.rpp"};
        for (const StageClass& known : renderer_->stages().classes())
            request.classes.push_back({.name = known.name,
                                       .params = {},
                                       .writes = known.name == "SsaoStage" ? std::vector<std::string>{"cc_ssaoMap"}
                                                                           : std::vector<std::string>{}});
        const cocos::ImportedPipeline result = cocos::importPipeline(request, project, problems);
        problems.throwIfErrors();
        for (const Problem& problem : problems.all())
            if (problem.severity == Severity::Warning) importWarnings_.push_back(problem.message);
        return result.text;
    }

    /// `from` in the document becomes `to`, and `targets` (members of an object, each with a comma) join its targets.
    void loadArticle(const std::string& article, Sets sets = {}, const std::string& from = {},
                     const std::string& to = {}, const std::string& targets = {}) {
        // Whether an object begins on a line of its own is the importer's taste.
        std::string text = std::regex_replace(imported(article), std::regex("\\{\\s+\""), "{ \"");
        const auto replace = [&](const std::string& old, const std::string& fresh) {
            const std::size_t at = text.find(old);
            ASSERT_NE(at, std::string::npos) << old << '\n' << text;
            text.replace(at, old.size(), fresh);
        };
        if (!from.empty()) replace(from, to);
        if (!targets.empty()) replace("\"targets\": {", "\"targets\": { " + targets);
        writeFileAtomically(folder_ / "test.pipeline.json", text);
        renderer_->effects().addFrontEnd(std::make_unique<cocos::CocosEffects>(rootsOf(article)));
        sets.push_back({"SsaoStage.params.seed", "7"});
        takeWarnings();
        load((folder_ / "test.pipeline.json").string(), {}, std::move(sets));
    }

    static Value numbers(std::initializer_list<float> values) {
        Value list = Value::makeArray();
        for (const float value : values) list.items().push_back(Value::makeReal(double(value)));
        return list;
    }

    /// A glTF material without textures as builtin-standard's values; `linear` colours are squared by the runtime.
    static MaterialEffect standardOf(const SceneMaterial& material) {
        MaterialPass pass{.defines = {}, .states = {}, .properties = Value::makeObject()};
        const glm::vec4 base = glm::vec4(glm::sqrt(glm::vec3(material.baseColor)), material.baseColor.a);
        const float most = std::max({1.0f, material.emissive.x, material.emissive.y, material.emissive.z});
        const glm::vec3 emissive = glm::sqrt(material.emissive / most);
        pass.properties.set("mainColor", numbers({base.x, base.y, base.z, base.w}));
        pass.properties.set("roughness", Value::makeReal(double(material.roughness)));
        pass.properties.set("metallic", Value::makeReal(double(material.metallic)));
        pass.properties.set("emissive", numbers({emissive.x, emissive.y, emissive.z, 1}));
        pass.properties.set("emissiveScale", numbers({most, most, most}));
        MaterialEffect effect{.effect = "builtin-standard", .technique = 0, .passes = {}};
        if (material.alphaMode == AlphaMode::Blend) effect.technique = 1;
        effect.passes = {pass, pass};
        return effect;
    }
    static Scene withEffects(Scene scene) {
        for (SceneMaterial& material : scene.materials) material.effect = standardOf(material);
        return scene;
    }
    /// The shipped scene without its sky, which Cocos' deferred pipeline has no pass for.
    Scene cloister() const {
        Scene scene = shippedScene("default");
        scene.sky.enabled = false;
        return scene;
    }

    /// Takes the warnings so far out of those that fail the test.
    std::vector<std::string> takeWarnings() { return std::exchange(messages_, {}); }

    std::vector<std::string> importWarnings_;
};

}  // namespace crevice

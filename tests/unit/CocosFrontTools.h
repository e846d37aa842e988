// What the tests of Cocos' front end share: a project and an engine folder written by the test, and what comes of a
// pass.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "EffectTestTools.h"
#include "cocos/CocosEffects.h"

namespace crevice::cocos {

/// A project (below p/) and an engine (below e/) of the test's own.
class CocosBench {
public:
    EffectFolder folder;

    void chunk(const std::string& name, const std::string& text) const {
        folder.write("p/assets/chunks/" + name + ".chunk", text);
    }
    void engineChunk(const std::string& name, const std::string& text) const {
        folder.write("e/editor/assets/chunks/" + name + ".chunk", text);
    }
    /// A pass `vs`, `fs` whose programs are the texts; `more` follows them in the file.
    void effect(const std::string& vertex, const std::string& fragment, const std::string& more = "",
                const std::string& passLines = "") const {
        folder.write("p/assets/effects/t.effect",
                     "CCEffect %{\n  techniques:\n  - passes:\n    - vert: vs\n      frag: fs\n" + passLines +
                         "}%\nCCProgram vs %{\n" + vertex + "}%\nCCProgram fs %{\n" + fragment + "}%\n" + more);
    }
    /// An effect that is only a fragment program.
    void fragment(const std::string& text, const std::string& more = "") const {
        effect("void main() { gl_Position = vec4(0.0); }\n", text, more);
    }
    std::string file() const { return (folder.path() / "p/assets/effects/t.effect").string(); }
    Roots roots() const { return {{}, folder.path() / "p", folder.path() / "e"}; }

    EffectAsset parse(Problems& problems, const std::string& name = "t") const {
        CocosEffects effects(roots());
        const auto path = effects.find(name);
        if (!path) {
            problems.error({}, "no effect '" + name + "'");
            return {};
        }
        return effects.parse(*path, name, problems);
    }
    /// The flattened stages of the first pass.
    std::vector<StageText> flatten(Problems& problems) const {
        CocosEffects effects(roots());
        const EffectAsset asset = parse(problems);
        if (problems.hasErrors()) return {};
        return effects.flatten(asset, asset.techniques[0].passes[0], problems);
    }
    StageText fragmentText() const {
        Problems problems;
        auto stages = flatten(problems);
        problems.throwIfErrors();
        return std::move(stages.back());
    }
    /// The first error; an empty message when there is none.
    Problem problem() const {
        Problems problems;
        try {
            flatten(problems);
        } catch (const Error& error) {
            return error.problems().front();
        }
        for (const Problem& one : problems.all())
            if (one.severity == Severity::Error) return one;
        return {};
    }
    /// Compiles the first pass to SPIR-V; throws what is wrong with it.
    EffectVariant compile(const Defines& defines = {}, const BindingMap& bindings = {}, const std::string& name = "t",
                          std::size_t technique = 0, std::size_t pass = 0) const {
        keepCompilerWarm();
        EffectLibrary library(AssetRoots({folder.path() / "none"}), Log(LogLevel::Error), {.useDiskCache = false});
        library.addFrontEnd(std::make_unique<CocosEffects>(roots()));
        VariantRequest request;
        request.effect = name;
        request.defines = defines;
        request.technique = technique;
        request.pass = pass;
        request.where = {"ask.json", 7, 3, 1};
        return library.get(request, bindings);
    }
    std::string compileError(const Defines& defines = {}) const {
        try {
            compile(defines);
        } catch (const Error& error) {
            return formatError(error);
        }
        return {};
    }
};

/// The lines of a text without leading and trailing blanks, empty ones left out.
inline std::vector<std::string> words(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string line = text.substr(at, end - at);
        while (!line.empty() && line.front() == ' ') line.erase(0, 1);
        while (!line.empty() && line.back() == ' ') line.pop_back();
        if (!line.empty()) lines.push_back(line);
        at = end + 1;
    }
    return lines;
}

inline std::vector<std::string> macroNames(const StageText& stage) {
    std::vector<std::string> names;
    for (const StageMacro& macro : stage.macros) names.push_back(macro.info.name);
    return names;
}

/// Where a line with `part` comes from: "file-name:line".
inline std::string originOf(const StageText& stage, const std::string& part) {
    const auto at = stage.flat.text.find(part);
    if (at == std::string::npos) return "absent";
    const auto line =
        std::count(stage.flat.text.begin(), stage.flat.text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    const SourceLoc where = stage.flat.locate(static_cast<int>(line) + 1);
    return std::filesystem::path(where.file).filename().string() + ":" + std::to_string(where.line);
}

}  // namespace crevice::cocos

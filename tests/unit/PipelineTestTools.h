// Small helpers for the tests of pipeline documents: parse from memory, catch the problems, load with files.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "plan/PipelineAsset.h"

namespace crevice::test {

inline PipelineDesc parse(const std::string& text, const PipelineRequest& request = {}) {
    return parsePipeline(text, "test.json", AssetRoots({}), request);
}

/// All problems of a document in one text, empty when it loads: "line:column: message | help" each.
inline std::string problemsOf(const std::string& text, const PipelineRequest& request = {}) {
    try {
        parse(text, request);
    } catch (const Error& error) {
        std::string all;
        for (const Problem& problem : error.problems()) {
            all += std::to_string(problem.where.line) + ":" + std::to_string(problem.where.column) + ": " +
                   problem.message;
            for (const Remark& remark : problem.remarks)
                all += " [" + std::to_string(remark.where.line) + ": " + remark.message + "]";
            all += " | " + problem.help + "\n";
        }
        return all;
    }
    return {};
}

/// A document with one target `out`, an option of each type and one stage; extra keys of each are filled in.
inline std::string document(const std::string& targetKeys, const std::string& stageKeys,
                            const std::string& topKeys = "") {
    return R"({ "name": "t", "output": "out",
"options": { "on": { "type": "bool", "default": true }, "level": { "type": "number", "default": 0.5, "min": 0, "max": 8 },
             "mode": { "type": "choice", "default": "slow", "choices": ["slow", "fast"] } },
"targets": { "out": { "format": "RGBA8")" +
           targetKeys + R"( } },
"flows": [ { "flow": "Main", "stages": [ { "stage": "FullscreenStage")" +
           stageKeys + R"( } ] } ])" + topKeys + " }";
}

/// A folder that is an asset root and goes away with the test.
class AssetFolder {
public:
    AssetFolder() {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        root_ = std::filesystem::temp_directory_path() / (std::string("crevice-") + test->test_suite_name() + "-" +
                                                          test->name() + "-" + std::to_string(::getpid()));
        std::filesystem::create_directories(root_);
    }
    ~AssetFolder() { std::filesystem::remove_all(root_); }
    AssetFolder(const AssetFolder&) = delete;
    AssetFolder& operator=(const AssetFolder&) = delete;

    void write(const std::string& path, const std::string& text) const {
        std::filesystem::create_directories((root_ / path).parent_path());
        std::ofstream(root_ / path) << text;
    }
    void pipeline(const std::string& name, const std::string& text) const {
        write("assets/pipelines/" + name + ".pipeline.json", text);
    }
    AssetRoots roots() const { return AssetRoots({root_}); }
    const std::filesystem::path& path() const { return root_; }

private:
    std::filesystem::path root_;
};

inline std::string stageOrder(const PipelineDesc& desc) {
    std::string order;
    for (const FlowDesc& flow : desc.flows) {
        order += flow.name + ":";
        for (const StageDesc& stage : flow.stages) order += (stage.enabled ? " " : " -") + stage.name;
        order += "\n";
    }
    return order;
}

inline const StageDesc& stageOf(const PipelineDesc& desc, const std::string& name) {
    for (const FlowDesc& flow : desc.flows)
        for (const StageDesc& stage : flow.stages)
            if (stage.name == name) return stage;
    throw Error("no stage " + name);
}

/// Two flows of two stages, two targets, one option.
inline constexpr const char* kBase = R"({
  "name": "base", "output": "out",
  "options": { "fast": { "type": "bool", "default": false } },
  "targets": { "out": { "format": "RGBA8" }, "aux": { "format": "R16F", "scale": 0.5 } },
  "flows": [
    { "flow": "First", "priority": 1, "stages": [ { "stage": "A" }, { "stage": "B", "effect": "b", "material": { "x": 1, "y": 2 } } ] },
    { "flow": "Last", "priority": 5, "stages": [ { "stage": "C" }, { "stage": "D" } ] } ]
})";

inline PipelineDesc load(const AssetFolder& folder, const std::string& name, PipelineRequest request = {}) {
    request.nameOrPath = name;
    return loadPipeline(folder.roots(), request);
}

/// A child of kBase with more keys.
inline PipelineDesc child(const std::string& keys, PipelineRequest request = {}) {
    AssetFolder folder;
    folder.pipeline("base", kBase);
    folder.pipeline("child", R"({ "extends": "base", )" + keys + " }");
    return load(folder, "child", std::move(request));
}

}  // namespace crevice::test

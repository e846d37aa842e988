// The fixture of the plan's tests: a document and its stages, written in a few words.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "plan/FramePlan.h"

namespace crevice {

/// A document under construction: targets on line 1, 2 … of d.json, stages on line 101, 102 ….
class PlanRules : public ::testing::Test {
protected:
    TargetDesc& target(const char* name, Format format = Format::RGBA8) {
        TargetDesc target;
        target.name = name;
        target.format = format;
        target.where = {"d.json", static_cast<int>(desc_.targets.size()) + 1, 5, 1};
        if (desc_.targets.empty()) desc_.output = name;
        desc_.targets.push_back(target);
        return desc_.targets.back();
    }

    StageUse& stage(const char* name) {
        StageUse use;
        use.stage = name;
        use.flow = "F";
        use.where = {"d.json", static_cast<int>(uses_.size()) + 101, 7, 1};
        uses_.push_back(use);
        return uses_.back();
    }

    static TargetWrite write(const char* name, WriteKind kind = WriteKind::Color, std::uint32_t mip = 0) {
        return {name, kind, false, mip, {}};
    }
    static TargetRead read(const char* name) { return {name, false, 0, name, {"e.effect", 34, 3, 1}}; }
    static TargetRead load(const char* name) { return {name, true, 0, name, {"e.effect", 35, 3, 1}}; }
    static TargetRead level(const char* name, std::uint32_t mip) {
        return {name, false, mip, name, {"e.effect", 36, 3, 1}, true};
    }

    FramePlan plan() { return planFrame(desc_, uses_); }

    /// The one error of the frame.
    Problem refusal() {
        std::vector<Problem> errors;
        try {
            plan();
        } catch (const Error& error) {
            for (const Problem& problem : error.problems()) {
                if (problem.severity == Severity::Error) errors.push_back(problem);
            }
        }
        EXPECT_EQ(errors.size(), 1u);
        for (const Problem& problem : errors) {
            EXPECT_FALSE(problem.help.empty()) << problem.message;
            EXPECT_FALSE(problem.where.file.empty()) << problem.message;
        }
        return errors.empty() ? Problem{} : errors[0];
    }

    /// "warning: …" and "note: …" of a plan that is accepted.
    std::vector<std::string> remarks() {
        std::vector<std::string> lines;
        const FramePlan planned = plan();
        for (const Problem& problem : planned.notes.all()) {
            lines.push_back((problem.severity == Severity::Warning ? "warning: " : "note: ") + problem.message);
        }
        return lines;
    }

    PipelineDesc desc_;
    std::vector<StageUse> uses_;
};

}  // namespace crevice

// Code and facts of the stages that were compiled last: passes share their programs.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "effect/ShaderCompiler.h"
#include "effect/StageFacts.h"

namespace crevice {

/// Of numbered stages, which do not depend on each other.
class RecentStages {
public:
    struct Stage {
        StageCode code;
        std::shared_ptr<const StageFacts> facts;
    };
    /// Compiles what it does not have; with `check` also validates what was not validated. Nothing beside errors in
    /// `problems`.
    std::optional<Stage> get(const StageSource& source, bool check, ShaderCompiler& compiler, Problems& problems);

private:
    struct Kept {
        std::string key;  ///< Hash of its text, and of the macros that it names.
        Stage stage;
        bool checked = false;
        /// The places that the facts name: another file may have the same text.
        std::vector<std::string> files;
        std::vector<FlatSource::Origin> lines;
    };

    Kept* find(const StageSource& source, ShaderCompiler& compiler, Problems& problems);

    std::deque<Kept> kept_;  ///< Newest first.
};

}  // namespace crevice

// Light from all around as the command line names it: a panorama, the computed sky, or none.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "core/Log.h"
#include "scene/Scene.h"
#include "scene/SceneFields.h"

namespace CLI {
class App;
}

namespace crevice {

/// As given; empty = not given.
struct EnvironmentOptions {
    std::string environment;                    ///< FILE, "sky" or "none".
    std::map<std::string, std::string> fields;  ///< "rotation" → "90": the other fields of a scene's "environment".
};
/// `--environment`, and `--environment-FIELD` for every field that a scene document has.
void addEnvironmentOptions(CLI::App& command, EnvironmentOptions& options);

/// The options, checked, and the panorama once it is loaded.
class EnvironmentChoice {
public:
    EnvironmentChoice() = default;
    /// Throws Error: a value that is no number or out of range, a field without --environment.
    explicit EnvironmentChoice(const EnvironmentOptions& options);

    bool isNone() const { return file_ == "none"; }
    /// Puts the environment in the place of the scene's own, or changes that one. Throws Error: the file cannot be
    /// read.
    void apply(Scene& scene, const Log& log, const Limits& limits = {});

private:
    std::string file_;
    EnvironmentOptions given_;
    std::optional<Environment> loaded_;
};

}  // namespace crevice

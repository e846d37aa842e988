// Internal to the importer: one Cocos stage becomes one of ours; a forward stage two.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "cocos/import/Import.h"
#include "cocos/import/ImportTargets.h"

namespace crevice::cocos {

class StageImporter {
public:
    /// `forward`: the pipeline lights while it draws.
    StageImporter(const ImportRequest& request, const VersionChoice& version, Project& project, ImportTargets& targets,
                  bool forward, Problems& problems);

    /// Our stages for one of Cocos', each an object of the document. Empty for those that are left out, with a note.
    std::vector<Value> translate(const RppStage& stage);

private:
    std::vector<Value> shadowStage(const RppStage& stage);
    std::vector<Value> geometryStage(const RppStage& stage);
    std::vector<Value> lightingStage(const RppStage& stage);
    /// `target`: what it draws into; null: the lit picture.
    void addSky(const RppStage& stage, const char* target, std::vector<Value>& stages);
    std::vector<Value> postProcessStage(const RppStage& stage);
    std::vector<Value> userStage(const RppStage& stage);

    Value begin(const std::string& ourClass, const RppStage& stage, const std::string& suffix = {});
    /// Effect, defines and values of the material in a field; the built-in effect when the field is null.
    void addMaterial(Value& out, const RppStage& stage, std::string_view field, const std::string& builtin);
    void addMaterialOf(Value& out, const AssetRef& ref, const std::string& what);
    Value queuesOf(const RppStage& stage, bool transparent);
    void noteFields(const RppStage& stage, std::initializer_list<std::string_view> used);
    const StageFacts* factsOf(const std::string& name) const;
    void unknownClass(const RppStage& stage);

    const ImportRequest& request_;
    const VersionChoice& version_;
    Project& project_;
    ImportTargets& targets_;
    bool forward_;
    Problems& problems_;
    std::set<std::string> names_;
};

}  // namespace crevice::cocos

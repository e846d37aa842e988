// Cocos Creator's effects as a front end of the effect library: unmodified .effect and .chunk files in, texts for the
// compiler out.
#pragma once

#include <memory>
#include <vector>

#include "cocos/files/Roots.h"
#include "cocos/text/StageText.h"
#include "effect/EffectFrontEnd.h"

namespace crevice::cocos {

/// Effects are named by their path below a folder effects/, else below the assets folder
/// (`pipeline/deferred-lighting`); the end of that path is enough where one file alone has it; a path that ends with
/// .effect must lie in the project, the engine or a chunk folder. Files are read once. The rules of the format:
/// docs/from-cocos.md.
class CocosEffects final : public EffectFrontEnd {
public:
    struct Options {
        NumberingOptions numbering{};
    };
    explicit CocosEffects(Roots roots, Options options);
    explicit CocosEffects(Roots roots);
    ~CocosEffects() override;

    std::optional<std::filesystem::path> find(const std::string& effect) const override;
    std::optional<std::filesystem::path> findShort(const std::string& effect) const override;
    std::vector<std::string> names() const override;

    EffectAsset parse(const std::filesystem::path& path, const std::string& name, Problems& problems) override;
    std::string fingerprint() override;
    std::vector<DefineInfo> defines(const EffectAsset& effect, const EffectPass& pass, Problems& problems) override;
    std::vector<StageSource> stages(const EffectAsset& effect, const EffectPass& pass, const VariantRequest& request,
                                    const BindingMap& bindings, Problems& problems) override;

    /// The stages of a pass before their interface is numbered, vertex before fragment. Empty where `problems` got an
    /// error.
    std::vector<StageText> flatten(const EffectAsset& effect, const EffectPass& pass, Problems& problems);

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The macros of all stages together: each name once, in order of first occurrence, as the text has them.
std::vector<StageMacro> joinMacros(const std::vector<StageText>& stages);
/// The same with the values they have when nobody sets them.
std::vector<StageMacro> mergeMacros(const std::vector<StageText>& stages);

/// The lines in front of a stage's text: version, extensions, engine constants, and `#define NAME value` for every
/// macro in `macros` that the text does not define itself. Values: bools as 1 and 0, numbers as given, else the lowest
/// of the range, words as given, else the first option. A macro that is only asked whether it is defined (#ifdef,
/// #ifndef, defined()) stays undefined while its value is 0. Names in `values` that are no macro of the shader say
/// nothing.
std::string makeHead(const StageText& stage, const std::vector<StageMacro>& macros, const Defines& values);

}  // namespace crevice::cocos

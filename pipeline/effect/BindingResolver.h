// glslang's I/O resolver with our rule: names decide sets, bindings and locations. Included only where glslang is.
#pragma once

#include <glslang/MachineIndependent/iomapper.h>
#include <glslang/Public/ShaderLang.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/Error.h"
#include "effect/ShaderInfo.h"

namespace crevice {

/// Numbers all stages of one program together. Facts about glslang 12 that shape it: the mapper notifies every stage
/// before it resolves any; values returned are ignored, only those written into the entry count; a block is known by
/// its type name.
class BindingResolver final : public glslang::TIoMapResolver {
public:
    /// `place` tells where a name is declared in a stage.
    using Place = std::function<SourceLoc(EShLanguage stage, const std::string& name)>;
    BindingResolver(const BindingMap& bindings, Place place, Problems& problems);

    void notifyBinding(EShLanguage stage, glslang::TVarEntryInfo& entry) override;
    void notifyInOut(EShLanguage stage, glslang::TVarEntryInfo& entry) override;
    int resolveBinding(EShLanguage stage, glslang::TVarEntryInfo& entry) override;
    int resolveSet(EShLanguage stage, glslang::TVarEntryInfo& entry) override;
    int resolveInOutLocation(EShLanguage stage, glslang::TVarEntryInfo& entry) override;

    // Everything else has nothing to say: -1 keeps what the shader has.
    bool validateBinding(EShLanguage, glslang::TVarEntryInfo&) override { return true; }
    bool validateInOut(EShLanguage, glslang::TVarEntryInfo&) override { return true; }
    int resolveUniformLocation(EShLanguage, glslang::TVarEntryInfo&) override { return -1; }
    int resolveInOutComponent(EShLanguage, glslang::TVarEntryInfo&) override { return -1; }
    int resolveInOutIndex(EShLanguage, glslang::TVarEntryInfo&) override { return -1; }
    void beginNotifications(EShLanguage) override {}
    void endNotifications(EShLanguage) override {}
    void beginResolve(EShLanguage) override {}
    void endResolve(EShLanguage) override {}
    void beginCollect(EShLanguage) override {}
    void endCollect(EShLanguage) override {}
    void reserverStorageSlot(glslang::TVarEntryInfo&, TInfoSink&) override {}
    void reserverResourceSlot(glslang::TVarEntryInfo&, TInfoSink&) override {}
    void addStage(EShLanguage, glslang::TIntermediate&) override {}

private:
    enum class Category { Block, Sampler, StorageBuffer, StorageImage, Other };
    struct Resource {
        std::string name;
        Category category = Category::Other;
        EShLanguage stage = EShLangVertex;
        long long order = 0;         ///< Symbol id: ascending in order of declaration within a stage.
        int set = -1, binding = -1;  ///< Explicit numbers; -1 = none.
        SourceLoc where;
    };
    /// A variable between stages. `side`: 0 vertex inputs, 1 vertex outputs and fragment inputs, 2 fragment outputs.
    struct Varying {
        std::string name;
        int side = 0;
        EShLanguage stage = EShLangVertex;
        bool isInput = false;
        bool live = false;
        long long order = 0;
        int explicitLocation = -1;
        int size = 1;
    };

    void finish();
    void assignBindings();
    void checkNumbers(const Resource& resource, const BindingSlot& slot);
    void assignLocations(int side);
    void checkProducers();

    const BindingMap& bindings_;
    Place place_;
    Problems& problems_;
    std::vector<Resource> resources_;
    std::vector<Varying> varyings_;
    BindingMap slots_;
    std::map<std::pair<int, std::string>, int> locations_;
    bool finished_ = false;
};

}  // namespace crevice

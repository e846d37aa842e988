// Reserve, then hand out: locations per side, bindings of set 1 per kind; then a pipeline's names over all that.
#include "cocos/interface/Numbering.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace crevice::cocos {
namespace {

constexpr std::uint32_t kGlobalSet = 0, kMaterialSet = 1, kLocalSet = 2;
constexpr int kMostLocations = 4096;

using Locations = std::map<std::string, int, std::less<>>;

/// Hands out the locations of one side in the order of declarations.
class LocationAllocator {
public:
    LocationAllocator(Locations& locations, Problems& problems) : locations_(locations), problems_(problems) {}

    void reserve(const InterfaceDeclaration& declaration) {
        if (declaration.literal.location < 0) return;
        if (!explicit_.emplace(declaration.name, declaration.literal.location).second) return;
        locations_[declaration.name] = declaration.literal.location;
        take(declaration.literal.location, declaration.locations);
    }

    void assign(const InterfaceDeclaration& declaration) {
        if (explicit_.contains(declaration.name)) return;
        const auto size = static_cast<int>(std::max<std::int64_t>(1, declaration.locations));
        while (!isFree(next_, size)) ++next_;
        if (next_ + size > kMostLocations) {
            if (!full_)
                problems_.error(declaration.where, fmt::format("no location is left for '{}'", declaration.name),
                                fmt::format("a stage has at most {}", kMostLocations));
            full_ = true;
            return;
        }
        locations_[declaration.name] = next_;
        take(next_, size);
        next_ += size;
    }

    bool knows(const std::string& name) const { return locations_.contains(name); }

private:
    void take(int first, std::int64_t size) {
        for (int i = 0; i < size; ++i) taken_.insert(first + i);
    }
    bool isFree(int first, int size) const {
        const auto it = taken_.lower_bound(first);
        return it == taken_.end() || *it >= first + size;
    }

    Locations& locations_;
    Problems& problems_;
    std::map<std::string, int, std::less<>> explicit_;
    std::set<int> taken_;
    int next_ = 0;
    bool full_ = false;
};

const StageInterface* stageOf(const std::vector<StageInterface>& stages, ShaderStageBits bit) {
    for (const StageInterface& stage : stages)
        if (stage.stage == bit) return &stage;
    return nullptr;
}

template <class Visit>
void forEachOf(const StageInterface* stage, InterfaceKind kind, Visit visit) {
    if (stage == nullptr) return;
    for (const InterfaceDeclaration& declaration : stage->declarations)
        if (declaration.kind == kind) visit(declaration);
}

void numberOneSide(const StageInterface* stage, InterfaceKind kind, Locations& locations, Problems& problems) {
    LocationAllocator allocator(locations, problems);
    forEachOf(stage, kind, [&](const auto& d) { allocator.reserve(d); });
    forEachOf(stage, kind, [&](const auto& d) { allocator.assign(d); });
}

void numberVaryings(const StageInterface* vertex, const StageInterface* fragment, Locations& locations,
                    Problems& problems) {
    LocationAllocator allocator(locations, problems);
    forEachOf(vertex, InterfaceKind::Output, [&](const auto& d) { allocator.reserve(d); });
    std::set<std::string, std::less<>> written;
    forEachOf(vertex, InterfaceKind::Output, [&](const auto& d) { written.insert(d.name); });
    forEachOf(fragment, InterfaceKind::Input, [&](const auto& d) { allocator.reserve(d); });
    forEachOf(vertex, InterfaceKind::Output, [&](const auto& d) { allocator.assign(d); });
    forEachOf(fragment, InterfaceKind::Input, [&](const auto& d) {
        if (!written.contains(d.name)) allocator.assign(d);
    });
}

/// Sets 0 and 2 carry the author's numbers; one that has none takes what the others leave.
void numberBuiltins(const std::vector<const InterfaceDeclaration*>& resources, BindingMap& slots, Problems& problems) {
    std::set<BindingSlot> taken;
    const auto setOf = [](const InterfaceDeclaration& d) {
        return d.builtin == Builtin::Global ? kGlobalSet : kLocalSet;
    };
    for (const InterfaceDeclaration* d : resources) {
        if (d->builtin == Builtin::None || d->literal.binding < 0) continue;
        const BindingSlot slot{setOf(*d), static_cast<std::uint32_t>(d->literal.binding)};
        taken.insert(slots.emplace(d->name, slot).first->second);
    }
    for (const InterfaceDeclaration* d : resources) {
        if (d->builtin == Builtin::None || slots.contains(d->name)) continue;
        BindingSlot slot{setOf(*d), 0};
        while (taken.contains(slot)) ++slot.binding;
        problems.warning(d->where, fmt::format("builtin '{}' has no layout(set = {}, binding = …)", d->name, slot.set),
                         "write the number that the engine gives it");
        taken.insert(slot);
        slots.emplace(d->name, slot);
    }
}

void numberMaterial(const std::vector<const InterfaceDeclaration*>& resources, BindingMap& slots) {
    std::set<std::uint32_t> taken;
    for (const InterfaceDeclaration* d : resources) {
        if (d->builtin != Builtin::None || d->literal.binding < 0) continue;
        const BindingSlot slot{kMaterialSet, static_cast<std::uint32_t>(d->literal.binding)};
        taken.insert(slots.emplace(d->name, slot).first->second.binding);
    }
    std::uint32_t next = 0;
    for (const bool ofEngine : {false, true}) {  // The engine's names take no number from the material's.
        for (const InterfaceDeclaration* d : resources) {
            if (d->builtin != Builtin::None || slots.contains(d->name) || isEngineName(d->name) != ofEngine) continue;
            while (taken.contains(next)) ++next;
            slots.emplace(d->name, BindingSlot{kMaterialSet, next++});
        }
    }
}

/// The slots that a pipeline's map leaves of Cocos' own: its names as it says; built-in names that it does not have go
/// behind the material's. Without a pipeline every number stays.
class Rebinding {
public:
    Rebinding(const Numbers& numbers, const BindingMap& bindings, const NumberingOptions& options, Problems& problems)
        : slots_(numbers.slots), bindings_(bindings), options_(options), problems_(problems) {
        for (const auto& [name, slot] : slots_)
            if (slot.set == kMaterialSet) nextFree_ = std::max(nextFree_, slot.binding + 1);
        for (const auto& [name, slot] : bindings_)
            if (slot.set == kMaterialSet) nextFree_ = std::max(nextFree_, slot.binding + 1);
    }

    BindingSlot slotOf(const InterfaceDeclaration& declaration) {
        const auto moved = moved_.find(declaration.name);
        if (moved != moved_.end()) return moved->second;
        return moved_[declaration.name] = decide(declaration, slots_.find(declaration.name)->second);
    }

private:
    BindingSlot decide(const InterfaceDeclaration& declaration, const BindingSlot& own) {
        const auto pinned = bindings_.find(declaration.name);
        if (pinned != bindings_.end()) {
            if (pinned->second == own || !options_.rebindByName) return own;
            // Without a pragma a sampler is the material's, whatever its name: the pipeline may still feed it there.
            if (declaration.builtin == Builtin::None && declaration.kind == InterfaceKind::CombinedSampler &&
                declaration.literal.set != int(kGlobalSet) && pinned->second.set == kGlobalSet)
                return own;
            noteMove(declaration, own, pinned->second);
            return pinned->second;
        }
        if (declaration.builtin == Builtin::None || bindings_.empty()) return own;
        // Alternatives on one place (CCLocal, CCLocalBatched) stay on one place.
        const auto [shared, isNew] = homeless_.emplace(own, BindingSlot{kMaterialSet, nextFree_});
        if (isNew) ++nextFree_;
        const BindingSlot slot = shared->second;
        problems_.verbose(declaration.where,
                          fmt::format("the pipeline has no '{}': it is set {}, binding {} of the material here",
                                      declaration.name, slot.set, slot.binding));
        return slot;
    }

    void noteMove(const InterfaceDeclaration& declaration, const BindingSlot& from, const BindingSlot& to) {
        const bool literal = declaration.literal.binding >= 0;
        if (!literal && declaration.builtin == Builtin::None && to.set == kMaterialSet) return;
        problems_.note(
            declaration.where,
            fmt::format("'{}' {} set {}, binding {}: the pipeline gives that name set {}, binding {}", declaration.name,
                        literal ? "is written for" : "would be", from.set, from.binding, to.set, to.binding));
    }

    const BindingMap& slots_;
    const BindingMap& bindings_;
    const NumberingOptions& options_;
    Problems& problems_;
    BindingMap moved_;
    std::map<BindingSlot, BindingSlot> homeless_;  ///< Of builtins that the pipeline does not have, by Cocos' slot.
    std::uint32_t nextFree_ = 0;
};

LayoutNumbers numbersOf(const InterfaceDeclaration& declaration, ShaderStageBits stage, const Numbers& numbers,
                        Rebinding& rebinding, bool subpassSamplers) {
    LayoutNumbers out;
    if (declaration.kind == InterfaceKind::Input || declaration.kind == InterfaceKind::Output) {
        const bool input = declaration.kind == InterfaceKind::Input;
        const Locations& side = stage == kVertexBit ? (input ? numbers.attributes : numbers.varyings)
                                                    : (input ? numbers.varyings : numbers.outputs);
        if (const auto it = side.find(declaration.name); it != side.end()) out.location = it->second;
        return out;
    }
    const BindingSlot slot = rebinding.slotOf(declaration);
    out.set = static_cast<int>(slot.set);
    out.binding = static_cast<int>(slot.binding);
    out.attachment = subpassSamplers ? -1 : declaration.literal.attachment;
    return out;
}

}  // namespace

Numbers numberInterfaces(const std::vector<StageInterface>& stages, Problems& problems) {
    Numbers numbers;
    const StageInterface* vertex = stageOf(stages, kVertexBit);
    const StageInterface* fragment = stageOf(stages, kFragmentBit);
    numberOneSide(vertex, InterfaceKind::Input, numbers.attributes, problems);
    numberVaryings(vertex, fragment, numbers.varyings, problems);
    numberOneSide(fragment, InterfaceKind::Output, numbers.outputs, problems);
    std::vector<const InterfaceDeclaration*> resources;
    for (int kind = 0; kind < static_cast<int>(InterfaceKind::Input); ++kind)
        for (const StageInterface& stage : stages)
            forEachOf(&stage, static_cast<InterfaceKind>(kind), [&](const auto& d) { resources.push_back(&d); });
    numberBuiltins(resources, numbers.slots, problems);
    numberMaterial(resources, numbers.slots);
    return numbers;
}

void numberStages(std::vector<StageText>& stages, const BindingMap& bindings, const NumberingOptions& options,
                  Problems& problems) {
    std::vector<StageInterface> interfaces;
    for (const StageText& stage : stages) interfaces.push_back(readInterface(stage, problems));
    numberStages(stages, interfaces, bindings, options, problems);
}

void numberStages(std::vector<StageText>& stages, const std::vector<StageInterface>& interfaces,
                  const BindingMap& bindings, const NumberingOptions& options, Problems& problems) {
    const Numbers numbers = numberInterfaces(interfaces, problems);
    Rebinding rebinding(numbers, bindings, options, problems);
    for (std::size_t i = 0; i < stages.size(); ++i) {
        std::vector<LayoutNumbers> written;
        for (const InterfaceDeclaration& declaration : interfaces[i].declarations)
            written.push_back(numbersOf(declaration, stages[i].stage, numbers, rebinding, options.subpassSamplers));
        writeLayouts(stages[i], interfaces[i], written);
    }
}

}  // namespace crevice::cocos

// Sets, bindings and locations by name, for all stages of a program together.
#include "effect/BindingResolver.h"

#include <fmt/format.h>
#include <glslang/MachineIndependent/localintermediate.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "core/Text.h"

namespace crevice {
namespace {

using glslang::TVarEntryInfo;

constexpr std::uint32_t kMaterialSet = 1;

std::string nameOf(const TVarEntryInfo& entry) {
    const glslang::TType& type = entry.symbol->getType();
    return type.getBasicType() == glslang::EbtBlock ? type.getTypeName().c_str() : entry.symbol->getName().c_str();
}

/// gl_Position and its like, alone or in gl_PerVertex: their places are not ours to give.
bool isBuiltIn(const glslang::TType& type) {
    if (type.isBuiltIn()) return true;
    return type.isStruct() && !type.getStruct()->empty() && type.getStruct()->front().type->isBuiltIn();
}

int sideOf(EShLanguage stage, bool isInput) {
    if (stage == EShLangVertex) return isInput ? 0 : 1;
    return isInput ? 1 : 2;
}

}  // namespace

BindingResolver::BindingResolver(const BindingMap& bindings, Place place, Problems& problems)
    : bindings_(bindings), place_(std::move(place)), problems_(problems) {}

void BindingResolver::notifyBinding(EShLanguage stage, TVarEntryInfo& entry) {
    const glslang::TType& type = entry.symbol->getType();
    const glslang::TQualifier& qualifier = type.getQualifier();
    Resource resource;
    resource.name = nameOf(entry);
    resource.stage = stage;
    resource.order = entry.id;
    if (type.getBasicType() == glslang::EbtBlock)
        resource.category = qualifier.storage == glslang::EvqBuffer ? Category::StorageBuffer : Category::Block;
    else if (type.getBasicType() == glslang::EbtSampler && type.getSampler().isImage())
        resource.category = Category::StorageImage;
    else if (type.getBasicType() == glslang::EbtSampler && type.getSampler().isCombined())
        resource.category = Category::Sampler;
    if (qualifier.hasSet()) resource.set = static_cast<int>(qualifier.layoutSet);
    if (qualifier.hasBinding()) resource.binding = static_cast<int>(qualifier.layoutBinding);
    resource.where = place_(stage, resource.name);
    resources_.push_back(std::move(resource));
}

void BindingResolver::notifyInOut(EShLanguage stage, TVarEntryInfo& entry) {
    const glslang::TType& type = entry.symbol->getType();
    if (isBuiltIn(type)) return;
    const glslang::TQualifier& qualifier = type.getQualifier();
    Varying varying;
    varying.name = nameOf(entry);
    varying.stage = stage;
    varying.isInput = qualifier.isPipeInput();
    varying.side = sideOf(stage, varying.isInput);
    varying.live = entry.live;
    varying.order = entry.id;
    varying.size = std::max(1, glslang::TIntermediate::computeTypeLocationSize(type, stage));
    if (qualifier.hasLocation()) varying.explicitLocation = static_cast<int>(qualifier.layoutLocation);
    varyings_.push_back(std::move(varying));
}

void BindingResolver::finish() {
    if (finished_) return;
    finished_ = true;
    assignBindings();
    for (int side = 0; side < 3; ++side) assignLocations(side);
    checkProducers();
}

void BindingResolver::assignBindings() {
    std::stable_sort(resources_.begin(), resources_.end(), [](const Resource& a, const Resource& b) {
        return std::tie(a.category, a.stage, a.order) < std::tie(b.category, b.stage, b.order);
    });
    // Numbers that a program writes for its own material set are kept; the others go around them.
    std::map<std::uint32_t, std::string> taken;
    for (const auto& [name, slot] : bindings_)
        if (slot.set == kMaterialSet) taken.emplace(slot.binding, name);
    std::set<std::string> refused;
    for (const Resource& r : resources_) {
        if (bindings_.contains(r.name) || r.binding < 0 || (r.set >= 0 && r.set != static_cast<int>(kMaterialSet)))
            continue;
        const auto [it, isNew] = taken.emplace(r.binding, r.name);
        if (isNew || it->second == r.name) {
            slots_[r.name] = {kMaterialSet, static_cast<std::uint32_t>(r.binding)};
        } else {
            problems_.error(r.where,
                            fmt::format("'{}' and '{}' both have binding {} of set 1", r.name, it->second, r.binding),
                            "leave the numbers out: names are enough");
            refused.insert(r.name);
        }
    }
    std::uint32_t next = 0;
    for (const Resource& r : resources_) {
        const auto pinned = bindings_.find(r.name);
        if (pinned != bindings_.end()) {
            slots_[r.name] = pinned->second;
        } else if (!slots_.contains(r.name)) {
            while (taken.contains(next)) ++next;
            slots_[r.name] = {kMaterialSet, next++};
        }
    }
    for (const Resource& r : resources_)
        if (!refused.contains(r.name)) checkNumbers(r, slots_.at(r.name));
}

void BindingResolver::checkNumbers(const Resource& r, const BindingSlot& slot) {
    const bool setDiffers = r.set >= 0 && static_cast<std::uint32_t>(r.set) != slot.set;
    const bool bindingDiffers = r.binding >= 0 && static_cast<std::uint32_t>(r.binding) != slot.binding;
    if (!setDiffers && !bindingDiffers) return;
    const bool pinned = bindings_.contains(r.name);
    std::string holder;
    for (const auto& [name, other] : bindings_)
        if (name != r.name && static_cast<int>(other.binding) == r.binding &&
            static_cast<int>(other.set) == std::max(r.set, 0))
            holder = fmt::format(" (that place belongs to '{}')", name);
    std::string written = r.set >= 0 ? fmt::format("set {}", r.set) : std::string();
    if (r.binding >= 0) written += fmt::format("{}binding {}", written.empty() ? "" : ", ", r.binding);
    problems_.error(r.where,
                    fmt::format("'{}' is declared with {}{}, but {} gives it set {}, binding {}", r.name, written,
                                holder, pinned ? "the pipeline" : "its name", slot.set, slot.binding),
                    "leave the numbers out: names are enough");
}

void BindingResolver::assignLocations(int side) {
    std::vector<const Varying*> members;
    for (const Varying& v : varyings_)
        if (v.side == side) members.push_back(&v);
    // Producers first, then consumers; by place of declaration within a stage.
    std::stable_sort(members.begin(), members.end(), [](const Varying* a, const Varying* b) {
        return std::tie(a->stage, a->order) < std::tie(b->stage, b->order);
    });
    std::set<int> taken;
    for (const Varying* v : members) {
        if (v->explicitLocation < 0) continue;
        locations_.emplace(std::pair(side, v->name), v->explicitLocation);
        for (int i = 0; i < v->size; ++i) taken.insert(v->explicitLocation + i);
    }
    const auto isFree = [&](int first, int size) {
        for (int i = 0; i < size; ++i)
            if (taken.contains(first + i)) return false;
        return true;
    };
    for (const Varying* v : members) {
        if (locations_.contains({side, v->name})) continue;
        int location = 0;
        while (!isFree(location, v->size)) ++location;
        locations_[{side, v->name}] = location;
        for (int i = 0; i < v->size; ++i) taken.insert(location + i);
    }
}

/// glslang does not check that somebody writes what a fragment program reads.
void BindingResolver::checkProducers() {
    std::vector<std::string> produced;
    for (const Varying& v : varyings_)
        if (v.stage == EShLangVertex && !v.isInput) produced.push_back(v.name);
    for (const Varying& v : varyings_) {
        if (v.stage != EShLangFragment || !v.isInput || !v.live) continue;
        if (std::find(produced.begin(), produced.end(), v.name) != produced.end()) continue;
        const std::string help = produced.empty() ? "the vertex program has no outputs"
                                                  : didYouMean(v.name, produced, "outputs of the vertex program");
        problems_.error(place_(v.stage, v.name),
                        fmt::format("fragment input '{}' is not written by the vertex program", v.name), help);
    }
}

int BindingResolver::resolveBinding(EShLanguage, TVarEntryInfo& entry) {
    finish();
    const auto slot = slots_.find(nameOf(entry));
    if (slot != slots_.end()) entry.newBinding = static_cast<int>(slot->second.binding);
    return entry.newBinding;
}

int BindingResolver::resolveSet(EShLanguage, TVarEntryInfo& entry) {
    finish();
    const auto slot = slots_.find(nameOf(entry));
    if (slot != slots_.end()) entry.newSet = static_cast<int>(slot->second.set);
    return entry.newSet;
}

int BindingResolver::resolveInOutLocation(EShLanguage stage, TVarEntryInfo& entry) {
    finish();
    const glslang::TType& type = entry.symbol->getType();
    if (isBuiltIn(type)) return -1;
    const auto it = locations_.find({sideOf(stage, type.getQualifier().isPipeInput()), nameOf(entry)});
    if (it != locations_.end()) entry.newLocation = it->second;
    return entry.newLocation;
}

}  // namespace crevice

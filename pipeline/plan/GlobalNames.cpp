// Numbers the names of descriptor set 0: built-in ones as in Cocos, pins as pinned, the rest by document and order.
#include "plan/GlobalNames.h"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>

#include "core/Text.h"

namespace crevice {
namespace {

constexpr std::uint32_t kGlobalSet = 0, kLocalSet = 2;
constexpr std::uint32_t kLastNumber = 63;  // a document that needs more has another problem
constexpr std::size_t kMaxUniformBlocks =
    7;  // Vulkan promises 8 dynamic ones in a pipeline layout; CCLocal is the eighth

bool isLocal(std::string_view name, Profile profile) {
    const std::span<const LocalSlot> slots = localSlots(profile);
    return std::any_of(slots.begin(), slots.end(), [&](const LocalSlot& local) { return name == local.name; });
}

bool isBlock(GlobalKind kind) { return kind == GlobalKind::UniformBlock || kind == GlobalKind::StorageBuffer; }

}  // namespace

GlobalLayout::GlobalLayout(std::vector<GlobalSlot> slots, Problems notes, Profile profile)
    : slots_(std::move(slots)), notes_(std::move(notes)), profile_(profile) {
    std::sort(slots_.begin(), slots_.end(), [](const auto& a, const auto& b) { return a.binding < b.binding; });
    for (const GlobalSlot& slot : slots_) bindings_[slot.name] = {kGlobalSet, slot.binding};
    for (const LocalSlot& local : localSlots(profile)) bindings_[local.name] = {kLocalSet, local.binding};
}

const GlobalSlot* GlobalLayout::find(std::string_view name) const {
    const auto found = std::find_if(slots_.begin(), slots_.end(), [&](const auto& slot) { return slot.name == name; });
    return found == slots_.end() ? nullptr : &*found;
}

GlobalNames::GlobalNames(std::vector<std::string> files, Profile profile)
    : files_(std::move(files)), profile_(profile), numbers_(globalNumbers(profile)) {
    for (const BuiltInSlot& known : numbers_.builtIns) {
        Entry entry;
        entry.slot = {known.name, known.kind, known.binding, known.size, false, {}};
        entry.builtIn = true;
        entries_.push_back(std::move(entry));
        takeNumber(entries_.back(), known.binding);
    }
}

void GlobalNames::addTarget(const std::string& name, std::optional<std::uint32_t> pin, const SourceLoc& where) {
    assert(!frozen_);
    const std::size_t document = rankOf(where);
    if (!name.starts_with("cc_")) {
        if (!pin) return;
        problems_.error(where, fmt::format("target '{}' cannot have a binding: it is not in set 0", name),
                        fmt::format("name it 'cc_{}' to make it global, or leave \"binding\" out", name));
        return;
    }
    Entry* known = find(name);
    if (known && known->builtIn && !known->slot.target && known->slot.kind == GlobalKind::Sampler2D) {
        known->slot.target = true;
        known->slot.where = where;
        if (pin) setPin(*known, *pin, where);
        return;
    }
    if (known) {
        const char* what = known->slot.target ? "is declared twice" : "has a name that is built in for something else";
        problems_.error(where, fmt::format("target '{}' {}", name, what), "give the target another name",
                        {placeOf(*known)});
        return;
    }
    Entry entry;
    entry.slot = {name, GlobalKind::Sampler2D, 0, 0, true, where};
    entry.document = document;
    entries_.push_back(std::move(entry));
    for (const BuiltInSlot& reserved : numbers_.targets) {
        if (name != reserved.name) continue;
        entries_.back().builtIn = true;
        takeNumber(entries_.back(), reserved.binding);
    }
    if (pin) setPin(entries_.back(), *pin, where);
}

void GlobalNames::addBlock(const std::string& name, std::uint32_t size, std::optional<std::uint32_t> pin,
                           const SourceLoc& where) {
    assert(!frozen_);
    const std::size_t document = rankOf(where);
    if (isLocal(name, profile_)) {
        problems_.error(where, fmt::format("block '{}' is filled per object by the framework (set 2)", name),
                        "give the stage's block another name");
        return;
    }
    Entry* known = find(name);
    if (!known) {
        Entry entry;
        entry.slot = {name, GlobalKind::UniformBlock, 0, size, false, where};
        entry.document = document;
        entries_.push_back(std::move(entry));
        known = &entries_.back();
    } else if (!isBlock(known->slot.kind)) {
        problems_.error(where, fmt::format("block '{}' has the name of a target", name), "give the block another name",
                        {placeOf(*known)});
        return;
    } else if (!known->provided) {
        known->slot.size = size;
        known->slot.where = where;
        known->document = document;
        known->provided = true;
    } else if (known->slot.kind == GlobalKind::UniformBlock && known->slot.size != size) {
        problems_.error(
            where, fmt::format("block '{}' has {} bytes here and {} bytes elsewhere", name, size, known->slot.size),
            "a name stands for one block in the whole pipeline: make both declarations equal, or rename one",
            {placeOf(*known)});
        return;
    }
    if (pin) setPin(*known, *pin, where);
}

void GlobalNames::pinBlock(const std::string& name, std::uint32_t binding, const SourceLoc& where) {
    assert(!frozen_);
    if (isLocal(name, profile_)) {
        problems_.error(where, fmt::format("block '{}' is in set 2 and has its number there", name),
                        "remove it from \"blocks\"");
        return;
    }
    Entry* known = find(name);
    if (known && !isBlock(known->slot.kind)) {
        problems_.error(where, fmt::format("'{}' is a target, not a block", name),
                        "pin it by \"binding\" in \"targets\"", {placeOf(*known)});
        return;
    }
    if (!known) {
        Entry entry;
        entry.slot = {name, GlobalKind::UniformBlock, 0, 0, false, where};
        entry.document = rankOf(where);
        entry.provided = false;
        entries_.push_back(std::move(entry));
        known = &entries_.back();
    }
    setPin(*known, binding, where);
}

GlobalLayout GlobalNames::freeze() {
    assert(!frozen_);
    frozen_ = true;
    for (std::size_t document = 0; document < files_.size(); ++document) {
        for (Entry& entry : entries_) {
            if (!entry.builtIn && entry.pin && rankOf(entry.pinWhere) == document) takePin(entry);
        }
        takeFreeNumbers(document, true);
        takeFreeNumbers(document, false);
    }
    checkBlockCount();
    problems_.throwIfErrors();

    std::vector<std::string> provided;
    std::vector<GlobalSlot> slots;
    for (const Entry& entry : entries_) {
        if (!entry.provided) continue;
        slots.push_back(entry.slot);
        if (isBlock(entry.slot.kind)) provided.push_back(entry.slot.name);
    }
    for (const Entry& entry : entries_) {
        if (entry.provided) continue;
        problems_.note(
            entry.pinWhere,
            fmt::format("no stage provides the block '{}' that is pinned to {}", entry.slot.name, *entry.pin),
            didYouMean(entry.slot.name, provided, "blocks"));
    }
    return GlobalLayout(std::move(slots), std::move(problems_), profile_);
}

std::size_t GlobalNames::rankOf(const SourceLoc& where) {
    const auto found = std::find(files_.begin(), files_.end(), where.file);
    if (found != files_.end()) return static_cast<std::size_t>(found - files_.begin());
    files_.push_back(where.file);
    return files_.size() - 1;
}

GlobalNames::Entry* GlobalNames::find(std::string_view name) {
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.slot.name == name; });
    return found == entries_.end() ? nullptr : &*found;
}

void GlobalNames::setPin(Entry& entry, std::uint32_t pin, const SourceLoc& where) {
    rankOf(where);  // freeze() walks the files: a pin's file must be among them
    if (entry.builtIn && pin != entry.slot.binding) {
        problems_.error(where,
                        fmt::format("'{}' has the number {} in set 0 and cannot be pinned to {}", entry.slot.name,
                                    entry.slot.binding, pin),
                        "leave \"binding\" out");
    } else if (entry.pin && *entry.pin != pin) {
        problems_.error(where,
                        fmt::format("'{}' is pinned to {} here and to {} elsewhere", entry.slot.name, pin, *entry.pin),
                        "keep one of the two", {{entry.pinWhere, "the other number is given here"}});
    } else {
        entry.pin = pin;
        entry.pinWhere = where;
    }
}

void GlobalNames::takeNumber(Entry& entry, std::uint32_t binding) {
    entry.slot.binding = binding;
    taken_[binding] = static_cast<std::size_t>(&entry - entries_.data());
}

void GlobalNames::takePin(Entry& entry) {
    const std::uint32_t pin = *entry.pin;
    const auto reserved = std::find_if(numbers_.targets.begin(), numbers_.targets.end(),
                                       [&](const BuiltInSlot& known) { return known.binding == pin; });
    const auto taken = taken_.find(pin);
    if (reserved != numbers_.targets.end()) {
        problems_.error(entry.pinWhere,
                        fmt::format("'{}' cannot have binding {} of set 0: it is kept for '{}'", entry.slot.name, pin,
                                    reserved->name),
                        fmt::format("choose a number from {} upward, or leave \"binding\" out", numbers_.firstFree));
    } else if (pin > kLastNumber) {
        problems_.error(
            entry.pinWhere, fmt::format("binding {} of '{}' is too large", pin, entry.slot.name),
            fmt::format("choose a number from {} to {}, or leave \"binding\" out", numbers_.firstFree, kLastNumber));
    } else if (taken != taken_.end()) {
        const Entry& other = entries_[taken->second];
        problems_.error(
            entry.pinWhere,
            fmt::format("'{}' and '{}' both have binding {} of set 0", entry.slot.name, other.slot.name, pin),
            other.builtIn ? "choose another number, or leave \"binding\" out"
                          : "give one of them another number, or leave \"binding\" out",
            {numberOf(other)});
    } else {
        takeNumber(entry, pin);
    }
}

void GlobalNames::takeFreeNumbers(std::size_t document, bool targets) {
    std::uint32_t next = numbers_.firstFree;
    for (Entry& entry : entries_) {
        if (entry.builtIn || entry.pin || entry.document != document || entry.slot.target != targets) continue;
        while (taken_.contains(next)) ++next;
        takeNumber(entry, next);
    }
}

void GlobalNames::checkBlockCount() {
    std::vector<std::string> names;
    const Entry* last = nullptr;
    for (const Entry& entry : entries_) {
        if (entry.slot.kind != GlobalKind::UniformBlock || !entry.provided) continue;
        names.push_back(entry.slot.name);
        last = &entry;
    }
    if (names.size() <= kMaxUniformBlocks) return;
    problems_.error(
        last->slot.where,
        fmt::format("{} uniform blocks are too many in set 0: Vulkan promises 8 with dynamic offsets, and the "
                    "objects' own block is one of them ({})",
                    names.size(), join(names)),
        fmt::format("put the values of two stages into one block, so that at most {} remain", kMaxUniformBlocks));
}

Remark GlobalNames::placeOf(const Entry& entry) {
    const std::string& name = entry.slot.name;
    if (entry.builtIn && !entry.slot.target) {
        const std::string size = entry.slot.size > 0 ? fmt::format(" with {} bytes", entry.slot.size) : "";
        return {{}, fmt::format("'{}' is built in{}", name, size)};
    }
    return {entry.slot.where, fmt::format("'{}' is declared here", name)};
}

Remark GlobalNames::numberOf(const Entry& entry) {
    if (!entry.pin) return placeOf(entry);
    return {entry.pinWhere, fmt::format("'{}' has its number from here", entry.slot.name)};
}

}  // namespace crevice

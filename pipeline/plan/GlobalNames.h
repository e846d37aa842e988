// Names → numbers of descriptor set 0: Cocos' built-in slots, the document's targets and the stages' blocks; nobody
// counts by hand.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/Error.h"
#include "effect/ShaderInfo.h"
#include "plan/ProfileSlots.h"

namespace crevice {

struct GlobalSlot {
    std::string name;
    GlobalKind kind = GlobalKind::Sampler2D;
    std::uint32_t binding = 0;
    std::uint32_t size = 0;  ///< Uniform blocks: bytes. Otherwise 0.
    bool target = false;     ///< An image of the document. Samplers without one hold white, cubes black.
    SourceLoc where;         ///< Who declared it; built-in slots have no place.
};

/// Set 0 as it stays for the life of a pipeline, and the map that effects are compiled with.
class GlobalLayout {
public:
    GlobalLayout() = default;
    explicit GlobalLayout(std::vector<GlobalSlot> slots, Problems notes = {}, Profile profile = Profile::Crevice);

    const std::vector<GlobalSlot>& slots() const { return slots_; }  ///< By ascending number.
    const GlobalSlot* find(std::string_view name) const;
    Profile profile() const { return profile_; }
    /// Set 0 and the names of set 2.
    const BindingMap& bindings() const { return bindings_; }
    const Problems& notes() const { return notes_; }  ///< Pins that no block took.

private:
    std::vector<GlobalSlot> slots_;
    BindingMap bindings_;
    Problems notes_;
    Profile profile_ = Profile::Crevice;
};

/// Collects names, then numbers them. Pins and the profile's numbers are fixed; the others take the lowest free numbers
/// from its first free one (11, or 8 for cocos-3.6) upward, document by document (parent before child), in each first
/// targets, then blocks. Declare disabled stages too: no option may change a number. Clashes are collected and thrown
/// by freeze().
class GlobalNames {
public:
    /// `files`: every file the document was read from, parents first. Names of a file not listed come after those
    /// listed, files in the order in which addTarget() and addBlock() meet them.
    explicit GlobalNames(std::vector<std::string> files = {}, Profile profile = Profile::Crevice);

    /// In document order. A name that does not start with cc_ gets no slot: it is a private wire; pinning it is an
    /// error.
    void addTarget(const std::string& name, std::optional<std::uint32_t> pin, const SourceLoc& where);
    /// In stage order. Declared again with the same size it is the same block. Built-in names are allowed at their own
    /// size.
    void addBlock(const std::string& name, std::uint32_t size, std::optional<std::uint32_t> pin,
                  const SourceLoc& where);
    /// The document's "blocks": a number for a block whose size a stage knows.
    void pinBlock(const std::string& name, std::uint32_t binding, const SourceLoc& where);

    /// Numbers everything. Throws Error with all clashes. Call once.
    GlobalLayout freeze();

private:
    struct Entry {
        GlobalSlot slot;
        std::size_t document = 0;  ///< Rank among files: parents first.
        std::optional<std::uint32_t> pin;
        SourceLoc pinWhere;
        bool builtIn = false;
        bool provided = true;  ///< False for a pin that no stage's block has taken yet.
    };

    std::size_t rankOf(const SourceLoc& where);
    Entry* find(std::string_view name);
    void setPin(Entry& entry, std::uint32_t pin, const SourceLoc& where);
    void takeNumber(Entry& entry, std::uint32_t binding);
    void takePin(Entry& entry);
    void takeFreeNumbers(std::size_t document, bool targets);
    void checkBlockCount();
    static Remark placeOf(const Entry& entry);
    static Remark numberOf(const Entry& entry);

    std::vector<std::string> files_;
    Profile profile_;
    GlobalNumbers numbers_;
    std::vector<Entry> entries_;                  ///< Built-in ones first, then in order of declaration.
    std::map<std::uint32_t, std::size_t> taken_;  ///< Number → index of its entry.
    Problems problems_;
    bool frozen_ = false;
};

}  // namespace crevice

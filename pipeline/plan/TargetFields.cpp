// Reads targets and blocks; resolves `like`.
#include "plan/TargetFields.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/Text.h"
#include "plan/ObjectReader.h"

namespace crevice {
namespace {

constexpr std::int64_t kMaxSize = 16384;

/// A target with what `like` still has to fill.
struct OpenTarget {
    TargetDesc desc;
    bool hasFormat = false, hasExtent = false;
    std::string like;
    SourceLoc likeWhere;
};

std::vector<std::string> keysOf(const Value& object) {
    std::vector<std::string> keys;
    for (const Member& member : object.members()) keys.push_back(member.key);
    return keys;
}

void readSize(const Value& value, const std::string& what, TargetDesc& target, Problems& problems) {
    const char* help = "write \"size\": [width, height] with pixels from 1 to 16384";
    if (value.items().size() != 2) {
        problems.error(value.where(),
                       fmt::format("'size' of {} must have 2 numbers, found {}", what, value.items().size()), help);
        return;
    }
    glm::uvec2 size{1};
    for (int i = 0; i < 2; ++i) {
        const Value& item = value.items()[i];
        if (!item.isInteger() || item.integer() < 1 || item.integer() > kMaxSize) {
            const std::string found = item.isNumber() ? fmt::format("{}", item.number()) : item.typeName();
            problems.error(item.where(), fmt::format("'size' of {} holds {}, not a size in pixels", what, found), help);
            return;
        }
        size[i] = static_cast<glm::uint>(item.integer());
    }
    target.size = size;
}

void readClear(const Value& value, const std::string& what, TargetDesc& target, Problems& problems) {
    if (value.isNumber()) {
        target.clear = glm::vec4(static_cast<float>(value.number()));
        return;
    }
    const std::vector<Value>& items = value.items();
    const bool numbers = std::all_of(items.begin(), items.end(), [](const Value& item) { return item.isNumber(); });
    if (items.size() != 4 || !numbers) {
        problems.error(value.where(), fmt::format("'clear' of {} must be one number or a list of 4 numbers", what),
                       "write \"clear\": 1 for all channels, or \"clear\": [0, 0, 0, 1]");
        return;
    }
    for (int i = 0; i < 4; ++i) target.clear[i] = static_cast<float>(items[static_cast<std::size_t>(i)].number());
}

void checkPersistent(const ObjectReader& reader, Problems& problems) {
    const Value* persistent = reader.get("persistent");
    if (persistent && persistent->boolean())
        problems.error(persistent->where(), fmt::format("'persistent' of {} is not supported yet", reader.what()),
                       "remove it: targets start each frame from their clear value");
}

void readBinding(const ObjectReader& reader, TargetDesc& target, Problems& problems) {
    const Value* binding = reader.get("binding");
    if (!binding) return;
    if (target.isGlobal()) {
        target.binding = static_cast<std::uint32_t>(binding->integer());
    } else {
        problems.error(
            binding->where(), fmt::format("'binding' on {}, which is a private wire", reader.what()),
            fmt::format("only targets whose name starts with 'cc_' are in set 0: rename it 'cc_{}' or remove "
                        "the key",
                        target.name));
    }
}

void readExtent(const ObjectReader& reader, OpenTarget& open, Problems& problems) {
    const Value* scale = reader.get("scale");
    const Value* size = reader.get("size");
    if (scale && size)
        problems.error(size->where(), fmt::format("{} has both 'scale' and 'size'", reader.what()),
                       "keep 'scale' for a size relative to the frame, or 'size' for fixed pixels",
                       {{scale->where(), "'scale' is here"}});
    if (scale) open.desc.scale = static_cast<float>(scale->number());
    if (size) readSize(*size, reader.what(), open.desc, problems);
    open.hasExtent = scale || size;
}

OpenTarget readTarget(const Member& member, const Value& all, Problems& problems) {
    OpenTarget open;
    TargetDesc& target = open.desc;
    target.name = member.key;
    target.where = member.keyLoc;
    const std::string what = fmt::format("target '{}'", member.key);
    if (!isPlainName(member.key))
        problems.error(member.keyLoc, fmt::format("'{}' cannot name a target", member.key),
                       "use letters, digits, '_' and '-', beginning with a letter or '_'");
    const ObjectReader reader(member.value, targetKeys(), what, problems);
    if (!reader.isObject()) return open;

    open.like = reader.text("like");
    open.desc.like = open.like;
    if (const Value* like = reader.get("like")) {
        open.likeWhere = like->where();
        if (!all.find(open.like)) {
            problems.error(like->where(), fmt::format("{} is like '{}', which is no target", what, open.like),
                           didYouMean(open.like, keysOf(all), "targets"));
            open.like.clear();
            open.hasFormat = true;  // Says nothing more about the format.
        }
    }
    if (const Value* format = reader.get("format")) target.format = *formatFromName(format->string());
    open.hasFormat = open.hasFormat || member.value.find("format");
    if (!open.hasFormat && !member.value.find("like") && !reader.isMisspelt("format") && !reader.isMisspelt("like"))
        problems.error(member.value.where(), fmt::format("missing key 'format' in {}", what),
                       "add \"format\", such as \"RGBA8\", or \"like\" with the name of another target");
    readExtent(reader, open, problems);
    target.mips = static_cast<std::uint32_t>(reader.integer("mips").value_or(1));
    target.layers = static_cast<std::uint32_t>(reader.integer("layers").value_or(1));
    if (const Value* clear = reader.get("clear")) readClear(*clear, what, target, problems);
    const std::vector<std::string> samplers = samplerNames();
    const auto sampler = std::find(samplers.begin(), samplers.end(), reader.text("sampler", samplers[0]));
    target.sampler = static_cast<SamplerKind>(sampler - samplers.begin());
    readBinding(reader, target, problems);
    checkPersistent(reader, problems);
    target.help = reader.text("help");
    return open;
}

/// Fills what `like` gives, ancestors first. `path` holds the names on the way, to find circles.
void resolveLike(std::size_t index, std::vector<OpenTarget>& all, std::vector<std::string> path, Problems& problems) {
    OpenTarget& target = all[index];
    if (target.like.empty()) return;
    path.push_back(target.desc.name);
    const std::string like = std::exchange(target.like, {});
    const auto parent = std::find_if(all.begin(), all.end(), [&](const OpenTarget& t) { return t.desc.name == like; });
    if (std::find(path.begin(), path.end(), like) != path.end()) {
        path.push_back(like);
        problems.error(target.likeWhere,
                       fmt::format("targets are like each other in a circle: '{}'", join(path, "' → '")),
                       "give one of them a 'format' and no 'like'");
        return;
    }
    resolveLike(static_cast<std::size_t>(parent - all.begin()), all, path, problems);
    if (!target.hasFormat) target.desc.format = parent->desc.format;
    if (!target.hasExtent) {
        target.desc.scale = parent->desc.scale;
        target.desc.size = parent->desc.size;
    }
}

}  // namespace

std::vector<TargetDesc> readTargets(const Value& targets, Problems& problems) {
    std::vector<OpenTarget> open;
    for (const Member& member : targets.members()) open.push_back(readTarget(member, targets, problems));
    for (std::size_t i = 0; i < open.size(); ++i) resolveLike(i, open, {}, problems);
    std::vector<TargetDesc> result;
    for (OpenTarget& target : open) result.push_back(std::move(target.desc));
    return result;
}

std::vector<BlockPin> readBlocks(const Value& blocks, Problems& problems) {
    std::vector<BlockPin> result;
    for (const Member& member : blocks.members()) {
        const ObjectReader reader(member.value, blockKeys(), fmt::format("block '{}'", member.key), problems);
        BlockPin pin{.name = member.key, .binding = std::nullopt, .where = member.keyLoc};
        if (const auto binding = reader.integer("binding")) pin.binding = static_cast<std::uint32_t>(*binding);
        result.push_back(std::move(pin));
    }
    return result;
}

}  // namespace crevice

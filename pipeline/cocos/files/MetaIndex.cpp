// A project is often edited by hand and by several people: whatever is wrong with one meta costs that asset, not the
// run.
#include "cocos/files/MetaIndex.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "cocos/files/MetaFiles.h"
#include "cocos/files/Uuid.h"
#include "core/Files.h"

namespace crevice::cocos {

namespace {

namespace fs = std::filesystem;

constexpr DocumentLimits kMetaLimits{.maxBytes = 16u << 20, .maxDepth = 64, .maxNodes = 500'000};
constexpr int kMaxSubDepth = 8;
constexpr std::size_t kMaxWarnings = 20;

std::string textOf(const Value& object, std::string_view key) {
    const Value* value = object.find(key);
    return value && value->isString() ? value->string() : std::string();
}

/// `gltfIndex` where a meta gives one; those without come last.
std::int64_t partNumber(const MetaAsset& asset) {
    const Value* index = asset.userData.isObject() ? asset.userData.find("gltfIndex") : nullptr;
    return index && index->isInteger() ? index->integer() : std::int64_t(1) << 40;
}

}  // namespace

/// Reads metas into an index, one file at a time.
class MetaReader {
public:
    MetaReader(MetaIndex& index, Problems& problems) : index_(index), problems_(problems) {}

    void readFile(const fs::path& meta) {
        ++index_.files_;
        try {
            const Value document = parseJson(readText(meta, kMetaLimits.maxBytes), meta.string(), kMetaLimits);
            const fs::path asset = meta.parent_path() / meta.stem();
            readAsset(document, {}, asset, 0);
        } catch (const Error& error) {
            const Problem& first = error.problems().front();
            warn(first.where, "this meta cannot be read: " + first.message,
                 "its asset has no uuid here; " + first.help);
        }
    }

    void finish() {
        if (warnings_ > kMaxWarnings) {
            problems_.warning({}, fmt::format("{} more problems with metas are not shown", warnings_ - kMaxWarnings));
        }
    }

private:
    void readAsset(const Value& meta, const std::string& expectedParent, const fs::path& path, int depth) {
        if (!meta.isObject())
            return warn(meta.where(), fmt::format("a meta must be an object, not {}", meta.typeName()));
        const Value* written = meta.find("uuid");
        if (!written || !written->isString()) {
            return warn(written ? written->where() : meta.where(), "a meta without 'uuid'",
                        "its asset cannot be named");
        }
        const auto uuid = normalizeUuid(written->string());
        if (!uuid || !uuid->starts_with(expectedParent)) {
            return warn(written->where(),
                        fmt::format("'{}' is no uuid{}", written->string(), uuid ? " of a part of this asset" : ""));
        }
        MetaAsset asset{
            .uuid = *uuid, .path = path, .importer = textOf(meta, "importer"), .name = textOf(meta, "name")};
        if (asset.name.empty()) asset.name = path.filename().string();
        if (const Value* userData = meta.find("userData"); userData && userData->isObject()) asset.userData = *userData;
        if (!add(std::move(asset), written->where())) return;
        if (const Value* subMetas = meta.find("subMetas")) readParts(*subMetas, *uuid + "@", path, depth);
    }

    void readParts(const Value& subMetas, const std::string& parent, const fs::path& path, int depth) {
        if (!subMetas.isObject()) return;
        if (depth >= kMaxSubDepth) {
            return warn(subMetas.where(), fmt::format("parts nested deeper than {} levels are left out", kMaxSubDepth));
        }
        for (const Member& member : subMetas.members()) readAsset(member.value, parent, path, depth + 1);
    }

    bool add(MetaAsset asset, const SourceLoc& where) {
        const auto [known, isNew] = index_.assets_.emplace(asset.uuid, asset);
        if (!isNew) {
            warn(where,
                 fmt::format("'{}' is the uuid of '{}' already", asset.uuid, known->second.path.filename().string()),
                 fmt::format("'{}' is used; give the other file a uuid of its own", known->second.path.string()));
            return false;
        }
        if (!asset.isSubAsset()) index_.byPath_.emplace(asset.path.lexically_normal(), asset.uuid);
        return true;
    }

    void warn(const SourceLoc& where, std::string message, std::string help = {}) {
        if (++warnings_ <= kMaxWarnings) problems_.warning(where, std::move(message), std::move(help));
    }

    MetaIndex& index_;
    Problems& problems_;
    std::size_t warnings_ = 0;
};

MetaIndex MetaIndex::build(std::span<const fs::path> roots, Problems& problems) {
    MetaIndex index;
    MetaReader reader(index, problems);
    for (const fs::path& meta : findMetaFiles(roots, problems)) reader.readFile(meta);
    reader.finish();
    return index;
}

const MetaAsset* MetaIndex::find(std::string_view uuid) const {
    const auto normal = normalizeUuid(uuid);
    if (!normal) return nullptr;
    const auto found = assets_.find(*normal);
    return found == assets_.end() ? nullptr : &found->second;
}

const MetaAsset* MetaIndex::findNearest(std::string_view uuid) const {
    for (;;) {
        if (const MetaAsset* asset = find(uuid)) return asset;
        const std::size_t last = uuid.rfind('@');
        if (last == std::string_view::npos) return nullptr;
        uuid = uuid.substr(0, last);
    }
}

const MetaAsset* MetaIndex::findFile(const fs::path& path) const {
    const auto found = byPath_.find(path.lexically_normal());
    return found == byPath_.end() ? nullptr : find(found->second);
}

std::vector<const MetaAsset*> MetaIndex::parts(std::string_view uuid, std::string_view importer) const {
    std::vector<const MetaAsset*> found;
    const auto normal = normalizeUuid(uuid);
    if (!normal) return found;
    const std::string prefix = *normal + "@";
    for (auto it = assets_.lower_bound(prefix); it != assets_.end() && it->first.starts_with(prefix); ++it) {
        if (it->second.importer == importer) found.push_back(&it->second);
    }
    std::sort(found.begin(), found.end(), [](const MetaAsset* a, const MetaAsset* b) {
        return std::make_tuple(partNumber(*a), std::string_view(a->uuid)) <
               std::make_tuple(partNumber(*b), std::string_view(b->uuid));
    });
    return found;
}

}  // namespace crevice::cocos

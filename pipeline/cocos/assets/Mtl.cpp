// The three lists of a material are read apart and joined by their index.
#include "cocos/assets/Mtl.h"

#include <fmt/format.h>

#include "core/Files.h"

namespace crevice::cocos {
namespace {

constexpr std::size_t kMaxPasses = 256;
constexpr DocumentLimits kMtlLimits{.maxBytes = 16u << 20, .maxDepth = 64, .maxNodes = 200'000};

class MtlReader {
public:
    MtlReader(const Value& object, Problems& problems) : fields_(object, problems), problems_(problems) {}

    Mtl read(const Value& object, const std::string& file) {
        Mtl mtl{.name = fields_.text("_name"), .path = file, .where = object.where()};
        if (mtl.name.empty()) mtl.name = std::filesystem::path(file).stem().string();
        mtl.effect = fields_.asset("_effectAsset");
        mtl.technique = readTechnique();
        const Value* index = fields_.find("_techIdx");
        mtl.techniqueWhere = index ? index->where() : mtl.where;
        eachPass(mtl, "_defines", [](MtlPass& pass, const Value& value) { pass.defines = value; });
        eachPass(mtl, "_states", [](MtlPass& pass, const Value& value) { pass.states = value; });
        eachPass(mtl, "_props", [this](MtlPass& pass, const Value& value) { readProperties(pass, value); });
        for (MtlPass& pass : mtl.passes) checkDefines(pass.defines);
        return mtl;
    }

private:
    std::size_t readTechnique() {
        const std::int64_t index = fields_.integer("_techIdx", 0);
        if (index >= 0 && index < 256) return static_cast<std::size_t>(index);
        problems_.error(fields_.find("_techIdx")->where(), fmt::format("'_techIdx' {} is no technique", index),
                        "techniques count from 0");
        return 0;
    }

    template <class Action>
    void eachPass(Mtl& mtl, const char* key, Action action) {
        const Value* list = fields_.list(key);
        if (!list) return;
        if (list->items().size() > kMaxPasses) {
            problems_.error(list->where(), fmt::format("'{}' has {} passes", key, list->items().size()),
                            fmt::format("an effect has at most {}", kMaxPasses));
            return;
        }
        if (mtl.passes.size() < list->items().size()) mtl.passes.resize(list->items().size());
        for (std::size_t i = 0; i < list->items().size(); ++i) {
            const Value& item = list->items()[i];
            if (item.isNull()) continue;
            if (item.isObject()) {
                action(mtl.passes[i], item);
            } else {
                problems_.error(item.where(),
                                fmt::format("item {} of '{}' must be an object, not {}", i, key, item.typeName()),
                                "each pass has one: {}");
            }
        }
    }

    void readProperties(MtlPass& pass, const Value& object) {
        for (const Member& member : object.members()) {
            pass.properties.push_back({member.key, readTyped(member.value, problems_), member.value.where()});
        }
    }

    void checkDefines(const Value& defines) {
        if (!defines.isObject()) return;
        for (const Member& member : defines.members()) {
            if (member.value.isString() && member.value.string().find('\n') != std::string::npos) {
                problems_.error(member.value.where(), fmt::format("macro '{}' is a text of several lines", member.key),
                                "a macro's value is one line of a program");
            }
            if (!member.value.isArray() && !member.value.isObject()) continue;
            problems_.error(member.value.where(),
                            fmt::format("macro '{}' cannot be {}", member.key, member.value.typeName()),
                            "macros are true, false, numbers or words");
        }
    }

    FieldReader fields_;
    Problems& problems_;
};

Mtl readGraph(const ObjectGraph& graph, const std::string& file, Problems& problems) {
    const Value& root = graph.root();
    if (typeOf(root) != "cc.Material") {
        throw Error(root.where(), fmt::format("'{}' is no material: its type is '{}'", file, typeOf(root)),
                    "a .mtl holds one object of type 'cc.Material'");
    }
    return MtlReader(root, problems).read(root, file);
}

}  // namespace

Mtl readMtl(const std::filesystem::path& path, Problems& problems) {
    return readGraph(ObjectGraph::read(path, kMtlLimits), path.string(), problems);
}

Mtl parseMtl(std::string_view text, const std::string& file, Problems& problems) {
    return readGraph(ObjectGraph::parse(text, file, kMtlLimits), file, problems);
}

}  // namespace crevice::cocos

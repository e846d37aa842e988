// Resources by name over all stages of a pass, and what one stage writes for the next.
#include "effect/StageFacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

namespace crevice {
namespace {

/// The column of a name in the author's line: a layout() that nobody wrote has moved it in the text that was compiled.
SourceLoc inAuthorsLine(SourceLoc where, const std::string& name) {
    std::ifstream file(where.file, std::ios::binary);
    std::string line;
    for (int i = 0; i < where.line && std::getline(file, line);) ++i;
    const auto isPart = [&](std::size_t i) {
        return i < line.size() && (std::isalnum(static_cast<unsigned char>(line[i])) != 0 || line[i] == '_');
    };
    for (std::size_t at = line.find(name); at != std::string::npos; at = line.find(name, at + 1)) {
        if ((at > 0 && isPart(at - 1)) || isPart(at + name.size())) continue;
        where.column = static_cast<int>(at) + 1;
        break;
    }
    return where;
}

/// A scalar or vector, or an array of such: "vec4[2]" is { "vec", 4, "[2]" }, "int" is { "ivec", 1, "" }.
struct VaryingShape {
    std::string_view scalar;
    int size = 0;  ///< 0 = another type.
    std::string_view array;
};

VaryingShape shapeOf(std::string_view type) {
    static constexpr std::array<std::array<std::string_view, 2>, 4> kScalars{
        {{"float", "vec"}, {"int", "ivec"}, {"uint", "uvec"}, {"double", "dvec"}}};
    const std::size_t end = std::min(type.find('['), type.size());
    const std::string_view element = type.substr(0, end);
    for (const auto& [scalar, vector] : kScalars) {
        if (element == scalar) return {vector, 1, type.substr(end)};
        if (element.size() == vector.size() + 1 && element.starts_with(vector))
            return {vector, element.back() - '0', type.substr(end)};
    }
    return {};
}

/// Components that nobody reads do no harm (Vulkan's maintenance4 says so of vectors).
bool isWider(std::string_view output, std::string_view input) {
    const VaryingShape from = shapeOf(output), to = shapeOf(input);
    return to.size > 0 && from.scalar == to.scalar && from.array == to.array && from.size > to.size;
}

/// Texts that are compiled one by one meet here for the first time.
void checkVaryings(const std::vector<StageVarying>& written, const std::vector<StageVarying>& read,
                   Problems& problems) {
    for (const StageVarying& input : read) {
        const auto output =
            std::find_if(written.begin(), written.end(), [&](const StageVarying& v) { return v.name == input.name; });
        if (!input.active || input.name.empty() || output == written.end() || output->type == input.type) continue;
        const SourceLoc where = inAuthorsLine(input.where, input.name);
        const std::string message = fmt::format("varying '{}' is a {} here, but a {} in the vertex program", input.name,
                                                input.type, output->type);
        if (isWider(output->type, input.type))
            problems.note(where, message, "what it lacks is not read: give both the same type to be sure");
        else
            problems.error(where, message, "give both the same type",
                           {{inAuthorsLine(output->where, output->name), "the vertex program's"}});
    }
}

/// What a later stage knows of a resource that an earlier one declares too.
void joinResource(ShaderResource& known, const ShaderResource& found) {
    known.kind = found.kind;
    known.slot = found.slot;
    known.stages |= found.stages;
    known.active = known.active || found.active;
    if (known.where.line == 0) known.where = found.where;
    if (known.firstUse.line == 0) known.firstUse = found.firstUse;
    if (found.kind == ResourceKind::UniformBlock || found.kind == ResourceKind::CombinedSampler) {
        known.readOnly = true;
    } else {  // Read-only is what all stages only read.
        known.readOnly = known.readOnly && found.readOnly;
        known.writeOnly = known.writeOnly && found.writeOnly;
    }
    if (found.kind == ResourceKind::CombinedSampler) known.cube = found.cube;
    if (found.kind == ResourceKind::UniformBlock || found.kind == ResourceKind::StorageBuffer) {
        known.size = found.size;
        known.members = found.members;
    }
}

/// The pass' one resource of that name.
const ShaderResource& addResource(ShaderInfo& info, const ShaderResource& found, Problems& problems) {
    const auto known = std::find_if(info.resources.begin(), info.resources.end(),
                                    [&](const ShaderResource& resource) { return resource.name == found.name; });
    if (known != info.resources.end()) joinResource(*known, found);
    const ShaderResource& resource = known != info.resources.end() ? *known : info.resources.emplace_back(found);
    if (resource.count == 0)
        problems.error(resource.where, fmt::format("'{}' is an array without a size", resource.name),
                       "give it a constant size");
    return resource;
}

void addStage(ShaderInfo& info, const StageFacts& stage, Problems& problems) {
    const auto report = [&](const std::optional<std::size_t>& resource, const SourceLoc& where) {
        for (const auto& [owner, problem] : stage.mistakes)
            if (owner == resource) problems.error(owner ? where : problem.where, problem.message, problem.help);
    };
    for (std::size_t i = 0; i < stage.info.resources.size(); ++i)
        report(i, addResource(info, stage.info.resources[i], problems).where);
    report(std::nullopt, {});
    info.inputs.insert(info.inputs.end(), stage.info.inputs.begin(), stage.info.inputs.end());
    info.outputs.insert(info.outputs.end(), stage.info.outputs.begin(), stage.info.outputs.end());
    info.refusals.insert(info.refusals.end(), stage.info.refusals.begin(), stage.info.refusals.end());
    if (stage.stage == kComputeBit) std::copy_n(stage.info.localSize, 3, info.localSize);
}

}  // namespace

const ShaderResource* ShaderInfo::find(std::string_view name) const {
    for (const ShaderResource& resource : resources)
        if (resource.name == name) return &resource;
    return nullptr;
}

ShaderInfo joinStages(std::span<const StageFacts* const> stages, Problems& problems) {
    ShaderInfo info;
    std::vector<StageVarying> written, read;
    for (const StageFacts* stage : stages) {
        addStage(info, *stage, problems);
        if (stage->numbered) (stage->stage == kVertexBit ? written : read) = stage->varyings;
    }
    checkVaryings(written, read, problems);
    std::sort(info.resources.begin(), info.resources.end(),
              [](const auto& a, const auto& b) { return a.slot < b.slot; });
    return info;
}

}  // namespace crevice

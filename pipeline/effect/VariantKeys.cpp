// What identifies a variant: the request for it, and all that it is compiled from.
#include "effect/VariantKeys.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/Files.h"

namespace crevice {

std::string requestKey(const VariantRequest& request, const BindingMap& bindings, std::uint64_t generation) {
    std::string key = fmt::format("{}\n{} {} {}\n", request.effect, request.technique, request.pass, generation);
    if (!request.rebindLiterals) key += "literal numbers\n";
    if (request.checkOnly) key += "check only\n";
    for (const auto& [name, value] : request.constants) key += fmt::format("{}:={}\n", name, value);
    for (const auto& [name, value] : request.defines) key += fmt::format("{}={}\n", name, value);
    for (const auto& [name, slot] : bindings) key += fmt::format("{}:{}.{}\n", name, slot.set, slot.binding);
    return key;
}

std::string contentKey(const std::vector<StageSource>& sources, const BindingMap& bindings) {
    std::string content = ShaderCompiler::version() + "\n";
    bool numbered = true;
    for (const StageSource& source : sources) {
        content += fmt::format("stage {}\n{}{}\n", static_cast<int>(source.stage), source.head, source.text);
        for (const std::string& file : source.flat.files) content += file + "\n";
        for (const FlatSource::Origin& origin : source.flat.lines) {
            const std::int64_t place = (std::int64_t(origin.file) << 32) | origin.line;
            content.append(reinterpret_cast<const char*>(&place), sizeof place);
        }
        numbered = numbered && source.numbered;
    }
    for (const auto& [name, slot] : bindings) {
        // clang 14 captures no structured bindings by themselves.
        const auto mentions = [&word = name](const StageSource& source) {
            return source.text.find(word) != std::string::npos;
        };
        const bool named = !numbered && std::any_of(sources.begin(), sources.end(), mentions);
        if (named) content += fmt::format("{}:{}.{}\n", name, slot.set, slot.binding);
    }
    return contentHash(content);
}

std::string variantName(const std::string& effect, const EffectPass& pass) {
    if (!pass.compute.empty()) return effect + "|" + pass.compute;
    return effect + "|" + pass.vertex + "|" + pass.fragment;
}

}  // namespace crevice

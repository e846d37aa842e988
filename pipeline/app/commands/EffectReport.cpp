// Lines to stdout, messages to stderr.
#include "app/commands/EffectReport.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "app/commands/Console.h"
#include "app/commands/EffectBindings.h"

namespace crevice {
namespace {

using Json = nlohmann::ordered_json;

std::size_t bytesOf(const std::vector<std::uint32_t>& words) { return words.size() * sizeof(std::uint32_t); }

std::string definesText(const Defines& defines) {
    std::string text;
    for (const auto& [name, value] : defines) text += fmt::format(" {}={}", name, value);
    return text;
}

Json resourcesJson(const ShaderInfo& info) {
    Json resources = Json::array();
    for (const ShaderResource& resource : info.resources) {
        resources.push_back({{"name", resource.name},
                             {"kind", kindName(resource.kind)},
                             {"set", resource.slot.set},
                             {"binding", resource.slot.binding},
                             {"size", resource.size},
                             {"active", resource.active}});
    }
    return resources;
}

Json passJson(const VariantRequest& request, const EffectPass& pass, bool ok) {
    return {{"effect", request.effect}, {"technique", request.technique}, {"pass", request.pass},
            {"phase", pass.phase},      {"defines", request.defines},     {"ok", ok}};
}

Json missingJson(const std::vector<MissingName>& missing) {
    Json list = Json::array();
    for (const MissingName& name : missing)
        list.push_back({{"name", name.name},
                        {"file", name.where.file},
                        {"line", name.where.line},
                        {"with", name.usedWith},
                        {"declared", name.otherwise}});
    return list;
}

}  // namespace

void EffectReport::line(const VariantRequest& request, const EffectPass& pass, bool ok, const std::string& end) const {
    if (text_) return;
    print(fmt::format("{} {} technique {} pass {} ({}){}{}\n", ok ? "ok    " : "FAILED", request.effect,
                      request.technique, request.pass, pass.phase, definesText(request.defines), end));
}

void EffectReport::success(const VariantRequest& request, const EffectPass& pass, const EffectVariant& variant) {
    ++compiled_;
    if (json_) {
        Json result = passJson(request, pass, true);
        result["bytes"] = {{"vertex", bytesOf(variant.vertex)},
                           {"fragment", bytesOf(variant.fragment)},
                           {"compute", bytesOf(variant.compute)}};
        result["resources"] = resourcesJson(variant.info);
        passes_.push_back(std::move(result));
        return;
    }
    const std::size_t size = bytesOf(variant.vertex) + bytesOf(variant.fragment) + bytesOf(variant.compute);
    line(request, pass, true, fmt::format(": {} bytes of SPIR-V", size));
}

void EffectReport::failure(const VariantRequest& request, const EffectPass& pass, const Error& error,
                           const std::vector<MissingName>& missing) {
    ++failed_;
    if (!missing.empty()) ++undeclared_;
    if (json_) {
        Json result = passJson(request, pass, false);
        result["message"] = formatError(error);
        if (!missing.empty()) result["undeclared"] = missingJson(missing);
        passes_.push_back(std::move(result));
        return;
    }
    log_.write(LogLevel::Error, fmt::format("'{}' does not compile", request.effect));
    std::fprintf(stderr, "%s\n", formatError(error).c_str());
    line(request, pass, false, missing.empty() ? "" : ": not declared: " + missingText(missing));
}

void EffectReport::unreadable(const std::string& effect, const std::string& message) {
    ++failed_;
    if (json_) {
        passes_.push_back({{"effect", effect}, {"ok", false}, {"message", message}});
        return;
    }
    log_.write(LogLevel::Error, fmt::format("'{}' cannot be read", effect));
    std::fprintf(stderr, "%s\n", message.c_str());
    if (!text_) print(fmt::format("FAILED {}\n", effect));
}

void EffectReport::addReflection(const Value& effect) {
    if (json_) effects_.push_back(Json::parse(effect.toJson(-1)));
}

void EffectReport::finish(std::size_t effects, bool cocos) const {
    if (json_ && cocos) {
        print(Json{{"compiled", compiled_}, {"failed", failed_}, {"passes", passes_}, {"effects", effects_}}.dump(2) +
              "\n");
    } else if (json_) {
        print(passes_.dump(2) + "\n");
    } else if (!text_) {
        const std::string reason = cocos && undeclared_ > 0
                                       ? fmt::format(", {} of them use what their source does not declare", undeclared_)
                                       : "";
        print(fmt::format("{} compiled, {} failed{}; {} effect{}\n", compiled_, failed_, reason, effects,
                          effects == 1 ? "" : "s"));
    }
}

}  // namespace crevice

// 3.4 moved the G-buffer out of the global set: the one change that splits the versions in two.
#include "cocos/assets/Version.h"

#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "core/Files.h"

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;

struct Number {
    int major = 0, minor = 0;
};

/// "3.6", "3.6.1", "3.8.0-beta.1".
std::optional<Number> readVersion(const std::string& text) {
    Number number;
    const char* const end = text.data() + text.size();
    const auto major = std::from_chars(text.data(), end, number.major);
    if (major.ec != std::errc() || major.ptr == end || *major.ptr != '.') return std::nullopt;
    const auto minor = std::from_chars(major.ptr + 1, end, number.minor);
    const bool ends = minor.ptr == end || *minor.ptr == '.' || *minor.ptr == '-';
    if (minor.ec != std::errc() || !ends || number.major != 3) return std::nullopt;
    return number;
}

std::string profileOf(const Number& number) { return number.minor <= 3 ? "cocos-3.3" : "cocos-3.6"; }

/// `path` of a package.json, by one or two keys; "" when it is not there.
std::string wordOf(const fs::path& file, std::initializer_list<const char*> keys) {
    std::error_code failed;
    if (!fs::is_regular_file(file, failed)) return {};
    try {
        const Value document = parseJson(readText(file, 4u << 20), file.string());
        const Value* value = &document;
        for (const char* key : keys) value = value && value->isObject() ? value->find(key) : nullptr;
        return value && value->isString() ? value->string() : std::string();
    } catch (const Error&) {
        return {};  // a broken package.json tells no version; the shape does
    }
}

std::optional<VersionChoice> fromFile(const fs::path& file, std::initializer_list<const char*> keys) {
    const std::string text = wordOf(file, keys);
    const auto number = readVersion(text);
    if (!number) return std::nullopt;
    return VersionChoice{profileOf(*number), fmt::format("version {} of '{}'", text, file.string())};
}

VersionChoice fromShape(const RppPipeline& pipeline) {
    for (const RppFlow& flow : pipeline.flows) {
        if (flow.type == "GbufferFlow" || flow.type == "LightingFlow")
            return {"cocos-3.3", fmt::format("its '{}' is of 3.3", flow.type)};
    }
    return {"cocos-3.6", "its flows are those of 3.4 and later"};
}

}  // namespace

VersionChoice chooseVersion(const std::string& given, const Roots& roots, const RppPipeline& pipeline) {
    if (!given.empty()) {
        if (const auto number = readVersion(given)) return {profileOf(*number), "as asked for"};
        throw Error(fmt::format("--cocos-version: '{}' is no version of Cocos Creator 3", given),
                    "give one such as 3.3.1 or 3.6");
    }
    if (!roots.engine.empty()) {
        if (const auto choice = fromFile(roots.engine / "package.json", {"version"})) return *choice;
    }
    if (!roots.project.empty()) {
        if (const auto choice = fromFile(roots.project / "package.json", {"creator", "version"})) return *choice;
    }
    return fromShape(pipeline);
}

}  // namespace crevice::cocos

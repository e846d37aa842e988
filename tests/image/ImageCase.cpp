// Cases are read strictly: a key that nobody reads is a mistake.
#include "ImageCase.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace crevice::image {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kEnding = ".case.json";
const std::set<std::string> kKeys = {"help", "pipeline", "scene", "size", "options", "set", "tolerance", "fact"};

std::map<std::string, std::string> readTexts(const Json& json, const char* key) {
    std::map<std::string, std::string> texts;
    if (!json.contains(key)) return texts;
    for (const auto& [name, value] : json.at(key).items()) {
        texts[name] = value.is_string() ? value.get<std::string>() : value.dump();
    }
    return texts;
}

/// A file beside the cases, or the name of a shipped scene.
fs::path sceneFile(const std::string& text) {
    const fs::path own = fs::path(CREVICE_IMAGE_DIR) / "scenes" / (text + ".scene.json");
    if (fs::exists(own)) return own;
    return fs::path(CREVICE_TEST_SOURCE_DIR) / "assets" / "scenes" / (text + ".scene.json");
}

ImageCase readCase(const fs::path& path) {
    const Json json = Json::parse(std::ifstream(path));
    for (const auto& [key, value] : json.items()) {
        if (!kKeys.contains(key)) throw std::runtime_error(path.string() + ": unknown key '" + key + "'");
    }
    ImageCase result;
    const std::string file = path.filename().string();
    result.name = file.substr(0, file.size() - std::string(kEnding).size());
    result.help = json.at("help");
    result.pipeline = json.at("pipeline");
    result.scene = sceneFile(json.at("scene"));
    if (json.contains("size")) {
        result.width = json.at("size").at(0);
        result.height = json.at("size").at(1);
    }
    result.options = readTexts(json, "options");
    result.sets = readTexts(json, "set");
    result.tolerance = json.at("tolerance").at("max");
    result.outliers = json.at("tolerance").at("outliers");
    result.reason = json.at("tolerance").at("reason");
    result.fact = json.at("fact");
    return result;
}

}  // namespace

fs::path goldenPath(const std::string& name) { return fs::path(CREVICE_IMAGE_DIR) / "golden" / (name + ".png"); }

std::vector<ImageCase> readCases() {
    std::vector<ImageCase> cases;
    for (const auto& entry : fs::directory_iterator(fs::path(CREVICE_IMAGE_DIR) / "cases")) {
        if (!entry.path().string().ends_with(kEnding)) {
            throw std::runtime_error(entry.path().string() + " does not end in " + kEnding);
        }
        cases.push_back(readCase(entry.path()));
    }
    std::sort(cases.begin(), cases.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return cases;
}

}  // namespace crevice::image

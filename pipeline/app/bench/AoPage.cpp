// A template, its script and the plotting library become one file; nothing is loaded from elsewhere.
#include <filesystem>
#include <system_error>

#include <nlohmann/json.hpp>

#include "app/bench/AoFiles.h"
#include "app/bench/AoPictures.h"
#include "core/Error.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kLibrary = "chart.min.js";

std::string readPart(const AssetRoots& roots, const std::string& name) {
    std::vector<fs::path> places;
    for (const fs::path& root : roots.roots()) places.push_back(root / "assets/bench" / name);
    if (name == kLibrary) places.emplace_back(CREVICE_CHART_JS);
    for (const fs::path& place : places) {
        std::error_code failed;
        if (fs::is_regular_file(place, failed)) return readText(place);
    }
    throw Error("the report's part '" + name + "' is not found",
                name == kLibrary ? "install Chart.js (Debian: libjs-chart.js) and configure the build again"
                                 : "point CREVICE_DATA_DIR at Crevice's files");
}

void replaceMark(std::string& text, const std::string& mark, const std::string& with) {
    const std::size_t at = text.find(mark);
    if (at == std::string::npos) throw Error("the report's template has no " + mark);
    text.replace(at, mark.size(), with);
}

/// JSON that can stand in a script element: nothing in it ends the element.
std::string embeddable(std::string json) {
    for (std::size_t at = json.find("</"); at != std::string::npos; at = json.find("</", at + 3))
        json.replace(at, 2, "<\\/");
    return json;
}

Json mediaJson(const AoResults& results) {
    Json media{{"pictures", Json::array()}, {"lit", Json::array()}, {"without", Json::object()}};
    for (const AoPicture& picture : results.pictures) {
        Json json{{"scene", picture.scene},
                  {"view", picture.view},
                  {"label", picture.label},
                  {"map", pngDataUri(picture.map)}};
        if (picture.error.width > 0) json["error"] = pngDataUri(picture.error);
        media["pictures"].push_back(std::move(json));
    }
    for (const AoLit& lit : results.lit) {
        if (!media["without"].contains(lit.scene)) media["without"][lit.scene] = pngDataUri(lit.without);
        media["lit"].push_back({{"scene", lit.scene},
                                {"view", lit.view},
                                {"label", lit.label},
                                {"with", pngDataUri(lit.with)},
                                {"without", lit.scene}});
    }
    return media;
}

}  // namespace

std::string aoPage(const AoResults& results, const AssetRoots& roots) {
    std::string page = readPart(roots, "ao-page.html");
    const std::string script = readPart(roots, "ao-page.js"), library = readPart(roots, kLibrary);
    // From the end, so that no mark is looked for in what has been put in.
    replaceMark(page, "/*PAGE*/", script);
    replaceMark(page, "/*MEDIA*/", embeddable(mediaJson(results).dump()));
    replaceMark(page, "/*DATA*/", embeddable(aoJson(results)));
    replaceMark(page, "/*CHART*/", library);
    return page;
}

}  // namespace crevice

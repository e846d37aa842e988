// The pipeline's own options say what there is: a technique that is added there is measured without a change here.
#include "app/bench/AoCases.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <system_error>

#include <fmt/format.h>

#include "app/bench/AoTaps.h"
#include "core/Error.h"
#include "core/Text.h"

namespace crevice {
namespace {

const OptionDesc* findOption(const PipelineDesc& desc, std::string_view name) {
    for (const OptionDesc& option : desc.options) {
        if (option.name == name) return &option;
    }
    return nullptr;
}

const std::vector<std::string>& choicesOf(const PipelineDesc& desc, std::string_view name) {
    const OptionDesc* option = findOption(desc, name);
    if (!option) throw Error(fmt::format("pipeline '{}' has no option '{}'", desc.name, name));
    return option->choices;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

void checkNames(const char* option, const std::vector<std::string>& wanted, const std::vector<std::string>& known) {
    for (const std::string& name : wanted) {
        if (!contains(known, name)) {
            throw Error(fmt::format("{}: there is no '{}'", option, name), didYouMean(name, known, "known"));
        }
    }
}

/// Reads the document with the case's options, which checks them, and takes scale and samples from it.
void complete(const AssetRoots& roots, AoCase& c) {
    c.options["ao"] = c.technique;
    c.options["quality"] = c.quality;
    const PipelineDesc desc = loadPipeline(roots, {aoMapPipeline(roots), c.options, c.sets});
    const TargetDesc* raw = desc.findTarget("cc_ssaoMap");
    if (raw) c.scale = raw->scale;
    c.taps = countTaps(desc);
    c.denoiseTaps = countDenoiseTaps(desc);
    c.guard = desc.guard;
}

}  // namespace

std::string AoCase::label() const { return technique + " " + quality + (extras.empty() ? "" : " " + extras); }

std::string aoMapPipeline(const AssetRoots& roots) {
    for (const std::filesystem::path& root : roots.roots()) {
        const std::filesystem::path path = root / "assets/bench/ao-map.pipeline.json";
        std::error_code failed;
        if (std::filesystem::is_regular_file(path, failed)) return path.string();
    }
    throw Error("no asset root holds assets/bench/ao-map.pipeline.json", "point CREVICE_DATA_DIR at Crevice's files");
}

AoCase parseAoCase(const AssetRoots& roots, std::string_view text) {
    AoCase c;
    std::istringstream words{std::string(text)};
    words >> c.technique >> c.quality;
    if (c.quality.empty()) {
        throw Error(fmt::format("--variant: '{}' names no technique and preset", text),
                    "write --variant \"vbao high guard=10\"");
    }
    const bool hasGuardOption = findOption(loadPipeline(roots, {aoMapPipeline(roots), {}, {}}), "guard");
    for (std::string word; words >> word;) {
        const std::size_t sign = word.find('=');
        if (sign == std::string::npos || sign == 0) {
            throw Error(fmt::format("--variant: '{}' is not NAME=VALUE", word),
                        "write --variant \"vbao high guard=10\"");
        }
        const std::string name = word.substr(0, sign), value = word.substr(sign + 1);
        if (name.find('.') != std::string::npos || (name == "guard" && !hasGuardOption)) {
            c.sets.push_back({name, value});
        } else {
            c.options[name] = value;
        }
        c.extras += (c.extras.empty() ? "" : " ") + word;
    }
    complete(roots, c);
    return c;
}

AoCase withoutGuard(AoCase c) {
    std::erase_if(c.sets, [](const StageSet& set) { return set.path == "guard"; });
    c.sets.push_back({"guard", "0"});
    c.guard = 0;
    return c;
}

std::vector<AoCase> listAoCases(const AssetRoots& roots, const AoCaseChoice& choice) {
    const PipelineDesc desc = loadPipeline(roots, {aoMapPipeline(roots), {}, {}});
    std::vector<std::string> known = choicesOf(desc, "ao");
    std::erase(known, "off");  // makes no map
    checkNames("--techniques", choice.techniques, known);
    std::vector<AoCase> cases;
    std::set<std::string> qualities;
    for (const std::string& technique : known) {
        if (!choice.techniques.empty() && !contains(choice.techniques, technique)) continue;
        const PipelineDesc own = loadPipeline(roots, {aoMapPipeline(roots), {{"ao", technique}}, {}});
        for (const std::string& quality : choicesOf(own, "quality")) {
            qualities.insert(quality);
            if (choice.qualities.empty() ? quality == "reference" : !contains(choice.qualities, quality)) continue;
            AoCase c;
            c.technique = technique;
            c.quality = quality;
            complete(roots, c);
            cases.push_back(std::move(c));
        }
    }
    checkNames("--qualities", choice.qualities, {qualities.begin(), qualities.end()});
    std::vector<std::string> variants = choice.variants;
    const bool isAll = variants.empty() && choice.techniques.empty() && choice.qualities.empty();
    if (isAll) {
        variants.push_back("vbao high thickness=0.15");  // what its help names for thin things
        if (findOption(desc, "guard")) {
            for (const char* technique : {"gtao", "vbao"})
                for (const char* quality : {"high", "ultra"})
                    variants.push_back(fmt::format("{} {} guard=0", technique, quality));
        }
        variants.push_back("vbao high guard=10");
        if (findOption(desc, "backFaces")) {
            variants.push_back("vbao high backFaces=true");
            variants.push_back("vbao ultra guard=25 backFaces=true");
        }
    }
    for (const std::string& variant : variants) cases.push_back(parseAoCase(roots, variant));
    if (isAll) {
        // The others are measured at the middle radius: a third of the time.
        for (AoCase& c : cases) c.everyRadius = c.technique == "gtao" || c.technique == "vbao";
    }
    return cases;
}

std::vector<AoCurve> listAoCurves(const AssetRoots& roots, const std::vector<AoCase>& cases) {
    std::vector<AoCurve> curves;
    for (const std::string technique : {"vbao", "gtao", "cocos"}) {
        if (std::none_of(cases.begin(), cases.end(), [&](const AoCase& c) { return c.technique == technique; }))
            continue;
        AoCurve samples{"samples: " + technique, {}}, blur{"blur: " + technique + " high", {}};
        for (const std::string quality : {"fast", "medium", "high", "ultra"}) {
            samples.cases.push_back(parseAoCase(roots, technique + " " + quality + " resolution=full passes=0"));
        }
        for (const std::string passes : {"0", "1", "2", "3"}) {
            blur.cases.push_back(parseAoCase(roots, technique + " high resolution=full passes=" + passes));
        }
        curves.push_back(std::move(samples));
        curves.push_back(std::move(blur));
    }
    return curves;
}

}  // namespace crevice

// Puts the steps together: find, parse, flatten, analyse, number, head.
#include "cocos/CocosEffects.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <unordered_set>

#include "cocos/analysis/EntryCheck.h"
#include "cocos/analysis/StageAnalysis.h"
#include "cocos/files/Fingerprint.h"
#include "cocos/files/TakeOver.h"
#include "cocos/flatten/Flattener.h"
#include "cocos/interface/BlockRules.h"
#include "cocos/interface/Numbering.h"
#include "cocos/text/ChunkLibrary.h"
#include "cocos/text/SourceText.h"
#include "core/Files.h"
#include "effect/VariantBuilder.h"

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxEffectBytes = 16u << 20;
/// Flattened stages that are kept: the passes of a technique share them.
constexpr std::size_t kKeptStages = 24;
/// What is drawn reads the image of a subpass input at its own pixel: passes here are render passes of their own.
constexpr std::string_view kSubpassHead =
    "#define subpassInput sampler2D\n#define isubpassInput isampler2D\n#define usubpassInput usampler2D\n"
    "#define subpassLoad(subpassImage) texelFetch(subpassImage, ivec2(gl_FragCoord.xy), 0)\n";

/// Subpass inputs, and none of several samples: those stay as they are, and nothing can be drawn with them.
bool canSampleSubpassInputs(const std::vector<StageInterface>& stages) {
    bool any = false;
    for (const StageInterface& stage : stages) {
        for (const InterfaceDeclaration& declaration : stage.declarations) {
            if (declaration.kind != InterfaceKind::SubpassInput) continue;
            if (declaration.type.ends_with("MS")) return false;
            any = true;
        }
    }
    return any;
}

/// main() of a stage with an entry is its last line.
void addEntry(StageText& text, const ProgramReference& program, const SourceLoc& where, Problems& problems) {
    if (program.entry.empty() || problems.hasErrors()) return;
    checkEntry(text.flat.text, program, text.stage, where, problems);
    appendEntry(text.flat, text.stage, program.entry, where);
    text.conditionOf.push_back(0);
}

/// Macros with options that other stages describe and this one does not; nothing where its text names none of them.
std::vector<DefineInfo> describedElsewhere(const std::vector<const StageText*>& stages, std::size_t own) {
    std::vector<DefineInfo> found;
    std::unordered_set<std::string_view> known;
    for (const StageMacro& macro : stages[own]->macros)
        if (macro.info.described) known.insert(macro.info.name);
    for (std::size_t i = 0; i < stages.size(); ++i)
        for (const StageMacro& macro : stages[i]->macros)
            if (i != own && macro.info.described && !macro.info.options.empty() && known.insert(macro.info.name).second)
                found.push_back(macro.info);
    std::unordered_set<std::string_view> names;
    for (const DefineInfo& info : found) names.insert(info.name);
    bool named = false;
    const std::string_view text = found.empty() ? std::string_view() : stages[own]->flat.text;
    for (std::size_t at = 0; at < text.size() && !named;) {
        const std::string_view word = leadingName(text.substr(at));
        named = names.contains(word);
        at += std::max<std::size_t>(1, word.size());
    }
    return named ? found : std::vector<DefineInfo>{};
}

/// A text that asks how many registers its uniforms take gets the number that Cocos' compiler counts.
void addUniformVectors(const std::vector<StageText>& texts, const std::vector<StageInterface>& interfaces,
                       Defines& values) {
    constexpr std::string_view kAsked = "CC_EFFECT_USED_";
    const bool asked = std::any_of(texts.begin(), texts.end(), [&](const StageText& text) {
        return text.flat.text.find(kAsked) != std::string::npos;
    });
    if (!asked) return;
    for (const StageInterface& read : interfaces) {
        const char* stage = read.stage == kVertexBit ? "VERTEX" : read.stage == kFragmentBit ? "FRAGMENT" : "COMPUTE";
        values.emplace(fmt::format("{}{}_UNIFORM_VECTORS", kAsked, stage), std::to_string(uniformVectors(read)));
    }
}

}  // namespace

struct CocosEffects::State {
    State(Roots given, Options chosen) : roots(std::move(given)), options(chosen), effects(roots), chunks(roots) {}

    const Roots roots;
    const Options options;
    const EffectNames effects;
    ChunkLibrary chunks;
    struct Kept {
        std::string key;
        StageText text;
        std::optional<StageInterface> interface;  ///< Once it was asked for, with what was said of it.
        Problems said;
    };
    std::deque<std::shared_ptr<Kept>> kept;
    std::optional<std::string> fingerprint;

    std::shared_ptr<Kept> keep(const EffectAsset& effect, const StagePart& part, const std::vector<DefineInfo>& others,
                               Problems& problems);
    std::vector<std::shared_ptr<Kept>> keepAll(const EffectAsset& effect, const EffectPass& pass, Problems& problems);
};

/// A stage's text, flattened or remembered; nothing where it has errors. `others` are macros of the other stages whose
/// options it names.
std::shared_ptr<CocosEffects::State::Kept> CocosEffects::State::keep(const EffectAsset& effect, const StagePart& part,
                                                                     const std::vector<DefineInfo>& others,
                                                                     Problems& problems) {
    std::string key = fmt::format("{}\n{}\n{}", effect.path, part.reference, static_cast<int>(part.stage));
    for (const DefineInfo& info : others)
        key += fmt::format("\n{} {} {}", info.name, info.defaultValue, fmt::join(info.options, " "));
    for (const auto& present : kept)
        if (present->key == key) return present;
    Problems own;
    auto stage = std::make_shared<Kept>();
    try {
        const ProgramReference reference = parseProgram(part.reference);
        stage->text = analyzeStage(part.stage, flattenStage(effect, reference.program, part.where, chunks, {}, own),
                                   reference.entry, others, own);
        addEntry(stage->text, reference, part.where, own);
    } catch (const Error& error) {
        own.add(error);
    }
    takeOver(own, problems);
    if (own.hasErrors()) return nullptr;
    stage->key = std::move(key);
    kept.push_back(stage);
    if (kept.size() > kKeptStages) kept.pop_front();
    return stage;
}

/// The stages of a pass, vertex before fragment; none where one has errors.
std::vector<std::shared_ptr<CocosEffects::State::Kept>> CocosEffects::State::keepAll(const EffectAsset& effect,
                                                                                     const EffectPass& pass,
                                                                                     Problems& problems) {
    std::vector<std::shared_ptr<Kept>> stages;
    Problems own;
    const std::vector<StagePart> parts = partsOf(pass);
    for (const StagePart& part : parts) stages.push_back(keep(effect, part, {}, own));
    std::vector<const StageText*> texts;
    for (const auto& stage : stages)
        if (stage != nullptr) texts.push_back(&stage->text);
    const auto alone = stages;  // what `texts` points into
    Problems again;             // what was said already, but for errors
    for (std::size_t i = 0; i < texts.size() && texts.size() == parts.size(); ++i)
        if (const auto others = describedElsewhere(texts, i); !others.empty())
            stages[i] = keep(effect, parts[i], others, again);
    if (again.hasErrors()) takeOver(again, own);
    takeOver(own, problems);
    if (own.hasErrors()) stages.clear();
    return stages;
}

CocosEffects::CocosEffects(Roots roots, Options options) : state_(new State(std::move(roots), options)) {}
CocosEffects::CocosEffects(Roots roots) : CocosEffects(std::move(roots), Options{}) {}
CocosEffects::~CocosEffects() = default;

std::optional<fs::path> CocosEffects::find(const std::string& effect) const {
    if (!effect.ends_with(".effect")) return state_->effects.find(effect);
    std::error_code error;
    const fs::path path = effect;
    if (!fs::is_regular_file(path, error)) return state_->effects.find(effect.substr(0, effect.size() - 7));
    if (state_->effects.nameOf(path)) return path;
    for (const fs::path& folder : state_->roots.chunks) {
        const fs::path relative =
            fs::weakly_canonical(path, error).lexically_relative(fs::weakly_canonical(folder, error));
        if (!relative.empty() && *relative.begin() != "..") return path;
    }
    return std::nullopt;
}

std::optional<fs::path> CocosEffects::findShort(const std::string& effect) const {
    return state_->effects.findShort(effect);
}

std::vector<std::string> CocosEffects::names() const { return state_->effects.names(); }

EffectAsset CocosEffects::parse(const fs::path& path, const std::string& name, Problems& problems) {
    const std::string shown = state_->effects.nameOf(path).value_or(name);
    return parseEffect(readText(path, kMaxEffectBytes), shown, path.string(), problems, EffectReading::Tolerant);
}

std::string CocosEffects::fingerprint() {
    if (!state_->fingerprint) {
        state_->fingerprint = fingerprintOf(state_->roots);
        if (!state_->fingerprint->empty() && !state_->options.numbering.rebindByName)
            *state_->fingerprint += " literal";
    }
    return *state_->fingerprint;
}

std::vector<StageText> CocosEffects::flatten(const EffectAsset& effect, const EffectPass& pass, Problems& problems) {
    std::vector<StageText> texts;
    for (const auto& stage : state_->keepAll(effect, pass, problems)) texts.push_back(stage->text);
    return texts;
}

std::vector<DefineInfo> CocosEffects::defines(const EffectAsset& effect, const EffectPass& pass, Problems& problems) {
    std::vector<DefineInfo> infos;
    for (StageMacro& macro : mergeMacros(flatten(effect, pass, problems))) infos.push_back(std::move(macro.info));
    return infos;
}

std::vector<StageSource> CocosEffects::stages(const EffectAsset& effect, const EffectPass& pass,
                                              const VariantRequest& request, const BindingMap& bindings,
                                              Problems& problems) {
    const auto kept = state_->keepAll(effect, pass, problems);
    if (kept.empty()) return {};
    std::vector<StageText> texts;
    std::vector<StageInterface> interfaces;
    for (const auto& stage : kept) {
        if (!stage->interface) stage->interface = readInterface(stage->text, stage->said);
        takeOver(stage->said, problems);
        interfaces.push_back(*stage->interface);
        texts.push_back(stage->text);
    }
    const std::vector<StageMacro> macros = mergeMacros(texts);
    Defines values = request.defines;
    for (const auto& [name, value] : request.constants) values.emplace(name, value);
    for (const auto& [name, value] : pass.embeddedMacros) values[name] = value;  // They win: Cocos merges them last.
    for (const auto& [name, value] : values)
        if (value.find('\n') != std::string::npos)
            problems.error(request.where, fmt::format("the value of define '{}' has several lines", name));
    addUniformVectors(texts, interfaces, values);
    NumberingOptions numbering = state_->options.numbering;
    numbering.rebindByName = numbering.rebindByName && request.rebindLiterals;
    numbering.subpassSamplers = !request.checkOnly && canSampleSubpassInputs(interfaces);
    numberStages(texts, interfaces, bindings, numbering, problems);
    std::vector<StageSource> sources;
    for (StageText& text : texts) {
        StageSource& source = sources.emplace_back();
        source.stage = text.stage;
        source.numbered = true;
        source.head = makeHead(text, macros, values);
        if (numbering.subpassSamplers && text.stage == kFragmentBit) source.head += kSubpassHead;
        source.flat = std::move(text.flat);
        source.text = source.flat.text;
    }
    return sources;
}

}  // namespace crevice::cocos

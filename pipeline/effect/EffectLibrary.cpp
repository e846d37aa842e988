// Effects by name, variants by defines: in memory by request, on disk by content.
#include "effect/EffectLibrary.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "effect/EffectFiles.h"
#include "effect/EffectFrontEnd.h"
#include "effect/Includes.h"
#include "effect/RecentStages.h"
#include "effect/ShaderCompiler.h"
#include "effect/SpirvCache.h"
#include "effect/SpirvCheck.h"
#include "effect/VariantBuilder.h"
#include "effect/VariantKeys.h"

namespace crevice {
namespace {

constexpr std::size_t kMaxEffectBytes = 16u << 20;
constexpr std::size_t kMostTold = 10'000;  ///< Messages that are remembered.

}  // namespace

struct EffectLibrary::State {
    AssetRoots roots;
    Log log;
    SpirvCache disk;
    std::shared_ptr<ShaderCompiler> compiler;
    RecentStages recent;
    FrontEnds frontEnds;
    std::map<std::string, std::unique_ptr<EffectAsset>> assets;  ///< By path.
    std::map<const EffectAsset*, EffectFrontEnd*> readers;       ///< Of the assets that are not in our own dialect.
    std::map<std::string, const EffectAsset*> named;             ///< As the present roots find them.
    std::vector<std::unique_ptr<EffectVariant>> variants;
    std::map<std::string, const EffectVariant*> byRequest, byContent;
    Chunks chunks;
    std::uint64_t made = 0;        ///< Variants so far: the last one's id.
    std::uint64_t generation = 0;  ///< Counts changes of generated chunks and of roots.
    Counters counters;
    std::set<std::string> told;  ///< What was written to the log: a pipeline that loads again says it no more.

    void tell(const std::vector<Problem>& said);
    const EffectAsset& asset(const std::string& effect, const SourceLoc& where);
    EffectFrontEnd* readerOf(const EffectAsset& asset) const;
    const EffectPass& passOf(const EffectAsset& asset, const VariantRequest& request) const;
    IncludeSources sourcesOf(const EffectAsset& asset) const { return {asset, roots, chunks}; }
    std::vector<std::string> definesOfEffect(const EffectAsset& asset) const;
    std::vector<StageSource> stagesOf(const EffectAsset& asset, const EffectPass& pass, const VariantRequest& request,
                                      const BindingMap& bindings, Problems& said) const;
    const EffectVariant& make(const VariantRequest& request, const BindingMap& bindings);
    CompiledPass compiledFor(const std::string& key, const std::vector<StageSource>& sources,
                             const BindingMap& bindings, bool check);
    using Stages = std::vector<RecentStages::Stage>;
    Stages compileStages(const std::vector<StageSource>& sources, const BindingMap& bindings, bool check,
                         Problems& problems);
    std::string askKey(const EffectAsset& effect, const VariantRequest& request, const BindingMap& bindings) const;
    const EffectVariant& keep(const EffectAsset& effect, const VariantRequest& request, const std::string& place,
                              CompiledPass compiled);
};

EffectFrontEnd* EffectLibrary::State::readerOf(const EffectAsset& asset) const {
    const auto it = readers.find(&asset);
    return it == readers.end() ? nullptr : it->second;
}

void EffectLibrary::State::tell(const std::vector<Problem>& said) {
    Problems fresh;
    for (const Problem& problem : said) {
        const bool isNew = told.size() >= kMostTold || told.insert(formatProblem(problem)).second;
        if (isNew) fresh.add(Error(std::vector<Problem>{problem}));
    }
    log.write(fresh);
}

const EffectAsset& EffectLibrary::State::asset(const std::string& effect, const SourceLoc& where) {
    if (const auto it = named.find(effect); it != named.end()) return *it->second;
    const auto [path, reader] = findEffect(roots, frontEnds, effect, where);
    if (const auto it = assets.find(path.string()); it != assets.end()) return *(named[effect] = it->second.get());
    Problems problems;
    const std::string name = effect.ends_with(".effect") ? path.stem().string() : effect;
    auto parsed = std::make_unique<EffectAsset>(
        reader != nullptr ? reader->parse(path, name, problems)
                          : parseEffect(readText(path, kMaxEffectBytes), name, path.string(), problems));
    problems.throwIfErrors();
    tell(problems.all());
    if (reader != nullptr) readers[parsed.get()] = reader;
    return *(named[effect] = assets.emplace(path.string(), std::move(parsed)).first->second.get());
}

const EffectPass& EffectLibrary::State::passOf(const EffectAsset& asset, const VariantRequest& request) const {
    const SourceLoc& where = request.where.line != 0 ? request.where : asset.where;
    if (request.technique >= asset.techniques.size())
        throw Error(where, fmt::format("effect '{}' has no technique {}", asset.name, request.technique),
                    fmt::format("it has {}, counted from 0", asset.techniques.size()));
    const EffectTechnique& technique = asset.techniques[request.technique];
    if (request.pass >= technique.passes.size())
        throw Error(
            where,
            fmt::format("technique {} of effect '{}' has no pass {}", request.technique, asset.name, request.pass),
            fmt::format("it has {}, counted from 0", technique.passes.size()));
    return technique.passes[request.pass];
}

std::vector<std::string> EffectLibrary::State::definesOfEffect(const EffectAsset& asset) const {
    std::vector<std::string> names;
    Problems ignored;  // Each pass reports its own mistakes when it is compiled.
    for (const EffectTechnique& technique : asset.techniques)
        for (const EffectPass& pass : technique.passes)
            for (DefineInfo& info : findDefines(flattenPass(sourcesOf(asset), pass, ignored).pointers(), ignored))
                names.push_back(std::move(info.name));
    return names;
}

std::vector<StageSource> EffectLibrary::State::stagesOf(const EffectAsset& asset, const EffectPass& pass,
                                                        const VariantRequest& request, const BindingMap& bindings,
                                                        Problems& said) const {
    if (EffectFrontEnd* reader = readerOf(asset)) {
        auto texts = reader->stages(asset, pass, request, bindings, said);
        said.throwIfErrors();
        return texts;
    }
    Problems problems;
    FlatPass flat = flattenPass(sourcesOf(asset), pass, problems);
    problems.throwIfErrors();
    const bool several = asset.techniques.size() > 1 || asset.techniques.front().passes.size() > 1;
    const auto elsewhere = several && !request.defines.empty() ? definesOfEffect(asset) : std::vector<std::string>{};
    auto sources = makeStageSources(std::move(flat), pass, request, elsewhere, problems);
    checkPropertyTargets(sourcesOf(asset), pass, sources, problems);
    problems.throwIfErrors();
    return sources;
}

/// Numbered stages one by one, each text once.
EffectLibrary::State::Stages EffectLibrary::State::compileStages(const std::vector<StageSource>& sources,
                                                                 const BindingMap& bindings, bool check,
                                                                 Problems& problems) {
    const bool numbered = std::all_of(sources.begin(), sources.end(), [](const auto& s) { return s.numbered; });
    Stages stages;
    if (numbered) {
        for (const StageSource& source : sources)
            if (auto stage = recent.get(source, check, *compiler, problems)) stages.push_back(std::move(*stage));
        return stages;
    }
    std::vector<StageCode> code = compiler->compile(sources, bindings, problems);
    for (std::size_t i = 0; i < code.size(); ++i) {
        if (check) checkSpirv(code[i], sources[i], problems);
        auto facts = std::make_shared<StageFacts>(reflectStage(code[i], sources[i]));
        stages.push_back({std::move(code[i]), std::move(facts)});
    }
    return stages;
}

CompiledPass EffectLibrary::State::compiledFor(const std::string& key, const std::vector<StageSource>& sources,
                                               const BindingMap& bindings, bool check) {
    auto kept = disk.load(key);
    if (kept && (kept->checked || !check)) {
        ++counters.fromDisk;
        tell(kept->remarks);
        return std::move(*kept);
    }
    Problems problems;
    Stages stages = compileStages(sources, bindings, check, problems);
    problems.throwIfErrors();
    CompiledPass compiled;
    compiled.checked = check;
    std::vector<const StageFacts*> facts;
    for (auto& [code, found] : stages) {
        compiled.code.push_back(std::move(code));
        facts.push_back(found.get());
    }
    Problems remarks;
    compiled.info = joinStages(facts, remarks);
    remarks.throwIfErrors();
    compiled.remarks = remarks.all();
    tell(compiled.remarks);
    ++counters.compiled;
    disk.store(key, compiled);
    return compiled;
}

/// What a request to a front end depends on; empty when the front end does not say what its texts depend on.
std::string EffectLibrary::State::askKey(const EffectAsset& effect, const VariantRequest& request,
                                         const BindingMap& bindings) const {
    EffectFrontEnd* reader = readerOf(effect);
    const std::string fingerprint = reader != nullptr && disk.keeps() ? reader->fingerprint() : std::string();
    if (fingerprint.empty()) return {};
    return contentHash(fmt::format("{}\n{}\n{}\n{}", ShaderCompiler::version(), fingerprint, effect.path,
                                   requestKey(request, bindings, 0)));
}

const EffectVariant& EffectLibrary::State::keep(const EffectAsset& effect, const VariantRequest& request,
                                                const std::string& place, CompiledPass compiled) {
    auto variant = std::make_unique<EffectVariant>();
    variant->pass = &passOf(effect, request);
    variant->name = variantName(effect.name, *variant->pass);
    variant->effect = request.effect;
    variant->id = ++made;
    variant->info = std::move(compiled.info);
    for (StageCode& stage : compiled.code)
        (stage.stage == kVertexBit     ? variant->vertex
         : stage.stage == kFragmentBit ? variant->fragment
                                       : variant->compute) = std::move(stage.words);
    byContent[place] = variant.get();
    variants.push_back(std::move(variant));
    return *variants.back();
}

const EffectVariant& EffectLibrary::State::make(const VariantRequest& request, const BindingMap& bindings) {
    const EffectAsset& effect = asset(request.effect, request.where);
    const EffectPass& pass = passOf(effect, request);
    const auto placeOf = [&](const std::string& key) {
        return fmt::format("{} {} {} {}", effect.path, request.technique, request.pass, key);
    };
    const std::string asked = askKey(effect, request, bindings);
    if (const auto answer = asked.empty() ? std::nullopt : disk.loadAnswer(asked)) {
        if (auto kept = disk.load(answer->content); kept && (kept->checked || !request.checkOnly)) {
            tell(answer->problems);
            tell(kept->remarks);
            ++counters.fromDisk;
            return keep(effect, request, placeOf(answer->content), std::move(*kept));
        }
    }
    Problems said;
    const std::vector<StageSource> sources = stagesOf(effect, pass, request, bindings, said);
    tell(said.all());
    const std::string key = contentKey(sources, bindings);
    if (const auto it = byContent.find(placeOf(key)); it != byContent.end()) {
        ++counters.fromMemory;
        return *it->second;
    }
    CompiledPass compiled = compiledFor(key, sources, bindings, request.checkOnly);
    if (!asked.empty()) disk.storeAnswer(asked, {key, said.all()});
    return keep(effect, request, placeOf(key), std::move(compiled));
}

EffectLibrary::EffectLibrary(AssetRoots roots, const Log& log, Options options)
    : state_(new State{std::move(roots),
                       log,
                       SpirvCache(options.useDiskCache ? cacheFolder("spirv") : std::nullopt),
                       options.compiler ? std::move(options.compiler) : std::make_shared<ShaderCompiler>(),
                       {},
                       {},
                       {},
                       {},
                       {},
                       {},
                       {},
                       {},
                       {},
                       0,
                       0,
                       {},
                       {}}) {}
EffectLibrary::EffectLibrary(AssetRoots roots, const Log& log) : EffectLibrary(std::move(roots), log, Options{}) {}
EffectLibrary::~EffectLibrary() = default;

void EffectLibrary::addFrontEnd(std::unique_ptr<EffectFrontEnd> frontEnd) {
    state_->frontEnds.insert(state_->frontEnds.begin(), std::move(frontEnd));
    state_->named.clear();
    ++state_->generation;
}

std::vector<std::string> EffectLibrary::names() const { return effectNames(state_->roots, state_->frontEnds); }

const EffectAsset& EffectLibrary::asset(const std::string& effect, const SourceLoc& where) {
    return state_->asset(effect, where);
}

const EffectVariant& EffectLibrary::get(const VariantRequest& request, const BindingMap& bindings) {
    const std::string key = requestKey(request, bindings, state_->generation);
    const auto it = state_->byRequest.find(key);
    if (it != state_->byRequest.end()) ++state_->counters.fromMemory;
    const EffectVariant& variant = it != state_->byRequest.end() ? *it->second : state_->make(request, bindings);
    state_->byRequest[key] = &variant;
    if (!request.checkOnly && !variant.info.refusals.empty()) throw Error(variant.info.refusals);
    return variant;
}

void EffectLibrary::setChunk(const std::string& name, std::string text) {
    std::string& present = state_->chunks[name];
    if (present == text) return;
    present = std::move(text);
    ++state_->generation;
}

std::vector<DefineInfo> EffectLibrary::discoverDefines(const std::string& effect, std::size_t technique,
                                                       std::size_t pass) {
    const EffectAsset& found = asset(effect);
    VariantRequest request;
    request.effect = effect;
    request.technique = technique;
    request.pass = pass;
    const EffectPass& chosen = state_->passOf(found, request);
    Problems problems;
    std::vector<DefineInfo> infos;
    if (EffectFrontEnd* reader = state_->readerOf(found))
        infos = reader->defines(found, chosen, problems);
    else
        infos = findDefines(flattenPass(state_->sourcesOf(found), chosen, problems).pointers(), problems);
    problems.throwIfErrors();
    return infos;
}

std::string EffectLibrary::text(const VariantRequest& request, ShaderStageBits stage) {
    const EffectAsset& found = asset(request.effect, request.where);
    Problems said;
    for (const StageSource& source : state_->stagesOf(found, state_->passOf(found, request), request, {}, said))
        if (source.stage == stage) return source.head + source.text;
    return {};
}

const AssetRoots& EffectLibrary::roots() const { return state_->roots; }
void EffectLibrary::setRoots(AssetRoots roots) {
    state_->roots = std::move(roots);
    state_->named.clear();
    ++state_->generation;
}

const EffectLibrary::Counters& EffectLibrary::counters() const { return state_->counters; }

void EffectLibrary::dropVariants() {
    state_->byRequest.clear();
    state_->byContent.clear();
    state_->variants.clear();
}

}  // namespace crevice

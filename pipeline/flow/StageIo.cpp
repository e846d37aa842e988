// Collects a stage's declarations; the document's effect, defines, material and queues take precedence.
#include "flow/StageIo.h"

#include <fmt/format.h>

#include <cassert>
#include <charconv>

namespace crevice {
namespace {

/// "name@2" → name, mip 2.
std::pair<std::string, std::uint32_t> splitMip(std::string_view target) {
    const std::size_t at = target.rfind('@');
    if (at == std::string_view::npos) return {std::string(target), 0};
    std::uint32_t mip = 0;
    std::from_chars(target.data() + at + 1, target.data() + target.size(), mip);
    return {std::string(target.substr(0, at)), mip};
}

}  // namespace

StageIo::StageIo(StageDeclaration& declaration, const StageDesc& desc, const RunInfo& run, const PipelineDesc* pipeline)
    : declaration_(declaration), desc_(desc), run_(run), pipeline_(pipeline) {}

bool StageIo::hasTarget(std::string_view target) const {
    return pipeline_ && pipeline_->findTarget(std::string(target)) != nullptr;
}

void StageIo::addWrite(std::string_view target, WriteKind kind) {
    // "writes" of the document renames the outputs of a class in their order, so that two instances can write two
    // targets.
    if (kind == WriteKind::Color || kind == WriteKind::Storage) {
        if (renamed_ < desc_.writes.size()) target = desc_.writes[renamed_];
        ++renamed_;
    }
    auto [name, mip] = splitMip(target);
    declaration_.writes.push_back({.target = std::move(name), .kind = kind, .mip = mip, .where = desc_.where});
}

void StageIo::color(std::string_view target) { addWrite(target, WriteKind::Color); }

void StageIo::depth(std::string_view target, DepthUse use) {
    addWrite(target, use == DepthUse::Test ? WriteKind::DepthTest : WriteKind::DepthWrite);
}

void StageIo::storage(std::string_view target) { addWrite(target, WriteKind::Storage); }

void StageIo::read(std::string_view target) { declaration_.reads.emplace_back(target); }

BlockId StageIo::addBlock(std::string_view name, std::size_t size) {
    declaration_.blocks.push_back({std::string(name), static_cast<std::uint32_t>(size)});
    return {static_cast<std::uint32_t>(declaration_.blocks.size() - 1)};
}

DrawId StageIo::fullscreen(std::string_view defaultEffect) {
    // The document's effect replaces that of the first draw; a stage with several draws names the others itself.
    const bool first = declaration_.draws.empty();
    std::string effect = first && !desc_.effect.empty() ? desc_.effect : std::string(defaultEffect);
    if (effect.empty()) {
        throw Error(desc_.where, fmt::format("stage '{}' of class '{}' names no effect", desc_.name, desc_.stageClass),
                    "add \"effect\": \"NAME\"; `crevice effects list` shows the names");
    }
    declaration_.draws.push_back(
        {.effect = std::move(effect), .compute = false, .defines = {}, .material = {}, .inputs = {}});
    return {static_cast<std::uint32_t>(declaration_.draws.size() - 1)};
}

DrawId StageIo::compute(std::string_view defaultEffect) {
    const DrawId id = fullscreen(defaultEffect);
    declaration_.draws[id.index].compute = true;
    return id;
}

QueueId StageIo::queue(std::string_view phase, QueueSort sort, std::string_view defaultEffect) {
    const std::size_t index = declaration_.queues.size();
    QueueDeclaration declared{.queue = {{std::string(phase)}, sort, desc_.where},
                              .effect = desc_.effect.empty() ? std::string(defaultEffect) : desc_.effect};
    if (index < desc_.queues.size()) declared.queue = desc_.queues[index];
    declaration_.queues.push_back(std::move(declared));
    return {static_cast<std::uint32_t>(index)};
}

QueueId StageIo::casters(std::string_view defaultEffect) {
    const QueueId id = queue("shadow-caster", QueueSort::FrontToBack, defaultEffect);
    declaration_.queues[id.index].casters = true;
    return id;
}

QueueId StageIo::perLight(std::string_view phase, std::string_view defaultEffect) {
    QueueDeclaration declared;
    declared.queue.phases = {std::string(phase)};
    declared.queue.sort = QueueSort::BackToFront;
    declared.queue.where = desc_.where;
    declared.effect = desc_.effect.empty() ? std::string(defaultEffect) : desc_.effect;
    declared.perLight = true;
    declaration_.queues.push_back(std::move(declared));
    return {static_cast<std::uint32_t>(declaration_.queues.size() - 1)};
}

void StageIo::define(DrawId draw, std::string_view macro, std::string_view value) {
    assert(draw.index < declaration_.draws.size());
    declaration_.draws[draw.index].defines.insert_or_assign(std::string(macro), std::string(value));
}

void StageIo::property(DrawId draw, std::string_view name, Value value) {
    assert(draw.index < declaration_.draws.size());
    Value& material = declaration_.draws[draw.index].material;
    if (material.isNull()) material = Value::makeObject(desc_.where);
    material.set(std::string(name), std::move(value));
}

void StageIo::input(DrawId draw, std::uint32_t binding, std::string_view target) {
    assert(draw.index < declaration_.draws.size());
    declaration_.draws[draw.index].inputs.emplace_back(binding, std::string(target));
}

void StageIo::chunk(std::string_view name, std::string text) {
    declaration_.chunks.emplace_back(name, std::move(text));
}

}  // namespace crevice

// Pipelines are made once per stage; a draw is then three binds and a call.
#include "flow/StageExecution.h"

#include <fmt/format.h>

#include "flow/RenderStage.h"
#include "flow/VertexInput.h"
#include "gfx/Device.h"
#include "gfx/Pipeline.h"
#include "plan/GuardReach.h"

namespace crevice {
namespace {

bool usesSet(const ShaderInfo& info, std::uint32_t set) {
    for (const ShaderResource& resource : info.resources) {
        if (resource.slot.set == set) return true;
    }
    return false;
}

// What is seen through an object's near side is its far side: it must be blended first, whatever the triangles' order.
bool needsTwoPasses(const RenderState& state) {
    return state.topology == Topology::TriangleList && state.cullMode == CullMode::None &&
           !state.blendTargets.empty() && state.blendTargets[0].blend;
}

bool meet(const Aabb& a, const Aabb& b) {
    return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}

std::uint32_t groupCount(std::uint32_t pixels, std::uint32_t local) { return (pixels + local - 1) / local; }

}  // namespace

StageExecution::StageExecution(const ExecutionContext& context, StageProgram& program, const PlannedStage& planned,
                               const SceneGpu* scene)
    : context_(context), program_(program), planned_(planned), scene_(scene) {
    for (const PlannedWrite& write : planned.writes) {
        const Format format = context.targets.format(write.write.target);
        if (write.write.kind == WriteKind::Color) colorFormats_.push_back(format);
        if (write.write.kind == WriteKind::DepthTest || write.write.kind == WriteKind::DepthWrite)
            depthFormat_ = format, stencil_ = context.targets.hasStencil(write.write.target);
        if (write.write.kind == WriteKind::DepthTest) depthReadOnly_.push_back(write.write.target);
    }
    loadPictures();
    for (const DrawProgram& draw : program.draws)
        draws_.push_back(makeShader(*draw.variant, *draw.material, draw.state, false));
    views_.resize(program.queues.size());
    for (const QueueProgram& queue : program.queues) {
        std::vector<Passes>& shaders = queues_.emplace_back();
        std::set<std::uint32_t>& orders = orders_.emplace_back();
        for (const SurfaceProgram& surface : queue.surfaces) {
            Passes& passes = shaders.emplace_back();
            if (!surface.variant) continue;
            passes.push_back(makeSurface(surface));
            for (const SurfaceProgram& more : surface.further) passes.push_back(makeSurface(more));
            for (const ShaderGpu& pass : passes) orders.insert(pass.order);
        }
    }
}

/// Before anything is drawn: a file may be gone.
void StageExecution::loadPictures() {
    for (const DrawProgram& draw : program_.draws)
        for (const Wire& wire : draw.wires)
            if (wire.target.empty() && isPictureFile(wire.texture)) context_.bindings.files.get(wire.texture);
}

StageExecution::ShaderGpu StageExecution::makeShader(const EffectVariant& variant, const Material& material,
                                                     RenderState state, bool surface) {
    ShaderGpu shader;
    shader.binding.emplace(context_.bindings, variant, material);
    shader.usesLocal = usesSet(variant.info, 2);
    std::vector<const SetLayout*> sets{&context_.globals.setLayout(), &shader.binding->setLayout()};
    if (shader.usesLocal) sets.push_back(&context_.locals.setLayout());
    const PipelineLayout& layout = context_.layouts.get(sets);
    if (!variant.compute.empty()) {
        shader.pipeline = &context_.pipelines.get(
            ComputePipelineDesc{.compute = variant.compute, .layout = &layout, .name = variant.name});
        return shader;
    }
    const VertexInput input =
        surface ? vertexInput(variant, VertexSource::Mesh, missingAttributes(context_.profile), scene_->layout())
                : vertexInput(variant, VertexSource::Quad, missingAttributes(context_.profile));
    shader.usesQuad = !surface && input.uses(kMeshStream);
    shader.usesSame = input.uses(kSameStream);
    const bool twoSided = surface && !isCocos(context_.profile) && needsTwoPasses(state);
    if (twoSided) state.cullMode = CullMode::Back;
    shader.pipeline = &makePipeline(variant, input, layout, state);
    if (!surface) return shader;
    state.frontFaceCcw = !state.frontFaceCcw;
    shader.flipped = &makePipeline(variant, input, layout, state);
    if (!twoSided) return shader;
    state.cullMode = CullMode::Front;
    shader.farSidesFlipped = &makePipeline(variant, input, layout, state);
    state.frontFaceCcw = !state.frontFaceCcw;
    shader.farSides = &makePipeline(variant, input, layout, state);
    return shader;
}

StageExecution::ShaderGpu StageExecution::makeSurface(const SurfaceProgram& surface) {
    ShaderGpu shader = makeShader(*surface.variant, *surface.material, surface.state, true);
    shader.order = surface.order;
    shader.binding->writeSceneTextures(surface.textures, *scene_);
    return shader;
}

const Pipeline& StageExecution::makePipeline(const EffectVariant& variant, const VertexInput& input,
                                             const PipelineLayout& layout, RenderState state) {
    // The attachment is read-only, whatever the effect says.
    if (!depthReadOnly_.empty())
        state.depthWrite = false, state.stencilFront.writeMask = state.stencilBack.writeMask = 0;
    return context_.pipelines.get(GraphicsPipelineDesc{.vertex = variant.vertex,
                                                       .fragment = variant.fragment,
                                                       .state = std::move(state),
                                                       .vertexBindings = input.bindings,
                                                       .vertexAttributes = input.attributes,
                                                       .colorFormats = colorFormats_,
                                                       .depthFormat = depthFormat_,
                                                       .stencil = stencil_,
                                                       .layout = &layout,
                                                       .name = variant.name});
}

void StageExecution::writeShaderTargets(ShaderGpu& shader, const std::vector<Wire>& wires) {
    shader.binding->writeTextures(context_.bindings, wires, context_.targets, depthReadOnly_);
}

void StageExecution::writeTargets() {
    for (std::size_t i = 0; i < draws_.size(); ++i) {
        writeShaderTargets(draws_[i], program_.draws[i].wires);
        draws_[i].binding->update();
    }
    for (std::size_t q = 0; q < queues_.size(); ++q) {
        for (std::size_t s = 0; s < queues_[q].size(); ++s) {
            const SurfaceProgram& first = program_.queues[q].surfaces[s];
            for (std::size_t p = 0; p < queues_[q][s].size(); ++p) {
                const SurfaceProgram& surface = p == 0 ? first : first.further[p - 1];
                ShaderGpu& shader = queues_[q][s][p];
                writeShaderTargets(shader, surface.wires);
                shader.binding->writeSceneTextures(surface.textures, *scene_);
                shader.binding->update();
            }
        }
    }
    extent_ = context_.targets.extent();
    if (planned_.writes.empty()) return;
    const TargetWrite& first = planned_.writes.front().write;
    const GpuTexture& texture = context_.targets.texture(first.target);
    extent_ = {texture.width(first.mip), texture.height(first.mip)};
}

void StageExecution::setProperty(DrawId draw, std::string_view name, const Value& value) {
    const Value& document = program_.desc->material;
    if (document.isObject() && document.find(name)) return;
    DrawProgram& program = program_.draws[draw.index];
    Value values = Value::makeObject();
    values.set(std::string(name), value);
    Problems problems;
    program.material->apply(values, problems);
    problems.throwIfErrors();
    draws_[draw.index].binding->writeBlocks(*program.material);
}

void StageExecution::setAutoLength(float length) {
    for (std::size_t i = 0; i < draws_.size(); ++i) {
        Material& material = *program_.draws[i].material;
        for (const std::string& name : program_.draws[i].autoProperties) material.set(name, length);
        draws_[i].binding->writeBlocks(material);
    }
}

void StageExecution::upload(BlockId block, std::span<const std::byte> bytes) {
    context_.globals.upload(program_.declaration.blocks[block.index].name, bytes);
}

void StageExecution::bindShader(const ShaderGpu& shader, bool flipped) {
    context_.commands.bindPipeline(flipped ? *shader.flipped : *shader.pipeline);
    context_.globals.bind(context_.commands);
    shader.binding->bind(context_.commands);
    if (shader.usesSame) context_.quad.bindSame(context_.commands);
}

void StageExecution::draw(DrawId draw) {
    const ShaderGpu& shader = draws_[draw.index];
    bindShader(shader, false);
    if (shader.usesLocal) context_.locals.bind(context_.commands, glm::mat4(1));
    if (!shader.usesQuad) {
        context_.commands.draw(3);
        return;
    }
    context_.quad.bind(context_.commands);
    context_.quad.draw(context_.commands);
}

void StageExecution::dispatch(DrawId draw, Groups groups) {
    bindShader(draws_[draw.index], false);
    context_.commands.dispatch(groups.x, groups.y, groups.z);
}

Groups StageExecution::groupsFor(DrawId draw) const {
    const std::uint32_t* local = program_.draws[draw.index].variant->info.localSize;
    return {groupCount(extent_.x, local[0]), groupCount(extent_.y, local[1]), 1};
}

void StageExecution::beginFrame(glm::uvec2 frame, std::uint32_t guard) {
    for (QueueViews& views : views_) views.used = 0;
    part_ = {{0, 0}, extent_};
    if (planned_.writes.empty() || guard == 0) return;
    const TargetWrite& first = planned_.writes.front().write;
    part_ = drawnPart(context_.targets.desc(first.target), frame, guard, planned_.beyond, first.mip);
}

QueueView& StageExecution::nextView(QueueId queue) {
    QueueViews& views = views_[queue.index];
    if (views.used == views.views.size()) views.views.push_back(std::make_unique<QueueView>());
    return *views.views[views.used++];
}

const DrawList* StageExecution::bindQueue(QueueId queue, const glm::mat4& view, const glm::mat4& viewProjection) {
    if (!scene_ || scene_->instances().size() == 0) return nullptr;
    const QueueDeclaration& declared = program_.queues[queue.index].declaration;
    const bool blended = declared.queue.sort == QueueSort::BackToFront;
    // Whether a Cocos material blends is its passes' business, and they were chosen when they were compiled.
    const DrawFilter filter = isCocos(context_.profile) ? DrawFilter::All
                              : blended                 ? DrawFilter::Blend
                                                        : DrawFilter::Opaque;
    QueueView& seen = nextView(queue);
    seen.update(context_.bindings.device, *scene_,
                {.view = view, .viewProjection = viewProjection, .casters = declared.casters}, filter,
                blended ? DrawOrder::BackToFront : DrawOrder::FrontToBack);
    if (seen.list().batches.empty()) return nullptr;
    scene_->bindVertices(context_.commands);
    context_.commands.bindVertexBuffer(kInstanceStream, seen.rows());
    return &seen.list();
}

void StageExecution::drawQueue(QueueId queue, const glm::mat4& view, const glm::mat4& viewProjection) {
    const DrawList* list = bindQueue(queue, view, viewProjection);
    if (!list) return;
    for (const std::uint32_t order : orders_[queue.index]) drawPasses(queue, *list, order);
}

void StageExecution::drawPerLight(QueueId queue, const glm::mat4& view, const glm::mat4& viewProjection) {
    const std::vector<LitLight>& lights = context_.lights.single;
    const DrawList* list =
        lights.empty() || orders_[queue.index].empty() ? nullptr : bindQueue(queue, view, viewProjection);
    if (!list) return;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        context_.globals.upload("CCShadow", lights[i].shadow);
        context_.locals.useLight(i);
        for (const std::uint32_t order : orders_[queue.index]) drawPasses(queue, *list, order, &lights[i].reach);
    }
    context_.locals.useLight(std::nullopt);
    context_.globals.restore();
}

void StageExecution::drawPasses(QueueId queue, const DrawList& list, std::uint32_t order, const Aabb* reach) {
    const ShaderGpu* bound = nullptr;
    bool boundFlipped = false;
    std::optional<bool> boundIndices;
    for (const DrawBatch& batch : list.batches) {
        const Mesh& mesh = scene_->scene().meshes[std::size_t(batch.mesh)];
        for (const ShaderGpu& shader : queues_[queue.index][surfaceIndex(batch.material, mesh)]) {
            if (shader.order != order) continue;
            if (bound != &shader || boundFlipped != batch.flipped) bindShader(shader, batch.flipped);
            bound = &shader;
            boundFlipped = batch.flipped;
            const bool sixteenBit = scene_->mesh(batch.mesh).sixteenBit;
            if (boundIndices != sixteenBit) scene_->bindIndices(context_.commands, sixteenBit);
            boundIndices = sixteenBit;
            drawBatch(shader, batch, list.instances, reach);
        }
    }
}

void StageExecution::drawBatch(const ShaderGpu& shader, const DrawBatch& batch,
                               std::span<const std::uint32_t> instances, const Aabb* reach) {
    if (shader.farSides) return drawTwoSided(shader, batch, instances, reach);
    const SceneGpu::MeshRange& mesh = scene_->mesh(batch.mesh);
    if (!shader.usesLocal) {
        context_.commands.drawIndexed(mesh.indexCount, batch.instanceCount, mesh.firstIndex, mesh.vertexOffset,
                                      batch.firstInstance);
        return;
    }
    for (std::uint32_t i = batch.firstInstance; i < batch.firstInstance + batch.instanceCount; ++i) {
        if (reach && !meet(*reach, scene_->instances().box(instances[i]))) continue;
        context_.locals.bind(context_.commands, instances[i], scene_->scene().instances[instances[i]].world);
        context_.commands.drawIndexed(mesh.indexCount, 1, mesh.firstIndex, mesh.vertexOffset, i);
    }
}

void StageExecution::drawTwoSided(const ShaderGpu& shader, const DrawBatch& batch,
                                  std::span<const std::uint32_t> instances, const Aabb* reach) {
    const SceneGpu::MeshRange& mesh = scene_->mesh(batch.mesh);
    const Pipeline& far = batch.flipped ? *shader.farSidesFlipped : *shader.farSides;
    const Pipeline& near = batch.flipped ? *shader.flipped : *shader.pipeline;
    for (std::uint32_t i = batch.firstInstance; i < batch.firstInstance + batch.instanceCount; ++i) {
        if (reach && !meet(*reach, scene_->instances().box(instances[i]))) continue;
        if (shader.usesLocal)
            context_.locals.bind(context_.commands, instances[i], scene_->scene().instances[instances[i]].world);
        for (const Pipeline* pipeline : {&far, &near}) {
            context_.commands.bindPipeline(*pipeline);
            context_.commands.drawIndexed(mesh.indexCount, 1, mesh.firstIndex, mesh.vertexOffset, i);
        }
    }
}

}  // namespace crevice

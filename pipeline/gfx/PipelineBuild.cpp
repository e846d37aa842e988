// Fills Vulkan's pipeline structs from ours, one small function per state.
#include "gfx/PipelineBuild.h"

#include <array>

#include <fmt/format.h>

#include "core/Error.h"
#include "gfx/Device.h"
#include "gfx/Format.h"
#include "gfx/Owned.h"
#include "gfx/StateWords.h"

namespace crevice {

namespace {

Unique<VkShaderModule> makeModule(Device& device, std::span<const std::uint32_t> words, const std::string& name) {
    auto info = vkStruct<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    VkShaderModule module = VK_NULL_HANDLE;
    VK_CALL(vkCreateShaderModule(device.handle(), &info, nullptr, &module));
    device.setName(VK_OBJECT_TYPE_SHADER_MODULE, module, name);
    return {module, device.handle(), [](void* owner, VkShaderModule dead) {
                vkDestroyShaderModule(static_cast<VkDevice>(owner), dead, nullptr);
            }};
}

VkPipelineShaderStageCreateInfo stageInfo(VkShaderStageFlagBits stage, VkShaderModule module) {
    auto info = vkStruct<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    info.stage = stage;
    info.module = module;
    info.pName = "main";
    return info;
}

VkFormat toVk(VertexFormat format) {
    static constexpr std::array kFormats = {
        VK_FORMAT_R32_SFLOAT,     VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT,
        VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R32_UINT,      VK_FORMAT_R32G32B32A32_UINT};
    return kFormats.at(static_cast<std::size_t>(format));
}

/// Arrays that VkPipelineVertexInputStateCreateInfo points into.
struct VertexInput {
    std::vector<VkVertexInputBindingDescription> bindings;
    std::vector<VkVertexInputAttributeDescription> attributes;

    explicit VertexInput(const GraphicsPipelineDesc& desc) {
        for (const VertexBinding& binding : desc.vertexBindings) {
            bindings.push_back({binding.binding, binding.stride,
                                binding.perInstance ? VK_VERTEX_INPUT_RATE_INSTANCE : VK_VERTEX_INPUT_RATE_VERTEX});
        }
        for (const VertexAttribute& attribute : desc.vertexAttributes) {
            attributes.push_back({attribute.location, attribute.binding, toVk(attribute.format), attribute.offset});
        }
    }
    VkPipelineVertexInputStateCreateInfo info() const {
        auto info =
            vkStruct<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
        info.vertexBindingDescriptionCount = static_cast<std::uint32_t>(bindings.size());
        info.pVertexBindingDescriptions = bindings.data();
        info.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size());
        info.pVertexAttributeDescriptions = attributes.data();
        return info;
    }
};

VkPipelineRasterizationStateCreateInfo rasterizationInfo(const RenderState& state) {
    auto info =
        vkStruct<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
    info.polygonMode = crevice::toVk(state.polygonMode);
    info.cullMode = crevice::toVk(state.cullMode);
    info.frontFace = state.frontFaceCcw ? VK_FRONT_FACE_COUNTER_CLOCKWISE : VK_FRONT_FACE_CLOCKWISE;
    info.depthBiasEnable = state.depthBias != 0 || state.depthBiasSlope != 0 ? VK_TRUE : VK_FALSE;
    info.depthBiasConstantFactor = state.depthBias;
    info.depthBiasSlopeFactor = state.depthBiasSlope;
    info.lineWidth = 1;
    return info;
}

/// A side without a test passes and keeps.
VkStencilOpState stencilSide(const StencilFace& face) {
    VkStencilOpState side{};
    side.compareOp = face.test ? crevice::toVk(face.func) : VK_COMPARE_OP_ALWAYS;
    side.failOp = crevice::toVk(face.test ? face.failOp : StencilOp::Keep);
    side.depthFailOp = crevice::toVk(face.test ? face.zFailOp : StencilOp::Keep);
    side.passOp = crevice::toVk(face.test ? face.passOp : StencilOp::Keep);
    side.compareMask = face.readMask;
    side.writeMask = face.test ? face.writeMask : 0;
    side.reference = face.ref;
    return side;
}

VkPipelineDepthStencilStateCreateInfo depthInfo(const GraphicsPipelineDesc& desc) {
    auto info =
        vkStruct<VkPipelineDepthStencilStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
    info.depthTestEnable = desc.depthFormat && desc.state.depthTest ? VK_TRUE : VK_FALSE;
    info.depthWriteEnable = desc.depthFormat && desc.state.depthWrite ? VK_TRUE : VK_FALSE;
    info.depthCompareOp = crevice::toVk(desc.state.depthFunc);
    info.maxDepthBounds = 1;
    const bool tests = desc.state.stencilFront.test || desc.state.stencilBack.test;
    info.stencilTestEnable = desc.stencil && tests ? VK_TRUE : VK_FALSE;
    info.front = stencilSide(desc.state.stencilFront);
    info.back = stencilSide(desc.state.stencilBack);
    return info;
}

std::vector<VkPipelineColorBlendAttachmentState> blendAttachments(const GraphicsPipelineDesc& desc) {
    std::vector<VkPipelineColorBlendAttachmentState> attachments;
    for (std::size_t i = 0; i < desc.colorFormats.size(); ++i) {
        const BlendTarget target = i < desc.state.blendTargets.size() ? desc.state.blendTargets[i] : BlendTarget{};
        VkPipelineColorBlendAttachmentState attachment{};
        attachment.blendEnable = target.blend ? VK_TRUE : VK_FALSE;
        attachment.srcColorBlendFactor = crevice::toVk(target.src);
        attachment.dstColorBlendFactor = crevice::toVk(target.dst);
        attachment.colorBlendOp = crevice::toVk(target.op);
        attachment.srcAlphaBlendFactor = crevice::toVk(target.srcAlpha);
        attachment.dstAlphaBlendFactor = crevice::toVk(target.dstAlpha);
        attachment.alphaBlendOp = crevice::toVk(target.alphaOp);
        attachment.colorWriteMask = target.colorMask;
        attachments.push_back(attachment);
    }
    return attachments;
}

void checkStates(const Device& device, const GraphicsPipelineDesc& desc) {
    if (desc.state.polygonMode != PolygonMode::Fill && device.features().fillModeNonSolid == VK_FALSE) {
        throw Error(fmt::format("device '{}' cannot draw lines or points of polygons, which pipeline '{}' asks for",
                                device.deviceName(), desc.name),
                    "use polygonMode fill");
    }
    for (std::size_t i = 0; i < desc.colorFormats.size() && i < desc.state.blendTargets.size(); ++i) {
        if (!desc.state.blendTargets[i].blend || supportsBlend(device, desc.colorFormats[i])) continue;
        throw Error(fmt::format("device '{}' cannot blend into format '{}', which pipeline '{}' asks for",
                                device.deviceName(), formatInfo(desc.colorFormats[i]).name, desc.name),
                    "give the target another format, or switch blending off");
    }
}

VkPipelineRenderingCreateInfo renderingInfo(const GraphicsPipelineDesc& desc, const std::vector<VkFormat>& colors) {
    auto info = vkStruct<VkPipelineRenderingCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
    info.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
    info.pColorAttachmentFormats = colors.data();
    info.depthAttachmentFormat = desc.depthFormat ? crevice::toVk(*desc.depthFormat) : VK_FORMAT_UNDEFINED;
    if (desc.stencil) info.depthAttachmentFormat = info.stencilAttachmentFormat = VK_FORMAT_D32_SFLOAT_S8_UINT;
    return info;
}

VkPipelineInputAssemblyStateCreateInfo assemblyInfo(const RenderState& state) {
    auto info =
        vkStruct<VkPipelineInputAssemblyStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
    info.topology = crevice::toVk(state.topology);
    return info;
}

/// One viewport and scissor rectangle, which commands set.
VkPipelineViewportStateCreateInfo viewportInfo() {
    auto info = vkStruct<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
    info.viewportCount = 1;
    info.scissorCount = 1;
    return info;
}

constexpr std::array kDynamicStates = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};

VkPipelineDynamicStateCreateInfo dynamicInfo() {
    auto info = vkStruct<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
    info.dynamicStateCount = static_cast<std::uint32_t>(kDynamicStates.size());
    info.pDynamicStates = kDynamicStates.data();
    return info;
}

VkPipelineMultisampleStateCreateInfo sampleInfo() {
    auto info =
        vkStruct<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
    info.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    return info;
}

VkPipelineColorBlendStateCreateInfo blendInfo(const std::vector<VkPipelineColorBlendAttachmentState>& attachments) {
    auto info = vkStruct<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
    info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    return info;
}

/// Shader modules and the stages that refer to them.
struct ShaderStages {
    std::vector<Unique<VkShaderModule>> modules;
    std::vector<VkPipelineShaderStageCreateInfo> infos;

    void add(Device& device, VkShaderStageFlagBits stage, std::span<const std::uint32_t> code,
             const std::string& name) {
        modules.push_back(makeModule(device, code, name));
        infos.push_back(stageInfo(stage, modules.back().get()));
    }
};

/// What the driver made; a refusal is explained as far as it can be.
Unique<VkPipeline> ownPipeline(Device& device, const std::string& name, VkResult result, VkPipeline pipeline) {
    if (result != VK_SUCCESS) {
        throw RenderError(
            fmt::format("device '{}' refused pipeline '{}': {}", device.deviceName(), name, vkResultName(result)),
            "run again with --validate to see why");
    }
    device.setName(VK_OBJECT_TYPE_PIPELINE, pipeline, name);
    return own<vkDestroyPipeline, ObjectKind::Pipeline>(device, pipeline);
}

}  // namespace

Unique<VkPipeline> buildGraphicsPipeline(Device& device, const GraphicsPipelineDesc& desc) {
    checkStates(device, desc);
    ShaderStages stages;
    stages.add(device, VK_SHADER_STAGE_VERTEX_BIT, desc.vertex, desc.name + " vertex");
    if (!desc.fragment.empty())
        stages.add(device, VK_SHADER_STAGE_FRAGMENT_BIT, desc.fragment, desc.name + " fragment");
    std::vector<VkFormat> colorFormats;
    for (const Format format : desc.colorFormats) colorFormats.push_back(crevice::toVk(format));
    const auto rendering = renderingInfo(desc, colorFormats);
    const VertexInput input(desc);
    const auto vertexInput = input.info();
    const auto assembly = assemblyInfo(desc.state);
    const auto viewport = viewportInfo();
    const auto rasterization = rasterizationInfo(desc.state);
    const auto samples = sampleInfo();
    const auto depth = depthInfo(desc);
    const auto attachments = blendAttachments(desc);
    const auto blend = blendInfo(attachments);
    const auto dynamic = dynamicInfo();

    auto info = vkStruct<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
    info.pNext = &rendering;
    info.stageCount = static_cast<std::uint32_t>(stages.infos.size());
    info.pStages = stages.infos.data();
    info.pVertexInputState = &vertexInput;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &rasterization;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = desc.layout->handle();
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult result =
        vkCreateGraphicsPipelines(device.handle(), device.pipelineCache(), 1, &info, nullptr, &pipeline);
    return ownPipeline(device, desc.name, result, pipeline);
}

Unique<VkPipeline> buildComputePipeline(Device& device, const ComputePipelineDesc& desc) {
    const auto module = makeModule(device, desc.compute, desc.name + " compute");
    auto info = vkStruct<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.stage = stageInfo(VK_SHADER_STAGE_COMPUTE_BIT, module.get());
    info.layout = desc.layout->handle();
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult result =
        vkCreateComputePipelines(device.handle(), device.pipelineCache(), 1, &info, nullptr, &pipeline);
    return ownPipeline(device, desc.name, result, pipeline);
}

}  // namespace crevice

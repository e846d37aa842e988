// The tables. Those of Cocos are the enums of its pipeline definitions at 3.3.1 and 3.6.1.
#include "plan/ProfileSlots.h"

namespace crevice {
namespace {

constexpr auto kBlock = GlobalKind::UniformBlock;
constexpr auto k2D = GlobalKind::Sampler2D;
constexpr auto kCube = GlobalKind::SamplerCube;

// Sizes in bytes, as the blocks in effects/chunks have them.
constexpr BuiltInSlot kOwn[] = {
    {"CCGlobal", kBlock, 0, 48},
    {"CCCamera", kBlock, 1, 544},
    {"CCShadow", kBlock, 2, 304},
    {"cc_shadowMap", k2D, 3, 0},
    {"cc_environment", kCube, 4, 0},
    {"cc_spotLightingMap", k2D, 5, 0},
    {"CCSpotShadow", kBlock, 28, 96},
    {"CCPunctualLights", GlobalKind::StorageBuffer, 30, 0},
    {"CCLightGrid", GlobalKind::StorageBuffer, 31, 0},
    {"CCEnvironment", GlobalKind::StorageBuffer, 60, 0},
    {"cc_environmentBrdf", k2D, 61, 0},
};

constexpr BuiltInSlot kOwnTargets[] = {
    {"cc_gbuffer_albedoMap", k2D, 6, 0},   {"cc_gbuffer_positionMap", k2D, 7, 0}, {"cc_gbuffer_normalMap", k2D, 8, 0},
    {"cc_gbuffer_emissiveMap", k2D, 9, 0}, {"cc_lighting_resultMap", k2D, 10, 0},
};

constexpr BuiltInSlot kCocos33[] = {
    {"CCGlobal", kBlock, 0, 48},           {"CCCamera", kBlock, 1, 544},          {"CCShadow", kBlock, 2, 304},
    {"cc_shadowMap", k2D, 3, 0},           {"cc_environment", kCube, 4, 0},       {"cc_spotLightingMap", k2D, 5, 0},
    {"cc_gbuffer_albedoMap", k2D, 6, 0},   {"cc_gbuffer_positionMap", k2D, 7, 0}, {"cc_gbuffer_normalMap", k2D, 8, 0},
    {"cc_gbuffer_emissiveMap", k2D, 9, 0}, {"cc_lighting_resultMap", k2D, 10, 0},
};

constexpr BuiltInSlot kCocos36[] = {
    {"CCGlobal", kBlock, 0, 112},    {"CCCamera", kBlock, 1, 592},   {"CCShadow", kBlock, 2, 256},
    {"CCCSM", kBlock, 3, 656},       {"cc_shadowMap", k2D, 4, 0},    {"cc_environment", kCube, 5, 0},
    {"cc_spotShadowMap", k2D, 6, 0}, {"cc_diffuseMap", kCube, 7, 0},
};

constexpr std::uint32_t kLights = 640, kSkinning = 1440, kMorph = 256, kBatched = 640, kVec4 = 16;

constexpr LocalSlot kOwnLocals[] = {
    {"CCLocal", LocalKind::DynamicBlock, 0, 144},
    {"CCForwardLight", LocalKind::Block, 1, kLights},
};

constexpr LocalSlot kLocals33[] = {
    {"CCLocal", LocalKind::DynamicBlock, 0, 144},
    {"CCLocalBatched", LocalKind::DynamicBlock, 0, kBatched},
    {"CCForwardLight", LocalKind::Block, 1, kLights},
    {"CCSkinningAnimation", LocalKind::Block, 2, kVec4},
    {"CCSkinningTexture", LocalKind::Block, 3, kVec4},
    {"CCSkinning", LocalKind::Block, 3, kSkinning},
    {"CCMorph", LocalKind::Block, 4, kMorph},
    {"cc_jointTexture", LocalKind::Sampler2D, 5, 0},
    {"cc_realtimeJoint", LocalKind::Sampler2D, 5, 0},
    {"cc_PositionDisplacements", LocalKind::Sampler2D, 6, 0},
    {"cc_NormalDisplacements", LocalKind::Sampler2D, 7, 0},
    {"cc_TangentDisplacements", LocalKind::Sampler2D, 8, 0},
    {"cc_lightingMap", LocalKind::Sampler2D, 9, 0},
    {"cc_spriteTexture", LocalKind::Sampler2D, 10, 0},
    {"cc_reflectionTexture", LocalKind::Sampler2D, 11, 0},
    {"cc_reflectionStorage", LocalKind::StorageImage, 12, 0},
};

constexpr LocalSlot kLocals36[] = {
    {"CCLocal", LocalKind::DynamicBlock, 0, 160},
    {"CCLocalBatched", LocalKind::DynamicBlock, 0, kBatched},
    {"CCWorldBound", LocalKind::DynamicBlock, 0, 32},
    {"CCForwardLight", LocalKind::Block, 1, kLights},
    {"CCSkinningAnimation", LocalKind::Block, 2, kVec4},
    {"CCSkinningTexture", LocalKind::Block, 3, kVec4},
    {"CCSkinning", LocalKind::Block, 3, kSkinning},
    {"CCMorph", LocalKind::Block, 4, kMorph},
    {"CCUILocal", LocalKind::Block, 5, kVec4},
    {"cc_jointTexture", LocalKind::Sampler2D, 6, 0},
    {"cc_realtimeJoint", LocalKind::Sampler2D, 6, 0},
    {"cc_PositionDisplacements", LocalKind::Sampler2D, 7, 0},
    {"cc_NormalDisplacements", LocalKind::Sampler2D, 8, 0},
    {"cc_TangentDisplacements", LocalKind::Sampler2D, 9, 0},
    {"cc_lightingMap", LocalKind::Sampler2D, 10, 0},
    {"cc_spriteTexture", LocalKind::Sampler2D, 11, 0},
    {"cc_reflectionTexture", LocalKind::Sampler2D, 12, 0},
    {"cc_reflectionStorage", LocalKind::StorageImage, 13, 0},
};

}  // namespace

GlobalNumbers globalNumbers(Profile profile) {
    switch (profile) {
        case Profile::Crevice:
            break;
        case Profile::Cocos33:
            return {kCocos33, {}, 11};
        case Profile::Cocos36:
            return {kCocos36, {}, 8};
    }
    return {kOwn, kOwnTargets, 11};
}

std::span<const LocalSlot> localSlots(Profile profile) {
    switch (profile) {
        case Profile::Crevice:
            break;
        case Profile::Cocos33:
            return kLocals33;
        case Profile::Cocos36:
            return kLocals36;
    }
    return kOwnLocals;
}

}  // namespace crevice

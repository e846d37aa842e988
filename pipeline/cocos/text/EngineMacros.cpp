// Values of the engine's macros.
#include "cocos/text/EngineMacros.h"

namespace crevice::cocos {

const Defines& engineConstants() {
    static const Defines kConstants = {
        {"CC_DEVICE_SUPPORT_FLOAT_TEXTURE", "1"},
        {"CC_DEVICE_MAX_VERTEX_UNIFORM_VECTORS", "1024"},
        {"CC_DEVICE_MAX_FRAGMENT_UNIFORM_VECTORS", "1024"},
        {"CC_DEVICE_CAN_BENEFIT_FROM_INPUT_ATTACHMENT", "0"},
        {"CC_ENABLE_CLUSTERED_LIGHT_CULLING", "0"},
        {"CC_ENABLE_WEBGL_HIGHP_STRUCT_VALUES", "0"},
        {"CC_PLATFORM_ANDROID_AND_WEBGL", "0"},
        {"CC_JOINT_UNIFORM_CAPACITY", "30"},
        {"CC_EFFECT_USED_VERTEX_UNIFORM_VECTORS", "128"},
        {"CC_EFFECT_USED_FRAGMENT_UNIFORM_VECTORS", "128"},
        {"CC_USE_WGPU", "0"},
    };
    return kConstants;
}

std::string_view engineDefault(std::string_view name) { return name == "CC_USE_FOG" ? "4" : std::string_view(); }

}  // namespace crevice::cocos

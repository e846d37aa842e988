// SPIRV-Tools' validator for every stage that glslang wrote.
#include "effect/SpirvCheck.h"

#include <fmt/format.h>

#include <spirv-tools/libspirv.hpp>

namespace crevice {

void checkSpirv(const StageCode& code, const StageSource& source, Problems& problems) {
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_2);
    std::string message;
    tools.SetMessageConsumer([&](spv_message_level_t level, const char*, const spv_position_t&, const char* text) {
        if (level <= SPV_MSG_ERROR && message.empty()) message = text;
    });
    spvtools::ValidatorOptions options;
    options.SetFriendlyNames(false);  // they take a third of the time
    if (tools.Validate(code.words.data(), code.words.size(), options)) return;
    problems.error(source.flat.locate(1), fmt::format("the compiled program is no valid SPIR-V: {}", message),
                   "the GLSL compiler accepted something that Vulkan does not have; look for what the message names");
}

}  // namespace crevice

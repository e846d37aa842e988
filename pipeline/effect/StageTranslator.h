// One stage that stands alone, to SPIR-V: glslang's own parser over built-in names that are read once for all stages.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "effect/ShaderInfo.h"

namespace crevice {

/// glslang::TShader declares what depends on a device's limits anew for every shader, and reads definitions of all
/// extensions: of a small shader this is half the time. Here both stay out of the way, with the same code as result.
/// Works with the glslang that it was written for; with others it translates nothing. The first call takes 60 ms.
class StageTranslator {
public:
    StageTranslator();
    ~StageTranslator();

    /// `text` begins with "#version 450\n". Warnings are dropped; nothing where it has errors: a TShader tells which.
    std::optional<std::vector<std::uint32_t>> translate(ShaderStageBits stage, const std::string& text);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace crevice

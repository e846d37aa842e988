// The stages that come with Crevice, registered by an explicit list: linkers drop self-registration from static
// libraries.
#pragma once

namespace crevice {

class StageRegistry;

void registerBuiltinStages(StageRegistry& registry);

}  // namespace crevice

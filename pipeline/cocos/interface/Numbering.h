// Locations, sets and bindings by Cocos' rules: out of the text alone, so that no variant changes a number.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cocos/interface/Interface.h"

namespace crevice::cocos {

/// Numbers by name, as Cocos' compiler gives them; a pipeline's own names do not enter here.
struct Numbers {
    std::map<std::string, int, std::less<>> attributes;  ///< Inputs of the vertex program.
    std::map<std::string, int, std::less<>> varyings;    ///< Its outputs, and the inputs of the fragment program.
    std::map<std::string, int, std::less<>> outputs;     ///< Of the fragment program.
    BindingMap slots;                                    ///< Blocks, samplers, textures, buffers, images, inputs.
};

/// Explicit numbers are reserved first; every other declaration takes the next free one in text order. A name that is
/// declared several times takes a number each time and keeps the last. Varyings meet by name. Resources of set 1 are
/// numbered by kind (InterfaceKind), vertex before fragment, once per name.
Numbers numberInterfaces(const std::vector<StageInterface>& stages, Problems& problems);

/// numberStages() for texts whose interfaces were read before.
void numberStages(std::vector<StageText>& stages, const std::vector<StageInterface>& interfaces,
                  const BindingMap& bindings, const NumberingOptions& options, Problems& problems);

}  // namespace crevice::cocos

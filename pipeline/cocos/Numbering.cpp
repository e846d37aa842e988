// Locations, sets and bindings written into the text of a pass' stages.
#include "cocos/StageText.h"

namespace crevice::cocos {

void numberStages(std::vector<StageText>&, const BindingMap&, const NumberingOptions&, Problems&) {}

}  // namespace crevice::cocos
